//! Biconnected components by the lowest vertices that fronds reach.
//!
//! Source: Hopcroft, Tarjan, "Efficient algorithms for graph manipulation", CACM 16 (1973), without recursion.

use super::{Event, Graph};
use crate::topology::DisjointSets;
use crate::{Cells, Components};

/// How a graph falls apart when a vertex or an edge is taken away.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Biconnected {
    /// The biconnected components as lists of edges, rising in each list, in the order of their smallest edges.
    /// Every edge is in exactly one; a bridge is a component alone, and so is a loop.
    pub components: Cells,
    /// The vertices whose removal separates their component, rising.
    pub articulation_points: Vec<u32>,
    /// The edges whose removal separates their component, rising.
    pub bridges: Vec<u32>,
}

/// What the search keeps: `number` counts vertices as they are found, from 1; `low` is the smallest number that
/// a vertex's subtree reaches through one frond; `stack` holds the edges not yet in a component.
struct Lows {
    number: Vec<u32>,
    low: Vec<u32>,
    n_found: u32,
    stack: Vec<u32>,
    /// Per vertex: how many components end at it as their highest vertex.
    tops: Vec<u32>,
    roots: Vec<u32>,
    components: Vec<Vec<u32>>,
    bridges: Vec<u32>,
}

impl Graph {
    /// The biconnected components, articulation points and bridges. O(n log n) for the sorting of the lists.
    ///
    /// ```
    /// // 0 - 1 - 2       two triangles that share vertex 2, and an edge to vertex 0
    /// //     | / | \
    /// //     5   3 - 4
    /// let edges = [[0, 1], [1, 2], [2, 3], [3, 4], [4, 2], [5, 1], [2, 5]];
    /// let found = lar_core::Graph::new(6, &edges).unwrap().biconnected_components();
    /// assert_eq!(found.components.iter().collect::<Vec<_>>(), [&[0][..], &[1, 5, 6], &[2, 3, 4]]);
    /// assert_eq!((found.articulation_points, found.bridges), (vec![1, 2], vec![0]));
    /// ```
    #[doc(alias = "biconnectedComponent")]
    #[must_use]
    pub fn biconnected_components(&self) -> Biconnected {
        let mut lows = Lows::new(self.n_vertices());
        self.search(|event| lows.update(&event));
        lows.finish()
    }

    /// The 2-edge-connected components: which vertices stay connected whichever one edge is taken away, that
    /// is, the components of the graph without its bridges. O(n log n).
    ///
    /// ```
    /// let dumbbell = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 5], [5, 3]];
    /// let found = lar_core::Graph::new(6, &dumbbell).unwrap().edge_biconnected_components();
    /// assert_eq!((found.n, found.of_vertex), (2, vec![0, 0, 0, 1, 1, 1]));
    /// ```
    #[doc(alias = "edge_biconnect")]
    #[must_use]
    pub fn edge_biconnected_components(&self) -> Components {
        let bridges = self.biconnected_components().bridges;
        let mut sets = DisjointSets::new(self.n_vertices());
        for (edge, [a, b]) in (0..).zip(self.edges()) {
            if bridges.binary_search(&edge).is_err() {
                sets.join(*a as usize, *b as usize);
            }
        }
        let (of_vertex, n) = sets.labels();
        Components { n, of_vertex }
    }
}

impl Lows {
    fn new(n: usize) -> Self {
        Self {
            number: vec![0; n],
            low: vec![0; n],
            n_found: 0,
            stack: Vec::new(),
            tops: vec![0; n],
            roots: Vec::new(),
            components: Vec::new(),
            bridges: Vec::new(),
        }
    }

    fn update(&mut self, event: &Event) {
        match *event {
            Event::Found { vertex, edge } => {
                self.n_found += 1;
                self.number[vertex as usize] = self.n_found;
                self.low[vertex as usize] = self.n_found;
                match edge {
                    Some(edge) => self.stack.push(edge),
                    None => self.roots.push(vertex),
                }
            }
            Event::Frond { edge, from, to } if from == to => self.components.push(vec![edge]),
            Event::Frond { edge, from, to } => {
                self.stack.push(edge);
                self.reach(from, self.number[to as usize]);
            }
            Event::Left { vertex, edge, above } => self.leave(vertex, edge, above),
        }
    }

    fn reach(&mut self, vertex: u32, number: u32) {
        let low = &mut self.low[vertex as usize];
        *low = number.min(*low);
    }

    /// The subtree below `edge` is done: when it reaches nothing above `above`, its edges are a component.
    fn leave(&mut self, vertex: u32, edge: u32, above: u32) {
        let low = self.low[vertex as usize];
        self.reach(above, low);
        if low < self.number[above as usize] {
            return;
        }
        self.tops[above as usize] += 1;
        let first = self.stack.iter().rposition(|&e| e == edge).unwrap_or(0);
        let component = self.stack.split_off(first);
        if let [bridge] = component[..] {
            self.bridges.push(bridge);
        }
        self.components.push(component);
    }

