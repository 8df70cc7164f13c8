//! One face: which way its triangulation is found, and how it is verified.
//!
//! 1. A triangle is its own triangulation; a quadrilateral takes the better of its two diagonals.
//! 2. A small face without holes: ear clipping, then flips to constrained Delaunay.
//! 3. Any other: constrained Delaunay through spade; the result is verified (positive areas, all laws).
//! 4. When neither gives a true triangulation because rounding made the loops touch, fold or collapse: bridges and
//!    ears, which keep the combinatorial laws on any positions; where even they break one, the fan over sewn holes.

use crate::TriangulateError;
use crate::cdt::Cdt;
use crate::ears::Ears;
use crate::fan::fan;
use crate::flat::Flat;
use crate::flips::Flips;
use crate::laws::check_laws;
use crate::predicates::{incircle, orient};
use lar_core::Points;

/// Up to this number of corners ears and flips beat spade (measured: about even here), and their quadratic worst
/// case does not matter.
const SMALL: usize = 64;

/// How good the triangulation of a face is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// The triangles tile the projected face: all have positive area, none overlap.
    Proper,
    /// No such triangulation exists or was found: rounding made the loops touch, fold or collapse. The laws of
    /// [`check_laws`] hold nevertheless when the points of the loops are all different.
    Combinatorial,
}

/// Triangulates faces one after the other, with buffers that are reused.
///
/// ```
/// use lar_core::Points;
/// use lar_triangle::{Quality, Triangulator};
///
/// let square = Points::from_columns(2, vec![0., 0., 1., 0., 1., 1., 0., 1.]);
/// let mut triangles = Vec::new();
/// let quality = Triangulator::new().face(&square, [&[0, 1, 2, 3][..]], &mut triangles)?;
/// assert_eq!(quality, Quality::Proper);
/// assert_eq!(triangles, [[0, 1, 2], [0, 2, 3]]);
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
#[derive(Debug, Default)]
pub struct Triangulator {
    flat: Flat,
    ears: Ears,
    flips: Flips,
    /// Triangles of corners.
    corners: Vec<[u32; 3]>,
}

impl Triangulator {
    /// A triangulator with empty buffers.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends the triangles of a face, as [`triangulate_face`] gives them, to `out`.
    /// O(n log n) for n corners, as a rule.
    ///
    /// # Errors
    /// As [`triangulate_face`]; `out` is unchanged then.
    pub fn face<'a>(
        &mut self,
        points: &Points,
        loops: impl IntoIterator<Item = &'a [u32]>,
        out: &mut Vec<[u32; 3]>,
    ) -> Result<Quality, TriangulateError> {
        self.flat.load(points, loops)?;
        if let Some(triangle) = self.flat.triangle() {
            out.push(smallest_first(triangle));
            return Ok(Quality::Proper);
        }
        self.flat.lay(points);
        self.corners.clear();
        let quality = self.fill();
        let first = out.len();
        let ids = &self.flat.ids;
        out.extend(self.corners.iter().map(|t| smallest_first(t.map(|i| ids[i as usize]))));
        out[first..].sort_unstable();
        Ok(quality)
    }

    fn fill(&mut self) -> Quality {
        match (self.flat.n_loops(), self.flat.len()) {
            (0, _) => return Quality::Proper,
            (1, 4) => {
                if let Some(two) = quadrilateral(&self.flat) {
                    self.corners.extend(two);
                    return Quality::Proper;
                }
            }
            _ => {}
        }
        let distinct = self.flat.identify();
        let small = self.flat.n_loops() == 1 && self.flat.len() <= SMALL && distinct;
        if !small && self.delaunay() {
            return Quality::Proper;
        }
        self.corners.clear();
        let proper = self.ears.clip(&self.flat, &mut self.corners);
        if small {
            if proper {
                self.flips.legalize(&mut self.corners, &self.flat.xy, &self.flat.ids, &[]);
            }
        } else if !self.is_lawful() {
            if distinct {
                self.corners.clear();
                fan(&self.flat, &mut self.corners);
            }
            return Quality::Combinatorial;
        }
        if proper { Quality::Proper } else { Quality::Combinatorial }
    }

    /// Constrained Delaunay triangles; false when there are none that pass the checks.
    fn delaunay(&mut self) -> bool {
        let Some(slits) = self.insert_walls() else { return false };
        let xy = &self.flat.xy;
        let positive = self
            .corners
            .iter()
            .all(|&[a, b, c]| orient(xy[a as usize], xy[b as usize], xy[c as usize]) > 0.0);
        if !positive || !self.is_lawful() {
            return false;
        }
        self.flips.legalize(&mut self.corners, xy, &self.flat.ids, &slits);
        true
    }

    /// Fills `corners` through spade and returns the edges that the loops walk in both directions.
    fn insert_walls(&mut self) -> Option<Vec<(u32, u32)>> {
        let flat = &self.flat;
        let used = (0u32..).zip(&flat.twin).filter(|&(i, &first)| i == first).map(|(i, _)| i).collect();
        let mut cdt = Cdt::new(&flat.xy, used)?;
        let mut edges: Vec<(u32, u32)> = Vec::with_capacity(flat.len());
        for (from, to) in flat.edges() {
            let (from, to) = (flat.twin[from as usize], flat.twin[to as usize]);
            cdt.add_wall(from, to)?;
            edges.push((from.min(to), from.max(to)));
        }
        self.corners.extend(cdt.inner_triangles());
        edges.sort_unstable();
        let mut slits: Vec<_> = edges.windows(2).filter(|w| w[0] == w[1]).map(|w| w[0]).collect();
        slits.dedup();
        Some(slits)
    }

    fn is_lawful(&self) -> bool {
        let ids = &self.flat.ids;
        let of_ids: Vec<[u32; 3]> = self.corners.iter().map(|t| t.map(|i| ids[i as usize])).collect();
        check_laws(self.flat.id_loops(), &of_ids).is_ok()
    }
}

