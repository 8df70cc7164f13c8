//! Cameras that show everything, as large as it fits.

use super::{Camera, DISTANCES, Projection};
use crate::Bounds;
use glam::{DVec2, DVec3};

/// Part of the picture's half side left free around a fitted scene.
pub(super) const FIT_MARGIN: f64 = 0.06;

/// A perspective eye stays before a fitted scene by at least this part of its depth.
pub(super) const NEAREST: f64 = 0.1;

impl Camera {
    /// The same view with the box in the middle and as large as fits in a picture of this aspect (width / height);
    /// see [`Camera::fit_points`].
    #[must_use]
    pub fn fit(self, bounds: &Bounds, aspect: f64) -> Self {
        self.fit_points(bounds.corners(), aspect)
    }

    /// The same direction of sight, from the nearest place that shows all points in a picture of this aspect
    /// (width / height), with a small margin; the target lies midway in depth. Points that are all equal are shown
    /// at unit size; without points the camera stays. O(points).
    ///
    /// Exact in one pass. With camera coordinates x, y (right, up) and z (back), and t the tangent of half the
    /// opening angle, the eye (ex, ez) sees x when |x − ex| ≤ t (ez − z). So ez + ex/t ≥ A = max(z + x/t) and
    /// ez − ex/t ≥ B = max(z − x/t), and the nearest eye has ez = (A + B)/2, ex = t (A − B)/2; the same with y, and
    /// the larger ez counts. An orthographic camera is the case z = 0.
    #[must_use]
    pub fn fit_points(self, points: impl IntoIterator<Item = [f64; 3]>, aspect: f64) -> Self {
        let tan_y = (0.5 * self.fov_y).tan() * (1.0 - FIT_MARGIN);
        let tan = DVec2::new(tan_y * aspect, tan_y);
        let [right, up, back] = self.basis();
        let mut reach: Option<Reach> = None;
        for point in points {
            let v = DVec3::from(point);
            let side = DVec2::new(v.dot(right), v.dot(up)) / tan;
            let seen = Reach::of_point(side, v.dot(back), self.projection);
            reach = Some(reach.map_or(seen, |r| r.union(seen)));
        }
        let Some(Reach { plus, minus, nearest, farthest }) = reach else { return self };
        let middle = 0.5 * (nearest + farthest);
        let eye = (0.5 * (plus + minus)).max_element();
        let away = match self.projection {
            Projection::Perspective => eye.max(nearest + NEAREST * (nearest - farthest)) - middle,
            Projection::Orthographic => eye,
        };
        let distance = if away <= *DISTANCES.start() { 1.0 / tan.min_element() } else { away };
        let side = 0.5 * tan * (plus - minus);
        let target = right * side.x + up * side.y + back * middle;
        Self { target: target.to_array(), distance: distance.min(*DISTANCES.end()), ..self }
    }
}

/// Extremes of the points that a camera is to show: of z + x/t and z − x/t, of z + y/t and z − y/t, and of z.
#[derive(Clone, Copy)]
struct Reach {
    plus: DVec2,
    minus: DVec2,
    nearest: f64,
    farthest: f64,
}

impl Reach {
    fn of_point(side: DVec2, z: f64, projection: Projection) -> Self {
        let shift = if projection == Projection::Perspective { z } else { 0.0 };
        Self { plus: side + shift, minus: -side + shift, nearest: z, farthest: z }
    }

    fn union(self, other: Self) -> Self {
        Self {
            plus: self.plus.max(other.plus),
            minus: self.minus.max(other.minus),
            nearest: self.nearest.max(other.nearest),
            farthest: self.farthest.min(other.farthest),
        }
    }
}
