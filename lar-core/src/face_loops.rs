//! The faces of a complex as polygons, and the measures that follow from them.

use crate::measure::{Vec3, dot, loop_area_vector, loop_cone_volume, xyz};
use crate::{ChainComplex, Points};

impl ChainComplex {
    /// The cyclic vertex loops of face `f`: the edges of its column of ∂2, each run along its sign, chained.
    ///
    /// A loop is cut where it returns to a vertex, so each loop is simple. Where several edges leave a vertex
    /// the one to the smallest vertex is taken first. Each loop starts at its smallest vertex and loops come in
    /// lexicographic order: which one is the outer is a question of geometry. In a valid complex every edge of
    /// the column ends up in a loop; edges of an open column that close no cycle are left out. O(k log k) for a
    /// face of k edges.
    ///
    /// # Panics
    /// When the complex has no ∂2, or `f` is not below `n_cells(2)`.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
    /// assert_eq!(square.face_loops(0), [[0, 2, 3, 1]]);
    /// ```
    #[must_use]
    pub fn face_loops(&self, f: usize) -> Vec<Vec<u32>> {
        let mut arcs = self.face_arcs(f);
        arcs.sort_unstable();
        let mut walker = Walker::new(&arcs);
        for arc in &arcs {
            walker.walk(arc[0]);
        }
        let mut loops = walker.loops;
        loops.sort_unstable();
        loops
    }

    /// The edges of face `f` as (from, to) in the direction of their signs.
    fn face_arcs(&self, f: usize) -> Vec<[u32; 2]> {
        let column = self.boundary(2).outer_view(f).expect("f is below n_cells(2)");
        let arc = |(e, &sign): (usize, &i8)| {
            let [a, b] = self.edge_ends(e)?;
            match sign {
                0 => None,
                s if s > 0 => Some([a, b]),
                _ => Some([b, a]),
            }
        };
        column.iter().filter_map(arc).collect()
    }

    /// The tail (−1) and head (+1) of edge `e` in ∂1; `None` when its column has not one of each.
    ///
    /// # Panics
    /// When the complex has no ∂1, or `e` is not below `n_cells(1)`.
    #[must_use]
    pub fn edge_ends(&self, e: usize) -> Option<[u32; 2]> {
        let column = self.boundary(1).outer_view(e).expect("e is below n_cells(1)");
        match (column.indices(), column.data()) {
            (&[a, b], [-1, 1]) => Some([a, b]),
            (&[a, b], [1, -1]) => Some([b, a]),
            _ => None,
        }
    }

    /// The area vector of face `f`: the sum of its loops' (Newell), so that holes count against the outer
    /// loop. It points along the normal and is as long as the area. Points of two coordinates lie in the plane
    /// z = 0. O(edges of the face).
    ///
    /// # Panics
    /// As [`face_loops`](Self::face_loops), and when ∂1 has more rows than there are points.
    #[must_use]
    pub fn face_area_vector(&self, f: usize) -> Vec3 {
        let mut sum = [0.; 3];
        for cycle in self.face_loops(f) {
            for (s, x) in sum.iter_mut().zip(loop_area_vector(self.points(), &cycle)) {
                *s += x;
            }
        }
        sum
    }

    /// The unit normal of face `f`, from whose tip its outer loop turns counter-clockwise; `None` when its
    /// area is zero or not finite. O(edges of the face).
    ///
    /// # Panics
    /// As [`face_area_vector`](Self::face_area_vector).
    #[must_use]
    pub fn face_normal(&self, f: usize) -> Option<Vec3> {
        let vector = self.face_area_vector(f);
        let size = vector.iter().fold(0_f64, |m, x| m.max(x.abs()));
        if size == 0. || !size.is_finite() {
            return None;
        }
        let scaled = vector.map(|x| x / size);
        let length = dot(scaled, scaled).sqrt();
        Some(scaled.map(|x| x / length))
    }

    /// The area of face `f`, holes subtracted. O(edges of the face).
    ///
    /// # Panics
    /// As [`face_area_vector`](Self::face_area_vector).
    #[must_use]
    pub fn face_area(&self, f: usize) -> f64 {
        let v = self.face_area_vector(f);
        dot(v, v).sqrt()
    }