/// Triangulates a nearly planar polygon with holes.
///
/// `points` is 2 × n or 3 × n; `loops` are the outer loop, counter-clockwise seen from the tip of the normal, then
/// the holes, clockwise. The polygon is projected along the dominant axis of the outer loop's normal (in 3D) and its
/// constrained Delaunay triangulation found with exact predicates; where four corners lie on one circle the
/// diagonal at the smallest point index is taken. The triangles have the given points only, turn like the outer loop,
/// begin with their smallest index and are sorted; the result does not depend on where a loop starts.
///
/// Positions are never refused. When rounding made the loops touch, fold, cross or collapse, the result is a
/// combinatorial triangulation that obeys [`check_laws`] (the fallback). Coordinates that are not finite count as 0.
/// Points that occur twice in the loops are allowed where the face touches itself.
///
/// Time O(n log n) for ordinary faces; the fallback O(n²) at worst.
///
/// # Errors
/// [`TriangulateError::NoSuchVertex`] when a loop names no point, [`TriangulateError::ShortLoop`] when a loop has
/// fewer than three corners, [`TriangulateError::Dimension`] for points of other than 2 or 3 coordinates.
///
/// Sources: Lawson, "Software for C1 surface interpolation" (1977); Meisters, "Polygons have ears" (1975); Eberly,
/// "Triangulation by ear clipping" (2008).
///
/// ```
/// use lar_core::Points;
/// use lar_triangle::{check_laws, triangulate_face};
///
/// // A square in the plane x = 2 with a square hole.
/// let points = Points::from_xyz(&[
///     [2., 0., 0.], [2., 3., 0.], [2., 3., 3.], [2., 0., 3.],
///     [2., 1., 1.], [2., 1., 2.], [2., 2., 2.], [2., 2., 1.],
/// ]);
/// let loops: [&[u32]; 2] = [&[0, 1, 2, 3], &[4, 5, 6, 7]];
/// let triangles = triangulate_face(&points, &loops)?;
/// assert_eq!(triangles.len(), 8 + 2 - 2);
/// assert!(check_laws(loops, &triangles).is_ok());
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
pub fn triangulate_face(points: &Points, loops: &[&[u32]]) -> Result<Vec<[u32; 3]>, TriangulateError> {
    let mut triangles = Vec::new();
    Triangulator::new().face(points, loops.iter().copied(), &mut triangles)?;
    Ok(triangles)
}

