//! Lawson flips: from any triangulation of a polygon to *the* constrained Delaunay triangulation.
//!
//! Where four points lie on one circle, the diagonal at the point with the smallest index is taken. That is what
//! lowering each point on the paraboloid by an infinitesimal amount does, smaller indices by more, so the choice
//! is consistent and the result is unique: it depends on the points and edges only, not on where the loop
//! starts, nor on which algorithm made the first triangulation.
//!
//! Cost: O(n log n) plus the flips; none when the triangulation is Delaunay already, O(n²) at worst.

use crate::predicates::{Xy, incircle, orient};

const NONE: u32 = u32::MAX;

/// Buffers of the flips.
#[derive(Debug, Default)]
pub(crate) struct Flips {
    /// Half-edge 3t + k runs from corner k of triangle t to the next; this is the other half, or `NONE`.
    mate: Vec<u32>,
    keys: Vec<(u32, u32, u32)>,
    todo: Vec<u32>,
}

impl Flips {
    /// Makes the triangles, all of positive area, constrained Delaunay. Edges on one triangle only stay, and so do
    /// `fixed` ones, sorted pairs in increasing order. Ties are broken by `ids`.
    pub(crate) fn legalize(
        &mut self,
        triangles: &mut [[u32; 3]],
        xy: &[Xy],
        ids: &[u32],
        fixed: &[(u32, u32)],
    ) {
        self.pair_up(triangles, fixed);
        self.todo.clear();
        self.todo.extend((0u32..).zip(&self.mate).filter(|&(h, &m)| m != NONE && h < m).map(|(h, _)| h));
        while let Some(h) = self.todo.pop() {
            if self.mate[h as usize] != NONE && self.is_illegal(h, triangles, xy, ids) {
                self.flip(h, triangles);
            }
        }
    }

    fn pair_up(&mut self, triangles: &[[u32; 3]], fixed: &[(u32, u32)]) {
        self.keys.clear();
        for h in 0..3 * triangles.len() as u32 {
            let (from, to) = (origin(h, triangles), origin(next(h), triangles));
            self.keys.push((from.min(to), from.max(to), h));
        }
        self.keys.sort_unstable();
        self.mate.clear();
        self.mate.resize(self.keys.len(), NONE);
        for pair in self.keys.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            if let [(low, high, h), (.., m)] = *pair
                && fixed.binary_search(&(low, high)).is_err()
            {
                self.mate[h as usize] = m;
                self.mate[m as usize] = h;
            }
        }
    }

    fn is_illegal(&self, h: u32, triangles: &[[u32; 3]], xy: &[Xy], ids: &[u32]) -> bool {
        let [a, b, c, d] = [h, next(h), prev(h), prev(self.mate[h as usize])].map(|h| origin(h, triangles));
        let at = |i: u32| xy[i as usize];
        let inside = incircle(at(a), at(b), at(c), at(d));
        let id = |i: u32| ids[i as usize];
        let illegal = inside > 0.0 || (inside == 0.0 && id(c).min(id(d)) < id(a).min(id(b)));
        illegal && orient(at(a), at(d), at(c)) > 0.0 && orient(at(d), at(b), at(c)) > 0.0
    }

    /// Turns the diagonal a–b of the quadrilateral a d b c into d–c.
    fn flip(&mut self, h: u32, triangles: &mut [[u32; 3]]) {
        let m = self.mate[h as usize];
        let [a, b, c, d] = [h, next(h), prev(h), prev(m)].map(|h| origin(h, triangles));
        let [bc, ca, ad, db] = [next(h), prev(h), next(m), prev(m)].map(|h| self.mate[h as usize]);
        let (t, s) = (h / 3, m / 3);
        triangles[t as usize] = [a, d, c];
        triangles[s as usize] = [b, c, d];
        let halves = [(3 * t, ad), (3 * t + 1, 3 * s + 1), (3 * t + 2, ca), (3 * s, bc), (3 * s + 2, db)];
        for (half, mate) in halves {
            self.mate[half as usize] = mate;
            if mate != NONE {
                self.mate[mate as usize] = half;
            }
        }
        self.todo.extend([3 * t, 3 * t + 2, 3 * s, 3 * s + 2]);
    }
}

fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

fn prev(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

fn origin(h: u32, triangles: &[[u32; 3]]) -> u32 {
    triangles[h as usize / 3][h as usize % 3]
}
