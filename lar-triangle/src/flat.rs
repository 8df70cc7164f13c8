//! One face laid into the plane: its corners, loop after loop, scaled and projected.
//!
//! The projection drops the dominant axis of the outer loop's normal, so that no coordinate is rounded; the scale is
//! a power of two, so that only numbers 2^142 times smaller than the largest are changed (to 0). The predicates are
//! exact on what remains, without overflow or underflow.

use crate::TriangulateError;
use crate::predicates::Xy;
use lar_core::{Points, VertexId};

/// Below this a coordinate would make the exact predicates underflow (the bound is Shewchuk's, and spade's).
const TINY: f64 = spade::MIN_ALLOWED_VALUE;

/// The corners of one face; corner i of loop l is at `starts[l] + i`. Buffers are reused from face to face.
#[derive(Debug, Default)]
pub(crate) struct Flat {
    /// Point of each corner.
    pub(crate) ids: Vec<u32>,
    /// Position of each corner; the outer loop turns counter-clockwise.
    pub(crate) xy: Vec<Xy>,
    /// First corner of each loop, and the number of corners at the end.
    pub(crate) starts: Vec<u32>,
    /// The first corner at the same point, for each corner; filled by [`Flat::identify`].
    pub(crate) twin: Vec<u32>,
    order: Vec<u32>,
    xyz: Vec<[f64; 3]>,
}

impl Flat {
    /// Reads the corners of a face.
    pub(crate) fn load<'a>(
        &mut self,
        points: &Points,
        loops: impl IntoIterator<Item = &'a [u32]>,
    ) -> Result<(), TriangulateError> {
        if !(2..=3).contains(&points.dim()) {
            return Err(TriangulateError::Dimension { found: points.dim(), expected: "2 or 3" });
        }
        self.ids.clear();
        self.starts.clear();
        self.starts.push(0);
        for (index, cycle) in loops.into_iter().enumerate() {
            if cycle.len() < 3 {
                return Err(TriangulateError::ShortLoop { index, corners: cycle.len() });
            }
            self.ids.extend_from_slice(cycle);
            self.starts.push(small(self.ids.len())?);
        }
        match self.ids.iter().find(|&&id| id as usize >= points.len()) {
            None => Ok(()),
            Some(&id) => Err(TriangulateError::NoSuchVertex { vertex: VertexId(id), points: points.len() }),
        }
    }

    /// Lays the corners that were read into the plane.
    pub(crate) fn lay(&mut self, points: &Points) {
        self.place(points);
        self.project();
    }

    /// The points of a face that is one triangle.
    pub(crate) fn triangle(&self) -> Option<[u32; 3]> {
        self.ids[..].try_into().ok()
    }

    /// Number of loops.
    pub(crate) fn n_loops(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of corners.
    pub(crate) fn len(&self) -> usize {
        self.ids.len()
    }

    /// The corners of each loop.
    pub(crate) fn loops(&self) -> impl ExactSizeIterator<Item = std::ops::Range<u32>> + Clone + '_ {
        self.starts.windows(2).map(|w| w[0]..w[1])
    }

    /// The points of the corners of each loop.
    pub(crate) fn id_loops(&self) -> impl ExactSizeIterator<Item = &[u32]> + Clone + '_ {
        self.starts.windows(2).map(|w| &self.ids[w[0] as usize..w[1] as usize])
    }

    /// The loops' edges as pairs of corners.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.loops()
            .flat_map(|l| (l.start..l.end).map(move |i| (i, if i + 1 < l.end { i + 1 } else { l.start })))
    }

    /// Fills `twin`; true when no point is met twice.
    pub(crate) fn identify(&mut self) -> bool {
        let Self { ids, twin, order, .. } = self;
        order.clear();
        order.extend((0u32..).take(ids.len()));
        order.sort_unstable_by_key(|&i| (ids[i as usize], i));
        twin.clear();
        twin.resize(ids.len(), 0);
        let mut distinct = true;
        for (k, &i) in order.iter().enumerate() {
            let before = k.checked_sub(1).map(|k| order[k]).filter(|&j| ids[j as usize] == ids[i as usize]);
            distinct &= before.is_none();
            twin[i as usize] = before.map_or(i, |j| twin[j as usize]);
        }
        distinct
    }

    /// Positions of the corners, scaled by a power of two to at most 1 (for extreme magnitudes, to at most 2^24).
    fn place(&mut self, points: &Points) {
        self.xyz.clear();
        let mut largest = 0f64;
        for &id in &self.ids {
            let mut at = [0.0; 3];
            for (to, &from) in at.iter_mut().zip(points.point(id as usize)) {
                *to = if from.is_finite() { from } else { 0.0 };
                largest = largest.max(to.abs());
            }
            self.xyz.push(at);
        }
        let scale = unit_scale(largest);
        for x in self.xyz.as_flattened_mut() {
            *x = flush(*x * scale);
        }
    }

    /// Drops the dominant axis of the outer loop's normal.
    fn project(&mut self) {
        let outer = self.starts.get(1).map_or(0, |&end| end as usize);
        let normal = newell(&self.xyz[..outer]);
        let axis = [2, 1, 0].into_iter().max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()));
        let (mut u, mut v) = match axis {
            Some(0) => (1, 2),
            Some(1) => (2, 0),
            _ => (0, 1),
        };
        if normal[3 - u - v] < 0.0 {
            (u, v) = (v, u);
        }
        self.xy.clear();
        self.xy.extend(self.xyz.iter().map(|p| [p[u], p[v]]));
    }
}

/// A count as a 32-bit index; the highest value is kept for "none".
pub(crate) fn small(count: usize) -> Result<u32, TriangulateError> {
    u32::try_from(count).ok().filter(|&n| n < u32::MAX / 4).ok_or(TriangulateError::TooMany { count })
}

/// The power of two that brings `largest` near 1.
pub(crate) fn unit_scale(largest: f64) -> f64 {
    let exponent = i32::try_from(largest.to_bits() >> 52 & 0x7ff).map_or(0, |e| e - 1022);
    // 2^±1000 is representable whatever the sign, and leaves even the largest number at 2^24.
    2f64.powi(-exponent.clamp(-1000, 1000))
}

/// 0 for numbers too small for the exact predicates.
pub(crate) fn flush(x: f64) -> f64 {
    if x.abs() < TINY { 0.0 } else { x }
}

/// Newell's normal: twice the area vector of a closed polygon.
pub(crate) fn newell(polygon: &[[f64; 3]]) -> [f64; 3] {
    let Some((&o, rest)) = polygon.split_first() else { return [0.0; 3] };
    let from_o = |p: [f64; 3]| [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
    let mut sum = [0.0; 3];
    for pair in rest.windows(2) {
        let (a, b) = (from_o(pair[0]), from_o(pair[1]));
        sum[0] += a[1] * b[2] - a[2] * b[1];
        sum[1] += a[2] * b[0] - a[0] * b[2];
        sum[2] += a[0] * b[1] - a[1] * b[0];
    }
    sum
}