/// The Delaunay diagonal of a quadrilateral that has one; `None` when both diagonals give a triangle without area.
fn quadrilateral(flat: &Flat) -> Option<[[u32; 3]; 2]> {
    let at = |i: u32| flat.xy[i as usize];
    let turns = |[a, b, c]: [u32; 3]| orient(at(a), at(b), at(c)) > 0.0;
    let (even, odd) = ([[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]]);
    let (even_fits, odd_fits) = (even.into_iter().all(turns), odd.into_iter().all(turns));
    if even_fits && odd_fits {
        let inside = incircle(at(0), at(1), at(2), at(3));
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| flat.ids[i]);
        let take_odd = inside > 0.0 || (inside == 0.0 && b.min(d) < a.min(c));
        return Some(if take_odd { odd } else { even });
    }
    if even_fits { Some(even) } else { odd_fits.then_some(odd) }
}

/// The triangle, turned so that its smallest index comes first.
pub(crate) fn smallest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if b < a && b < c {
        [b, c, a]
    } else if c < a && c < b {
        [c, a, b]
    } else {
        [a, b, c]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A star around the origin with smaller stars as holes, on a lattice so that many points lie on common circles.
    fn lattice_star(corners: usize, holes: usize, seed: u64) -> (Points, Vec<Vec<u32>>) {
        let mut state = seed;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        let mut coords = Vec::new();
        let mut loops: Vec<Vec<u32>> = Vec::new();
        let mut star = |n: usize, centre: [f64; 2], sign: f64, low: f64, high: f64| {
            let first = coords.len() as u32 / 2;
            for i in 0..n {
                let (s, c) = (sign * std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
                let r = low + (high - low) * random();
                coords.extend([(centre[0] + r * c).round(), (centre[1] + r * s).round()]);
            }
            loops.push((first..first + n as u32).collect());
        };
        star(corners, [0.0, 0.0], 1.0, 90.0, 160.0);
        for h in 0..holes {
            let (s, c) = (std::f64::consts::TAU * h as f64 / holes as f64).sin_cos();
            star(4 + h % 5, [45.0 * c, 45.0 * s], -1.0, 5.0, 14.0);
        }
        (Points::from_columns(2, coords), loops)
    }

    fn by_ears(triangulator: &mut Triangulator) -> bool {
        triangulator.corners.clear();
        let proper = triangulator.ears.clip(&triangulator.flat, &mut triangulator.corners);
        triangulator.flips.legalize(
            &mut triangulator.corners,
            &triangulator.flat.xy,
            &triangulator.flat.ids,
            &[],
        );
        proper
    }

    fn sorted(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
        let mut sorted: Vec<_> = triangles.iter().map(|&t| smallest_first(t)).collect();
        sorted.sort_unstable();
        sorted
    }

    /// Both ways to a proper triangulation end in the same one.
    #[track_caller]
    fn check_ways_agree(points: &Points, loops: &[Vec<u32>]) {
        let mut triangulator = Triangulator::new();
        triangulator.flat.load(points, loops.iter().map(Vec::as_slice)).expect("well-formed");
        triangulator.flat.lay(points);
        assert!(triangulator.flat.identify());
        assert!(triangulator.delaunay());
        let through_spade = sorted(&triangulator.corners);
        assert!(by_ears(&mut triangulator));
        assert!(triangulator.is_lawful());
        assert_eq!(sorted(&triangulator.corners), through_spade);
    }

    #[test]
    fn ears_and_spade_agree() {
        for seed in 0..300 {
            let (points, loops) = lattice_star(5 + seed as usize % 60, seed as usize % 7, seed);
            check_ways_agree(&points, &loops);
        }
    }

    #[test]
    fn the_fan_is_lawful() {
        let points = Points::from_columns(2, vec![0.0; 200]);
        for sizes in [&[3][..], &[3, 3], &[4, 3, 3], &[3, 5, 4, 3], &[9, 3, 3, 3, 3, 12]] {
            let mut first = 0;
            let mut triangulator = Triangulator::new();
            let loops = sizes.iter().map(|&n| {
                first += n;
                (first - n..first).collect::<Vec<u32>>()
            });
            let loops: Vec<Vec<u32>> = loops.collect();
            triangulator.flat.load(&points, loops.iter().map(Vec::as_slice)).expect("well-formed");
            triangulator.flat.lay(&points);
            fan(&triangulator.flat, &mut triangulator.corners);
            assert_eq!(
                check_laws(loops.iter().map(Vec::as_slice), &triangulator.corners),
                Ok(()),
                "{sizes:?}"
            );
        }
    }
}
