//! Colours of faces: neighbours never have the same.

use super::picture::{Color, mean, positions};
use lar_arrangement::planar::PlanarArrangement;

/// Light enough that dark edges stand out on every one of them.
const COLORS: [Color; 9] = [
    Color([0xf4, 0x8f, 0x7f]), // salmon
    Color([0x8f, 0xcf, 0xa2]), // green
    Color([0x8b, 0xb8, 0xee]), // blue
    Color([0xfb, 0xd9, 0x7c]), // yellow
    Color([0xc9, 0xa2, 0xe0]), // lilac
    Color([0x83, 0xd3, 0xd6]), // cyan
    Color([0xfb, 0xb6, 0x78]), // orange
    Color([0xf5, 0xae, 0xcb]), // pink
    Color([0xc5, 0xdc, 0x7d]), // lime
];

/// The colour of a running number: neighbouring numbers differ.
pub(super) fn cyclic(number: usize) -> Color {
    COLORS[number % COLORS.len()]
}

/// A colour for each face, the exterior among them: faces with an edge in common have different ones.
///
/// Faces are coloured in the reverse of an order in which each has at most five neighbours among those after it, which
/// every planar graph has (Matula, Beck, *Smallest-last ordering*, 1983), so that six colours would do; each takes the
/// first free one from its rank on. Ranks go by position, so that colours do not depend on how faces are numbered.
/// O(n log n).
///
/// ```
/// use lar_arrangement::planar::{Drawing, planar_arrangement};
/// let grid = [[0., 0., 2., 0.], [0., 1., 2., 1.], [0., 0., 0., 1.], [1., 0., 1., 1.], [2., 0., 2., 1.]];
/// let colors = lar_examples::plane::face_colors(&planar_arrangement(&Drawing::from_segments(&grid))?);
/// assert!(colors.len() == 3 && colors[1] != colors[2]);
/// # Ok::<(), lar_arrangement::ArrangementError>(())
/// ```
#[must_use]
pub fn face_colors(arrangement: &PlanarArrangement) -> Vec<Color> {
    let ranks = ranks(arrangement);
    let neighbors = neighbors(arrangement, &ranks);
    let mut numbers = vec![usize::MAX; neighbors.len()];
    for &face in smallest_last(&neighbors).iter().rev() {
        let is_free = |number: &usize| neighbors[face].iter().all(|&other| numbers[other] != *number);
        let mut wanted = (face..face + COLORS.len()).map(|number| number % COLORS.len());
        numbers[face] = wanted.find(is_free).expect("five neighbours leave four of nine colours");
    }
    ranks.into_iter().map(|rank| cyclic(numbers[rank])).collect()
}

/// The place of each face in the order of the means of their vertices, the exterior first.
fn ranks(arrangement: &PlanarArrangement) -> Vec<usize> {
    let complex = arrangement.complex();
    let key = |face: usize| {
        let vertices = complex.face_loops(face).concat();
        (mean(positions(complex.points(), &vertices)), vertices.len())
    };
    let keys: Vec<([f64; 2], usize)> = (1..=arrangement.n_faces()).map(key).collect();
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|&a, &b| {
        let ((p, m), (q, n)) = (keys[a], keys[b]);
        p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(m.cmp(&n))
    });
    let mut ranks = vec![0; keys.len() + 1];
    order.into_iter().enumerate().for_each(|(rank, face)| ranks[face + 1] = rank + 1);
    ranks
}

/// The ranks of the faces beside each face, by its rank, once each.
fn neighbors(arrangement: &PlanarArrangement, ranks: &[usize]) -> Vec<Vec<usize>> {
    let mut sides = vec![[usize::MAX; 2]; arrangement.n_edges()];
    for (face, column) in arrangement.complex().boundary(2).outer_iterator().enumerate() {
        for (edge, &sign) in column.iter() {
            sides[edge][usize::from(sign > 0)] = ranks[face];
        }
    }
    let mut neighbors = vec![Vec::new(); arrangement.n_faces() + 1];
    for [a, b] in sides.into_iter().filter(|sides| !sides.contains(&usize::MAX)) {
        neighbors[a].push(b);
        neighbors[b].push(a);
    }
    for list in &mut neighbors {
        list.sort_unstable();
        list.dedup();
    }
    neighbors
}

/// Takes away a node with the fewest neighbours left, again and again; the nodes in the order in which they went.
fn smallest_last(neighbors: &[Vec<usize>]) -> Vec<usize> {
    let mut degree: Vec<usize> = neighbors.iter().map(Vec::len).collect();
    let most = degree.iter().copied().max().unwrap_or(0);
    let mut of_degree = vec![Vec::new(); most + 1];
    (0..degree.len()).rev().for_each(|node| of_degree[degree[node]].push(node));
    let mut gone = vec![false; degree.len()];
    let mut order = Vec::with_capacity(degree.len());
    let mut at = 0;
    while at <= most {
        let Some(node) = of_degree[at].pop() else {
            at += 1;
            continue;
        };
        // A node stands in the list of each degree that it has had.
        if gone[node] || degree[node] != at {
            continue;
        }
        gone[node] = true;
        order.push(node);
        for &other in neighbors[node].iter().filter(|&&other| !gone[other]) {
            degree[other] -= 1;
            of_degree[degree[other]].push(other);
        }
        at = at.saturating_sub(1);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::scenes;
    use lar_arrangement::planar::planar_arrangement;

    #[test]
    fn neighbors_differ() {
        for seed in 0..20 {
            for outlines in [scenes::circles_and_polygons(12, seed), scenes::rectangles(40, seed)] {
                let arrangement = planar_arrangement(&scenes::drawing(&outlines)).unwrap();
                let colors = face_colors(&arrangement);
                assert_eq!(colors.len(), arrangement.n_faces() + 1);
                let in_place: Vec<usize> = (0..colors.len()).collect();
                for (face, beside) in neighbors(&arrangement, &in_place).iter().enumerate() {
                    assert!(
                        beside.iter().all(|&other| colors[other] != colors[face]),
                        "seed {seed}, face {face}"
                    );
                }
            }
        }
    }

    #[test]
    fn colors_do_not_depend_on_the_order_of_the_input() {
        let mut outlines = scenes::rectangles(30, 2);
        let colored = |outlines: &[scenes::Outline]| {
            let arrangement = planar_arrangement(&scenes::drawing(outlines)).unwrap();
            let ranks = ranks(&arrangement);
            let mut colors: Vec<(usize, Color)> = ranks.into_iter().zip(face_colors(&arrangement)).collect();
            colors.sort_unstable();
            colors
        };
        let before = colored(&outlines);
        outlines.reverse();
        assert_eq!(colored(&outlines), before);
    }

    #[test]
    fn each_node_has_few_neighbors_after_it() {
        let arrangement = planar_arrangement(&scenes::drawing(&scenes::rectangles(200, 5))).unwrap();
        let neighbors = neighbors(&arrangement, &ranks(&arrangement));
        let order = smallest_last(&neighbors);
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(i, &node)| place[node] = i);
        assert_eq!(order.len(), neighbors.len());
        for (node, beside) in neighbors.iter().enumerate() {
            assert!(beside.iter().filter(|&&other| place[node] < place[other]).count() <= 5);
        }
    }
}
