//! The loops of a 2-cell given as a set of vertices, convex or not, with holes or without.
//!
//! Every edge with both ends among the vertices may be a side of the cell. In a convex cell each vertex has two
//! of them, the sides. Elsewhere an edge of other cells may join two vertices of this one: a chord. A vertex
//! with two candidates left needs both; where two are needed the others are chords and fall away, which may
//! leave another vertex with two. What this does not settle is ambiguous and refused.
//!
//! Several loops are one outer loop and its holes: the outer one has the largest area, the others lie inside
//! it, beside each other, and are turned the other way. Only here coordinates are looked at.

use crate::measure::{Vec3, dot, loop_area_vector, xyz};
use crate::{Cells, FaceId, ModelError, Points, VertexId};
use std::collections::VecDeque;

/// Faces as loops, one or several each.
pub(crate) struct FaceLoops {
    loops: Cells,
    /// The first loop of each face, and the number of loops.
    first: Vec<u32>,
}

impl FaceLoops {
    pub(crate) fn new() -> Self {
        Self { loops: Cells::new(), first: vec![0] }
    }

    /// Faces of one loop each.
    pub(crate) fn single(loops: Cells) -> Self {
        let first = (0..=u32::try_from(loops.len()).expect("fewer than 2^32 loops")).collect();
        Self { loops, first }
    }

    pub(crate) fn push(&mut self, loops: &[Vec<u32>]) {
        for cycle in loops {
            self.loops.push(cycle);
        }
        self.first.push(u32::try_from(self.loops.len()).expect("fewer than 2^32 loops"));
    }

    /// The number of faces.
    pub(crate) fn len(&self) -> usize {
        self.first.len() - 1
    }

    /// The loops of face `f`.
    pub(crate) fn face(&self, f: u32) -> impl Iterator<Item = &[u32]> + Clone + '_ {
        let f = f as usize;
        (self.first[f]..self.first[f + 1]).map(|l| &self.loops[l as usize])
    }

    /// All loops with their faces.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (u32, &[u32])> + Clone + '_ {
        (0..).take(self.len()).flat_map(|f| self.face(f).map(move |cycle| (f, cycle)))
    }

    /// All loops.
    pub(crate) fn loops(&self) -> &Cells {
        &self.loops
    }

    /// The faces, those of negative sign with all loops reversed.
    pub(crate) fn signed(&self, sign: impl Fn(usize) -> i8) -> Self {
        let turned = |(f, cycle): (u32, &[u32])| {
            let mut cycle = cycle.to_vec();
            if sign(f as usize) < 0 {
                cycle.reverse();
            }
            cycle
        };
        Self { loops: self.pairs().map(turned).collect(), first: self.first.clone() }
    }
}

/// The loops that the sides of a face make, each from its smallest vertex towards that vertex's smaller
/// neighbour, in the order of their smallest vertices. O(k log k).
pub(crate) fn loops_of_face(
    face: FaceId,
    vertices: &[u32],
    edges: impl Iterator<Item = [u32; 2]>,
) -> Result<Vec<Vec<u32>>, ModelError> {
    let mut names = vertices.to_vec();
    names.sort_unstable();
    let place = |v: u32| names.partition_point(|&w| w < v);
    let mut ends: Vec<[usize; 2]> =
        edges.map(|[a, b]| [place(a.min(b)), place(a.max(b))]).filter(|[a, b]| a != b).collect();
    ends.sort_unstable();
    ends.dedup();
    let mut sides = Sides::new(names.len(), ends);
    sides.settle().map_err(|(v, edges)| ModelError::FaceNotLoop {
        face,
        vertex: VertexId(names[v]),
        edges,
    })?;
    let loops = sides.loops().into_iter();
    Ok(loops.map(|cycle| cycle.into_iter().map(|v| names[v]).collect()).collect())
}

/// The candidates for the sides of one face; vertices are numbered by their rank in the face.
struct Sides {
    ends: Vec<[usize; 2]>,
    /// The candidates left at each vertex.
    at: Vec<Vec<usize>>,
    needed: Vec<bool>,
    /// How many edges each vertex is known to need.
    n_needed: Vec<usize>,
}

impl Sides {
    fn new(n: usize, ends: Vec<[usize; 2]>) -> Self {
        let mut at = vec![Vec::new(); n];
        for (edge, pair) in ends.iter().enumerate() {
            pair.iter().for_each(|&v| at[v].push(edge));
        }
        Self { needed: vec![false; ends.len()], ends, at, n_needed: vec![0; n] }
    }

