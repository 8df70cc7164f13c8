//! Coherent orientation of faces given as loops, from combinatorics alone.
//!
//! Two faces agree across an edge that only they use when they run along it in opposite directions. Starting
//! from the first face of each component, agreement is spread breadth-first over such edges. Edges used once or
//! more than twice are not crossed; faces linked through nothing else are separate components.

use std::collections::VecDeque;

/// Result of [`orient`], all arrays indexed by the position of a face in its input.
pub(crate) struct Orientation {
    /// +1 keep the loop, −1 reverse it. The first face of each component is kept.
    pub(crate) signs: Vec<i8>,
    /// The component of each face, numbered in the order of their first faces.
    pub(crate) component: Vec<u32>,
    /// Per component: whether its edges cancel when all loops are taken with their signs.
    pub(crate) closed: Vec<bool>,
}

/// One use of an edge by a face: smaller vertex, larger vertex, face, +1 when run from smaller to larger.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct EdgeUse {
    pub(crate) ends: [u32; 2],
    pub(crate) face: u32,
    pub(crate) sign: i8,
}

/// The uses of all edges by the loops, sorted by edge and then by face. `loops` yields (face, loop).
pub(crate) fn edge_uses<'a>(loops: impl Iterator<Item = (u32, &'a [u32])>) -> Vec<EdgeUse> {
    let mut uses = Vec::new();
    for (face, cycle) in loops {
        for (i, &a) in cycle.iter().enumerate() {
            let b = cycle[(i + 1) % cycle.len()];
            if a != b {
                uses.push(EdgeUse { ends: [a.min(b), a.max(b)], face, sign: if a < b { 1 } else { -1 } });
            }
        }
    }
    uses.sort_unstable();
    uses
}

/// The uses of one edge after the other.
pub(crate) fn by_edge(uses: &[EdgeUse]) -> impl Iterator<Item = &[EdgeUse]> {
    uses.chunk_by(|a, b| a.ends == b.ends)
}

/// Orients faces, given as (face, loop) pairs, coherently over edges of two faces; the loops of a face turn
/// together. O(n log n) in the total size of the loops.
pub(crate) fn orient<'a>(n_faces: usize, loops: impl Iterator<Item = (u32, &'a [u32])>) -> Orientation {
    let uses = edge_uses(loops);
    let (signs, component, n_components) = spread(n_faces, &links(&uses));
    let mut closed = vec![true; n_components];
    for group in by_edge(&uses) {
        mark_open(group, &signs, &component, &mut closed);
    }
    Orientation { signs, component, closed }
}

/// Pairs of faces that share a manifold edge, both ways, sorted: (face, other face, relative sign).
fn links(uses: &[EdgeUse]) -> Vec<(u32, u32, i8)> {
    let mut links = Vec::new();
    for group in by_edge(uses) {
        if let [a, b] = group
            && a.face != b.face
        {
            let relative = -a.sign * b.sign;
            links.push((a.face, b.face, relative));
            links.push((b.face, a.face, relative));
        }
    }
    links.sort_unstable();
    links
}

fn spread(n_faces: usize, links: &[(u32, u32, i8)]) -> (Vec<i8>, Vec<u32>, usize) {
    let mut signs = vec![0_i8; n_faces];
    let mut component = vec![0; n_faces];
    let mut n_components = 0;
    let mut queue = VecDeque::new();
    for start in 0..n_faces {
        if signs[start] != 0 {
            continue;
        }
        signs[start] = 1;
        component[start] = n_components;
        queue.push_back(start);
        while let Some(face) = queue.pop_front() {
            let first = links.partition_point(|l| (l.0 as usize) < face);
            for &(_, other, relative) in links[first..].iter().take_while(|l| l.0 as usize == face) {
                let other = other as usize;
                if signs[other] == 0 {
                    signs[other] = signs[face] * relative;
                    component[other] = n_components;
                    queue.push_back(other);
                }
            }
        }
        n_components += 1;
    }
    (signs, component, n_components as usize)
}

/// Marks the components whose uses of one edge do not cancel.
fn mark_open(group: &[EdgeUse], signs: &[i8], component: &[u32], closed: &mut [bool]) {
    let mut sums: Vec<(u32, i64)> = group
        .iter()
        .map(|u| (component[u.face as usize], i64::from(u.sign * signs[u.face as usize])))
        .collect();
    sums.sort_unstable();
    for same in sums.chunk_by(|a, b| a.0 == b.0) {
        if same.iter().map(|s| s.1).sum::<i64>() != 0 {
            closed[same[0].0 as usize] = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(loops: &[&[u32]], signs: &[i8], component: &[u32], closed: &[bool]) {
        let found = orient(loops.len(), (0..).zip(loops.iter().copied()));
        assert_eq!((&found.signs[..], &found.component[..], &found.closed[..]), (signs, component, closed));
    }

    #[test]
    fn tetrahedron() {
        let faces: [&[u32]; 4] = [&[0, 1, 2], &[0, 1, 3], &[0, 2, 3], &[1, 2, 3]];
        check(&faces, &[1, -1, 1, -1], &[0; 4], &[true]);
    }

    #[test]
    fn a_fan_of_three_faces_is_not_crossed() {
        check(&[&[0, 1, 2], &[0, 1, 3], &[0, 1, 4]], &[1; 3], &[0, 1, 2], &[false; 3]);
    }

    //  0 --- 2 --- 4 --- 1'     a Möbius strip: the last square is glued to the first upside down
    //  |     |     |     |
    //  1 --- 3 --- 5 --- 0'
    #[test]
    fn moebius_strip_does_not_close() {
        check(&[&[0, 1, 3, 2], &[2, 3, 5, 4], &[4, 5, 0, 1]], &[1, 1, -1], &[0; 3], &[false]);
    }

    #[test]
    fn projective_plane_does_not_close() {
        let faces: [&[u32]; 10] = [
            &[0, 1, 2],
            &[0, 2, 3],
            &[0, 3, 4],
            &[0, 4, 5],
            &[0, 5, 1],
            &[1, 2, 4],
            &[2, 3, 5],
            &[3, 4, 1],
            &[4, 5, 2],
            &[5, 1, 3],
        ];
        assert!(by_edge(&edge_uses((0..).zip(faces))).all(|group| group.len() == 2));
        let found = orient(faces.len(), (0..).zip(faces));
        assert_eq!((found.component, found.closed), (vec![0; 10], vec![false]));
    }
}
