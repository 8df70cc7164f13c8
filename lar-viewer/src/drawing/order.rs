//! Faces back to front.
//!
//! Of two faces that overlap on the screen the one that is farther at a place of the overlap is drawn first. Where this runs in
//! circles, the face with the farthest corner of those that are left goes first.

use super::SLACK;
use super::fill::{Face, InkArea};
use super::tree::Triangle;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Pairs of triangles that are compared at most: it bounds the time where very many faces lie one behind the other; what is
/// not compared goes by its farthest corner.
const PAIRS: usize = 20_000_000;

/// Faces that are looked at for others beside them, at most: it bounds the time where very many lie above each other on the
/// screen.
const LOOKS: usize = 1 << 28;

/// The areas of faces, those behind before those in front. O(n log n + pairs that meet in their widths).
pub(super) fn back_to_front(faces: Vec<Face>) -> Vec<InkArea> {
    let boxes: Vec<Reach> = faces.iter().map(Reach::of).collect();
    let before = constraints(&faces, &boxes);
    let mut waits = vec![0_usize; faces.len()];
    before.iter().flatten().for_each(|&face| waits[face] += 1);
    let entry = |face: usize| Waiting { farthest: boxes[face].farthest, face };
    let mut by_distance: Vec<Waiting> = (0..faces.len()).map(entry).collect();
    by_distance.sort_by(|a, b| b.cmp(a));
    let mut ready: BinaryHeap<Waiting> = by_distance.iter().filter(|w| waits[w.face] == 0).copied().collect();
    let mut left = by_distance.into_iter();
    let (mut order, mut done) = (Vec::with_capacity(faces.len()), vec![false; faces.len()]);
    while let Some(Waiting { face, .. }) = ready.pop().or_else(|| left.find(|w| !done[w.face])) {
        if std::mem::replace(&mut done[face], true) {
            continue;
        }
        order.push(face);
        for &next in &before[face] {
            waits[next] = waits[next].saturating_sub(1);
            if waits[next] == 0 && !done[next] {
                ready.push(entry(next));
            }
        }
    }
    let mut areas: Vec<Option<InkArea>> = faces.into_iter().map(|face| Some(face.area)).collect();
    order.into_iter().filter_map(|face| areas[face].take()).collect()
}

/// For each face those that it must be drawn before.
fn constraints(faces: &[Face], boxes: &[Reach]) -> Vec<Vec<usize>> {
    let mut by_left: Vec<usize> = (0..faces.len()).collect();
    by_left.sort_by(|&a, &b| boxes[a].lo[0].total_cmp(&boxes[b].lo[0]).then(a.cmp(&b)));
    let mut before = vec![Vec::new(); faces.len()];
    let (mut open, mut pairs, mut looks): (Vec<usize>, usize, usize) = (Vec::new(), 0, 0);
    for face in by_left {
        looks += open.len();
        if LOOKS < looks {
            break;
        }
        open.retain(|&other| boxes[face].lo[0] < boxes[other].hi[0]);
        for &other in &open {
            if pairs < PAIRS && boxes[face].overlaps(&boxes[other]) {
                match compared(&faces[face], &faces[other], &mut pairs) {
                    Some(true) => before[other].push(face),
                    Some(false) => before[face].push(other),
                    None => {}
                }
            }
        }
        open.push(face);
    }
    before
}

/// Whether the first face is nearer than the second where they overlap; `None` where they do not or lie in each other.
fn compared(face: &Face, other: &Face, pairs: &mut usize) -> Option<bool> {
    let nearer = |s: &Triangle, t: &Triangle| {
        let at = s.place_in_both(t)?;
        let (p, q) = (s.nearness(at), t.nearness(at));
        (SLACK * (1.0 + p.abs().max(q.abs())) < (p - q).abs()).then_some(q < p)
    };
    *pairs += face.triangles.len() * other.triangles.len();
    face.triangles.iter().find_map(|s| other.triangles.iter().find_map(|t| nearer(s, t)))
}

/// The box of a face on the screen, and its farthest corner.
struct Reach {
    lo: [f64; 2],
    hi: [f64; 2],
    farthest: f64,
}

impl Reach {
    fn of(face: &Face) -> Self {
        let mut reach = Self { lo: [f64::INFINITY; 2], hi: [f64::NEG_INFINITY; 2], farthest: f64::INFINITY };
        for triangle in &face.triangles {
            for corner in triangle.corners() {
                reach.lo = std::array::from_fn(|k| reach.lo[k].min(corner[k]));
                reach.hi = std::array::from_fn(|k| reach.hi[k].max(corner[k]));
                reach.farthest = reach.farthest.min(triangle.nearness(corner));
            }
        }
        reach
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|k| self.lo[k] < other.hi[k] && other.lo[k] < self.hi[k])
    }
}

/// A face that waits to be drawn: the farthest is the greatest, of equal ones the first.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    farthest: f64,
    face: usize,
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.farthest.total_cmp(&self.farthest).then(other.face.cmp(&self.face))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::project::Seen;

    fn face(corners: [[f64; 3]; 3], name: f64) -> Face {
        let triangle = Triangle::new(corners.map(|[x, y, q]| Seen { x, y, q }), 0.0).unwrap();
        Face { triangles: vec![triangle], area: InkArea { loops: vec![], color: [0.0; 3], opacity: name } }
    }

    fn order(faces: Vec<Face>) -> Vec<f64> {
        back_to_front(faces).iter().map(|area| area.opacity).collect()
    }

    #[test]
    fn what_is_behind_comes_first_even_if_a_corner_is_nearer() {
        let flat = |q: f64, name| face([[0., 0., q], [9., 0., q], [0., 9., q]], name);
        assert_eq!(order(vec![flat(3.0, 0.3), flat(1.0, 0.1), flat(2.0, 0.2)]), [0.1, 0.2, 0.3]);
        // A floor that begins far behind a post and runs under it to the eye.
        let floor = || face([[-9., 0., 0.], [9., 0., 0.], [0., -9., 9.]], 0.1);
        let post = || face([[-1., -3., 4.], [1., -3., 4.], [0., 5., 4.]], 0.2);
        assert_eq!(order(vec![floor(), post()]), order(vec![post(), floor()]));
        assert_eq!(order(vec![post(), floor()]), [0.1, 0.2]);
    }

    #[test]
    fn circles_end() {
        let bar = |a: [f64; 2], b: [f64; 2], c: [f64; 2], q: [f64; 3], name| {
            face([[a[0], a[1], q[0]], [b[0], b[1], q[1]], [c[0], c[1], q[2]]], name)
        };
        let all = vec![
            bar([0., 0.], [10., 0.], [10., 1.], [0., 9., 9.], 0.1),
            bar([9., 0.], [10., 0.], [5., 9.], [0., 0., 9.], 0.2),
            bar([0., 0.], [1., 0.], [5., 9.], [9., 9., 0.], 0.3),
        ];
        assert_eq!(order(all).len(), 3);
        assert!(back_to_front(Vec::new()).is_empty());
    }
}