    /// The signed volume of every 3-cell: positive for bounded cells, and for the exterior cell minus the
    /// volume of everything else. O(size).
    ///
    /// # Panics
    /// When the complex has no ∂3 or its operators do not fit each other.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
    /// assert_eq!(bar.cell_volumes(), [1., 1.]);
    /// ```
    #[must_use]
    pub fn cell_volumes(&self) -> Vec<f64> {
        let loops: Vec<_> = (0..self.n_cells(2)).map(|f| self.face_loops(f)).collect();
        let volume = |column: sprs::CsVecViewI<'_, i8, u32>| {
            let apex = column.indices().iter().find_map(|&f| apex(self.points(), &loops[f as usize]));
            let apex = apex.unwrap_or_default();
            let cone = |(f, &sign): (usize, &i8)| {
                let faces = loops[f].iter().map(|cycle| loop_cone_volume(self.points(), cycle, apex));
                f64::from(sign) * faces.sum::<f64>()
            };
            column.iter().map(cone).sum()
        };
        self.boundary(3).outer_iterator().map(volume).collect()
    }
}

fn apex(points: &Points, loops: &[Vec<u32>]) -> Option<Vec3> {
    loops.first()?.first().map(|&v| xyz(points, v as usize))
}

/// Chains arcs into simple loops.
struct Walker<'a> {
    /// (from, to), sorted.
    arcs: &'a [[u32; 2]],
    /// At the first arc of each vertex: how many of its arcs are used.
    used: Vec<usize>,
    /// At the first arc of each vertex: its last place on a path; it is there still if the path says so.
    place: Vec<Option<usize>>,
    loops: Vec<Vec<u32>>,
}

impl<'a> Walker<'a> {
    fn new(arcs: &'a [[u32; 2]]) -> Self {
        Self { arcs, used: vec![0; arcs.len()], place: vec![None; arcs.len()], loops: Vec::new() }
    }

    /// Walks unused arcs from `start` until stuck, cutting off a loop each time the path meets itself.
    fn walk(&mut self, start: u32) {
        let mut path = vec![start];
        while let Some(&at) = path.last() {
            let key = self.key(at);
            if let Some(place) = self.place.get_mut(key) {
                *place = Some(path.len() - 1);
            }
            let Some(&[_, to]) =
                self.arcs.get(key + self.used.get(key).unwrap_or(&0)).filter(|arc| arc[0] == at)
            else {
                break;
            };
            self.used[key] += 1;
            match self.place.get(self.key(to)).copied().flatten().filter(|&i| path.get(i) == Some(&to)) {
                Some(i) => self.cut(&mut path, i),
                None => path.push(to),
            }
        }
    }

    /// Cuts the loop off that starts at place `i` of the path and leaves its first vertex there.
    fn cut(&mut self, path: &mut Vec<u32>, i: usize) {
        let mut cycle = path.split_off(i);
        path.push(cycle[0]);
        let smallest = (0..cycle.len()).min_by_key(|&k| cycle[k]).unwrap_or(0);
        cycle.rotate_left(smallest);
        self.loops.push(cycle);
    }

