//! The plane of some points on the grid, and one with small coefficients near it.

use crate::kernel::{Geometry, Plane, dominant_axis};
use crate::vector::{cross, distance, dot, minus};

/// Coefficients of a canonical plane stay within ±2^40.
const COEFFICIENT: i128 = 1 << 40;

/// The plane of three points far from each other among some.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub plane: Plane,
    /// A point on it, its normal and the length of that, rounded.
    origin: [f64; 3],
    normal: [f64; 3],
    length: f64,
    /// How far the farthest of the points lies from it.
    pub deviation: f64,
}

impl Fit {
    /// `None` when all points lie on one line.
    pub(super) fn new(geometry: &Geometry, corners: &[u32]) -> Option<Self> {
        let at = |p: u32| geometry.nearest_grid_point(p);
        let float = |p: u32| geometry.position(p);
        let a = *corners.first()?;
        let farthest = |value: &dyn Fn(u32) -> f64| {
            corners.iter().copied().max_by(|&p, &q| value(p).total_cmp(&value(q)).then(q.cmp(&p)))
        };
        let b = farthest(&|p| distance(float(a), float(p)))?;
        let along = minus(float(b), float(a));
        let c = farthest(&|p| {
            let n = cross(along, minus(float(p), float(a)));
            dot(n, n)
        })?;
        let plane = Plane::through(at(a), at(b), at(c));
        let length = plane.length();
        if length == 0.0 {
            return None;
        }
        let farthest = corners.iter().map(|&p| plane.side(at(p)).unsigned_abs()).max().unwrap_or(0);
        let normal = plane.n.map(|x| x as f64);
        Some(Self { plane, origin: float(a), normal, length, deviation: farthest as f64 / length })
    }

    /// Whether a point is not farther away than some length.
    pub(super) fn is_near(&self, geometry: &Geometry, p: u32, length: f64) -> bool {
        let d = minus(geometry.position(p), self.origin);
        let magnitude: f64 = (0..3).map(|k| (self.normal[k] * d[k]).abs()).sum();
        let far = dot(self.normal, d).abs() - magnitude * 2f64.powi(-49);
        far <= length * self.length * (1.0 + 2f64.powi(-49)) && self.distance(geometry, p) <= length
    }

    pub(super) fn distance(&self, geometry: &Geometry, p: u32) -> f64 {
        (self.plane.side(geometry.nearest_grid_point(p)) as f64 / self.length).abs()
    }

    /// A plane with small coefficients near the points: the same one where it has such; else the nearest with 2^40 for
    /// its largest component, the others zero where the tolerance allows; through `key`, where that lies near enough.
    pub(super) fn canonical(&self, geometry: &Geometry, corners: &[u32], tolerance: f64, key: u32) -> Plane {
        let n = self.plane.n;
        let axis = dominant_axis(n);
        if self.deviation == 0.0 {
            let divisor = n.iter().fold(0, |g, &x| gcd(g, x.unsigned_abs())) as i128;
            if n[axis].abs() / divisor <= COEFFICIENT {
                return Plane { n: n.map(|x| x / divisor), d: self.plane.d / divisor };
            }
        }
        let small = n.map(|x| rounded_division(x * COEFFICIENT, n[axis]));
        let minor =
            if small[(axis + 1) % 3].abs() < small[(axis + 2) % 3].abs() { axis + 1 } else { axis + 2 } % 3;
        let along_axis = std::array::from_fn(|k| i128::from(k == axis));
        let without_minor = std::array::from_fn(|k| if k == minor { 0 } else { small[k] });
        let near = |n: [i128; 3]| {
            let through_key = Plane { n, d: Plane { n, d: 0 }.side(geometry.nearest_grid_point(key)) };
            [through_key, centred(geometry, corners, n)]
                .into_iter()
                .find(|plane| spread(geometry, corners, plane) as f64 <= tolerance * plane.length())
        };
        near(along_axis)
            .or_else(|| near(without_minor))
            .or_else(|| near(small))
            .unwrap_or_else(|| centred(geometry, corners, small))
    }
}

/// The plane with the normal n in the middle of the points.
fn centred(geometry: &Geometry, corners: &[u32], n: [i128; 3]) -> Plane {
    let through_origin = Plane { n, d: 0 };
    let heights = corners.iter().map(|&p| through_origin.side(geometry.nearest_grid_point(p)));
    let (low, high) = heights.fold((i128::MAX, i128::MIN), |(lo, hi), h| (lo.min(h), hi.max(h)));
    Plane { n, d: low + (high - low) / 2 }
}

/// How far the point that is farthest from a plane lies from it, times the length of the normal.
fn spread(geometry: &Geometry, corners: &[u32], plane: &Plane) -> u128 {
    corners.iter().map(|&p| plane.side(geometry.nearest_grid_point(p)).unsigned_abs()).max().unwrap_or(0)
}

fn rounded_division(x: i128, divisor: i128) -> i128 {
    let (quotient, remainder) = (x.div_euclid(divisor), x.rem_euclid(divisor));
    quotient + i128::from(2 * remainder >= divisor.abs()) * divisor.signum()
}

fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