    /// Drops chords until each vertex has two edges. The error names a vertex that cannot have two, with the
    /// number of its edges.
    fn settle(&mut self) -> Result<(), (usize, usize)> {
        let mut waiting: VecDeque<usize> = (0..self.at.len()).collect();
        while let Some(v) = waiting.pop_front() {
            match (self.at[v].len(), self.n_needed[v]) {
                (2, _) => self.need(v, &mut waiting),
                (n, 2) if n > 2 => self.drop_others(v, &mut waiting),
                (n, needed) if n < 2 || needed > 2 => return Err((v, n)),
                _ => (),
            }
        }
        match (0..self.at.len()).find(|&v| self.at[v].len() != 2) {
            Some(v) => Err((v, self.at[v].len())),
            None => Ok(()),
        }
    }

    fn need(&mut self, v: usize, waiting: &mut VecDeque<usize>) {
        for edge in self.at[v].clone() {
            if !std::mem::replace(&mut self.needed[edge], true) {
                for end in self.ends[edge] {
                    self.n_needed[end] += 1;
                    waiting.push_back(end);
                }
            }
        }
    }

    fn drop_others(&mut self, v: usize, waiting: &mut VecDeque<usize>) {
        let (kept, dropped) = self.at[v].iter().partition(|&&edge| self.needed[edge]);
        self.at[v] = kept;
        let dropped: Vec<usize> = dropped;
        for edge in dropped {
            let [a, b] = self.ends[edge];
            let other = if a == v { b } else { a };
            self.at[other].retain(|&e| e != edge);
            waiting.push_back(other);
        }
    }

    /// The cycles of a graph in which every vertex has two edges.
    fn loops(&self) -> Vec<Vec<usize>> {
        let across = |edge: usize, v: usize| {
            let [a, b] = self.ends[edge];
            if a == v { b } else { a }
        };
        let mut seen = vec![false; self.at.len()];
        let mut loops = Vec::new();
        for start in 0..self.at.len() {
            let (mut cycle, mut at, mut edge) = (Vec::new(), start, self.at[start][0]);
            while !std::mem::replace(&mut seen[at], true) {
                cycle.push(at);
                at = across(edge, at);
                edge = if self.at[at][0] == edge { self.at[at][1] } else { self.at[at][0] };
            }
            if !cycle.is_empty() {
                loops.push(cycle);
            }
        }
        loops
    }
}

/// The loops with the outer one first and its holes turned the other way.
pub(crate) fn nest(
    face: FaceId,
    points: &Points,
    mut loops: Vec<Vec<u32>>,
) -> Result<Vec<Vec<u32>>, ModelError> {
    if loops.len() < 2 {
        return Ok(loops);
    }
    let refusal = |cycle: &[u32]| ModelError::FaceManyLoops { face, vertex: VertexId(cycle[0]) };
    if !(2..=3).contains(&points.dim()) {
        return Err(refusal(&loops[1]));
    }
    let size = |cycle: &[u32]| {
        let area = loop_area_vector(points, cycle);
        dot(area, area)
    };
    let sizes: Vec<f64> = loops.iter().map(|cycle| size(cycle)).collect();
    let outer = (1..loops.len()).fold(0, |best, l| if sizes[l] > sizes[best] { l } else { best });
    loops[..=outer].rotate_right(1);
    let normal = loop_area_vector(points, &loops[0]);
    let axis = (0..3).fold(0, |best, k| if normal[k].abs() > normal[best].abs() { k } else { best });
    for l in 1..loops.len() {
        let at = xyz(points, loops[l][0] as usize);
        let others = (1..loops.len()).filter(|&other| other != l);
        if !is_inside(points, &loops[0], at, axis)
            || others.into_iter().any(|o| is_inside(points, &loops[o], at, axis))
        {
            return Err(refusal(&loops[l]));
        }
    }
    for hole in &mut loops[1..] {
        if dot(loop_area_vector(points, hole), normal) > 0. {
            hole[1..].reverse();
        }
    }
    Ok(loops)
}