    /// The index of the first arc from `v`, or of a vertex after it when there is none.
    fn key(&self, v: u32) -> usize {
        self.arcs.partition_point(|arc| arc[0] < v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::sign_columns;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    /// One face with the given directed edges; points on a moment curve.
    fn face(n: u32, arcs: &[[u32; 2]]) -> ChainComplex {
        let edges: BTreeSet<[u32; 2]> = arcs.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        let edges: Vec<[u32; 2]> = edges.into_iter().collect();
        let d1 = sign_columns(n as usize, edges.iter().map(|&[a, b]| [(a, -1), (b, 1)]));
        let entry = |&[a, b]: &[u32; 2]| {
            let e = edges.binary_search(&[a.min(b), a.max(b)]).unwrap();
            (u32::try_from(e).unwrap(), if a < b { 1 } else { -1 })
        };
        let d2 = sign_columns(edges.len(), std::iter::once(arcs.iter().map(entry).collect::<Vec<_>>()));
        let coords = (0..n).flat_map(|i| [f64::from(i), f64::from(i) * f64::from(i)]).collect();
        ChainComplex::new(Points::from_columns(2, coords), vec![d1, d2])
    }

    #[track_caller]
    fn check(n: u32, arcs: &[[u32; 2]], expected: &[&[u32]]) {
        assert_eq!(face(n, arcs).face_loops(0), expected);
    }

    #[test]
    fn loops() {
        check(3, &[[0, 1], [1, 2], [2, 0]], &[&[0, 1, 2]]);
        check(3, &[[0, 2], [1, 0], [2, 1]], &[&[0, 2, 1]]);
        check(6, &[[0, 1], [1, 2], [2, 0], [5, 4], [4, 3], [3, 5]], &[&[0, 1, 2], &[3, 5, 4]]);
    }

    //   1       3
    //   | \   / |      two triangles that meet in vertex 2
    //   |   2   |
    //   | /   \ |
    //   0       4
    #[test]
    fn pinched_loops_are_cut() {
        check(5, &[[0, 2], [2, 1], [1, 0], [2, 4], [4, 3], [3, 2]], &[&[0, 2, 1], &[2, 4, 3]]);
    }

    #[test]
    fn open_columns_lose_their_tails() {
        check(4, &[[0, 1], [1, 2], [2, 3]], &[]);
        check(4, &[[3, 0], [0, 1], [1, 2], [2, 0]], &[&[0, 1, 2]]);
        check(5, &[[0, 1], [1, 2], [2, 3], [3, 1], [3, 4]], &[&[1, 2, 3]]);
    }

    #[test]
    fn long_loops_take_linear_time() {
        let n = 200_000;
        let arcs: Vec<[u32; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
        let loops = face(n, &arcs).face_loops(0);
        assert_eq!((loops.len(), loops[0].len()), (1, n as usize));
    }

    #[test]
    fn holes_count_against_the_area() {
        let xy = [0., 0., 4., 0., 4., 4., 0., 4., 1., 1., 2., 1., 2., 2., 1., 2.];
        let arcs = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 7], [7, 6], [6, 5], [5, 4]];
        let ring = face(8, &arcs);
        let ring = ChainComplex::new(
            Points::from_columns(2, xy.to_vec()),
            vec![ring.boundary(1).clone(), ring.boundary(2).clone()],
        );
        assert_eq!(ring.face_area_vector(0), [0., 0., 15.]);
        assert_eq!(ring.face_normal(0), Some([0., 0., 1.]));
        assert!((ring.face_area(0) - 15.).abs() < 1e-15);
    }

    proptest! {
        /// Any sum of directed cycles is taken apart into simple loops that use the same arcs.
        #[test]
        fn loops_use_every_arc(cycles in prop::collection::vec(prop::collection::vec(0..12_u32, 3..7), 1..6)) {
            let mut arcs = BTreeSet::new();
            for cycle in &cycles {
                let mut cycle = cycle.clone();
                cycle.sort_unstable();
                cycle.dedup();
                let new: Vec<[u32; 2]> =
                    (0..cycle.len()).map(|i| [cycle[i], cycle[(i + 1) % cycle.len()]]).collect();
                let free = new.iter().all(|&[a, b]| a != b && !arcs.contains(&[a, b]) && !arcs.contains(&[b, a]));
                if free && cycle.len() > 2 {
                    arcs.extend(new);
                }
            }
            let list: Vec<[u32; 2]> = arcs.iter().copied().collect();
            let loops = face(12, &list).face_loops(0);
            let mut found = BTreeSet::new();
            for cycle in &loops {
                prop_assert_eq!(cycle.iter().collect::<BTreeSet<_>>().len(), cycle.len());
                prop_assert_eq!(cycle.iter().min(), cycle.first());
                found.extend((0..cycle.len()).map(|i| [cycle[i], cycle[(i + 1) % cycle.len()]]));
            }
            prop_assert_eq!(found, arcs);
        }
    }
}