    /// A root separates when two components end at it, any other vertex when one does.
    fn finish(mut self) -> Biconnected {
        for &root in &self.roots {
            self.tops[root as usize] = self.tops[root as usize].saturating_sub(1);
        }
        self.components.iter_mut().for_each(|c| c.sort_unstable());
        self.components.sort_unstable();
        self.bridges.sort_unstable();
        let articulation_points = (0..).zip(&self.tops).filter(|e| *e.1 > 0).map(|e| e.0).collect();
        Biconnected {
            components: self.components.iter().collect(),
            articulation_points,
            bridges: self.bridges,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(n: usize, edges: &[[u32; 2]], components: &[&[u32]], points: &[u32], bridges: &[u32]) {
        let found = Graph::new(n, edges).unwrap().biconnected_components();
        assert_eq!(found.components.iter().collect::<Vec<_>>(), components);
        assert_eq!((&found.articulation_points[..], &found.bridges[..]), (points, bridges));
    }

    #[test]
    fn small_graphs() {
        check(2, &[], &[], &[], &[]);
        check(2, &[[0, 1]], &[&[0]], &[], &[0]);
        check(2, &[[0, 1], [1, 0]], &[&[0, 1]], &[], &[]);
        check(2, &[[1, 1], [0, 1]], &[&[0], &[1]], &[], &[1]);
        check(4, &[[0, 1], [1, 2], [1, 3]], &[&[0], &[1], &[2]], &[1], &[0, 1, 2]);
        check(5, &[[2, 0], [0, 1], [1, 2], [2, 3], [3, 4], [4, 2]], &[&[0, 1, 2], &[3, 4, 5]], &[2], &[]);
    }

    #[test]
    fn a_million_edges_in_one_path_and_one_cycle() {
        let n = 1_000_000_u32;
        let mut edges: Vec<[u32; 2]> = (1..n).map(|v| [v - 1, v]).collect();
        let path = Graph::new(n as usize, &edges).unwrap().biconnected_components();
        assert_eq!((path.bridges.len(), path.articulation_points.len()), (n as usize - 1, n as usize - 2));
        edges.push([0, n - 1]);
        let cycle = Graph::new(n as usize, &edges).unwrap().biconnected_components();
        assert_eq!((cycle.components.len(), cycle.bridges.len()), (1, 0));
        assert_eq!(cycle.components[0].len(), n as usize);
    }

    /// The number of components of the graph without one edge or one vertex.
    fn n_components(n: usize, edges: &[[u32; 2]], keep: impl Fn(usize, [u32; 2]) -> bool) -> usize {
        let mut sets = DisjointSets::new(n);
        for (_, &[a, b]) in edges.iter().enumerate().filter(|&(e, &ends)| keep(e, ends)) {
            sets.join(a as usize, b as usize);
        }
        sets.labels().1
    }

    proptest! {
        #[test]
        fn agreement_with_removal(ends in prop::collection::vec((0..9_u32, 0..9_u32), 0..16)) {
            let edges: Vec<[u32; 2]> = ends.iter().map(|&(a, b)| [a, b]).collect();
            let found = Graph::new(9, &edges).unwrap().biconnected_components();
            let whole = n_components(9, &edges, |_, _| true);
            let splits = |e: &u32| n_components(9, &edges, |i, _| i != *e as usize) > whole;
            let bridges: Vec<u32> = (0..edges.len() as u32).filter(splits).collect();
            prop_assert_eq!(&found.bridges, &bridges);
            // The removed vertex stays as an isolated one, so it adds one component by itself unless it was one.
            let separates = |v: &u32| {
                let isolated = !edges.iter().any(|ends| ends.contains(v) && ends[0] != ends[1]);
                n_components(9, &edges, |_, ends| !ends.contains(v)) > whole + usize::from(!isolated)
            };
            prop_assert_eq!(&found.articulation_points, &(0..9).filter(separates).collect::<Vec<_>>());
            let mut all = found.components.indices().to_vec();
            all.sort_unstable();
            prop_assert_eq!(all, (0..edges.len() as u32).collect::<Vec<_>>());
            // Two edges are in one component when no vertex separates them: the edges that share a component
            // stay connected to each other whichever vertex is taken away.
            for component in found.components.iter().filter(|c| c.len() > 1) {
                for v in 0..9 {
                    let inside = |e: usize, ends: [u32; 2]| component.contains(&(e as u32)) && !ends.contains(&v);
                    let rest: Vec<[u32; 2]> = edges.iter().copied().enumerate().filter(|&(e, ends)| inside(e, ends)).map(|e| e.1).collect();
                    let touched = (0..9).filter(|w| rest.iter().flatten().any(|x| x == w)).count();
                    prop_assert!(n_components(9, &rest, |_, _| true) <= 9 - touched.saturating_sub(1));
                }
            }
        }
    }
}