/// Whether a point is inside a loop, both seen along an axis: a ray in the direction of the next axis crosses
/// the loop an odd number of times. Sides are half-open, so that a vertex is counted once.
fn is_inside(points: &Points, cycle: &[u32], at: Vec3, axis: usize) -> bool {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let crosses = |&(a, b): &(&u32, &u32)| {
        let [a, b] = [a, b].map(|&v| xyz(points, v as usize));
        let ahead = || a[i] + (at[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i]) > at[i];
        (a[j] > at[j]) != (b[j] > at[j]) && ahead()
    };
    cycle.iter().zip(cycle.iter().cycle().skip(1)).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(vertices: &[u32], edges: &[[u32; 2]], expected: Result<&[&[u32]], &str>) {
        let found = loops_of_face(FaceId(7), vertices, edges.iter().copied()).map_err(|e| e.to_string());
        match (found, expected) {
            (Ok(found), Ok(expected)) => assert_eq!(found, expected),
            (found, expected) => assert_eq!(found.err().as_deref(), expected.err()),
        }
    }

    //  5 --- 4
    //  |     | \         an L with the chord 2-4 outside and the chord 0-3 inside
    //  |     3 --- 2
    //  |  /        |
    //  0 --------- 1
    #[test]
    fn chords_fall_away() {
        let square = [[0, 1], [1, 2], [2, 3], [3, 0]];
        check(&[3, 1, 2, 0], &square, Ok(&[&[0, 1, 2, 3]]));
        check(&[0, 1, 2, 3], &[&square[..], &[[0, 2]]].concat(), Ok(&[&[0, 1, 2, 3]]));
        check(&[0, 1, 2, 3], &[&square[..], &[[3, 0]]].concat(), Ok(&[&[0, 1, 2, 3]]));
        let ell: Vec<[u32; 2]> = (0..6).map(|i| [i, (i + 1) % 6]).collect();
        check(&[0, 1, 2, 3, 4, 5], &[&ell[..], &[[2, 4], [0, 3]]].concat(), Ok(&[&[0, 1, 2, 3, 4, 5]]));
        check(
            &[0, 1, 2, 3, 4, 5],
            &[&ell[..], &[[0, 2], [2, 4], [4, 0]]].concat(),
            Ok(&[&[0, 1, 2, 3, 4, 5]]),
        );
    }

    #[test]
    fn refusals() {
        let square = [[0, 1], [1, 2], [2, 3], [3, 0]];
        let all = [&square[..], &[[0, 2], [1, 3]]].concat();
        let chord = "3 edges of 2-cell f7 meet at its vertex v0 where 2 are needed: it has a chord";
        check(&[0, 1, 2, 3], &all, Err(chord));
        let open = "1 edges of 2-cell f7 meet at its vertex v0 where 2 are needed: an edge is missing";
        check(&[0, 1, 2, 3], &square[..3], Err(open));
        let alone = "0 edges of 2-cell f7 meet at its vertex v4 where 2 are needed: an edge is missing";
        check(&[0, 1, 2, 3, 4], &square, Err(alone));
        let fork = "3 edges of 2-cell f7 meet at its vertex v4 where 2 are needed: it has a chord";
        check(&[0, 1, 2, 3, 4], &[[0, 1], [0, 4], [2, 1], [2, 4], [3, 1], [3, 4]], Err(fork));
    }

    #[test]
    fn many_loops() {
        let edges = [[0, 1], [1, 2], [2, 0], [5, 4], [4, 3], [3, 5], [8, 6], [6, 7], [7, 8]];
        check(&[0, 1, 2, 3, 4, 5, 6, 7, 8], &edges, Ok(&[&[0, 1, 2], &[3, 4, 5], &[6, 7, 8]]));
    }

    fn squares(corners: &[(f64, f64)]) -> (Points, Vec<Vec<u32>>) {
        let square = |&(at, side): &(f64, f64)| {
            [at, at, 3., at + side, at, 3., at + side, at + side, 3., at, at + side, 3.]
        };
        let points = Points::from_columns(3, corners.iter().flat_map(square).collect());
        (points, (0..corners.len() as u32).map(|i| (4 * i..4 * i + 4).collect()).collect())
    }

    #[test]
    fn holes_are_turned() {
        let (points, loops) = squares(&[(1., 1.), (0., 9.), (5., 2.)]);
        let found = nest(FaceId(0), &points, loops).unwrap();
        assert_eq!(found, [[4, 5, 6, 7], [0, 3, 2, 1], [8, 11, 10, 9]]);
    }

    #[test]
    fn loops_beside_or_deep_inside_are_refused() {
        let (points, loops) = squares(&[(0., 1.), (2., 1.)]);
        let beside = nest(FaceId(0), &points, loops).unwrap_err();
        assert_eq!(beside, ModelError::FaceManyLoops { face: FaceId(0), vertex: VertexId(4) });
        let (points, loops) = squares(&[(0., 9.), (1., 5.), (2., 1.)]);
        let deep = nest(FaceId(0), &points, loops).unwrap_err();
        assert_eq!(deep, ModelError::FaceManyLoops { face: FaceId(0), vertex: VertexId(8) });
    }
}
