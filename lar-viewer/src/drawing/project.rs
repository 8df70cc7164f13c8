//! From the world to the screen: positions in pixels and a nearness that is affine there.

use crate::{Camera, Projection};
use glam::DVec3;

/// What lies nearer to the eye than this part of the distance to the target is cut off.
const NEAREST: f64 = 1e-3;

/// A point on the screen: pixels from the middle, y upwards, and its nearness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    pub(super) x: f64,
    pub(super) y: f64,
    /// 1/depth in perspective, −depth otherwise: larger is nearer.
    pub(super) q: f64,
}

impl Seen {
    pub(super) fn screen(self) -> [f64; 2] {
        [self.x, self.y]
    }
}

/// A camera, ready to project many points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projector {
    camera: Camera,
    axes: [DVec3; 3],
    /// World units in a pixel of the target plane.
    unit: f64,
}

impl Projector {
    pub(super) fn new(camera: &Camera, height: f64) -> Self {
        Self { camera: *camera, axes: camera.axes().map(DVec3::from), unit: camera.world_per_pixel(height) }
    }

    /// How far a point lies behind what can be seen; nothing is behind a parallel projection.
    pub(super) fn behind(&self, p: [f64; 3]) -> f64 {
        match self.camera.projection {
            Projection::Perspective => NEAREST * self.camera.distance - self.camera.depth(p),
            Projection::Orthographic => -1.0,
        }
    }

    pub(super) fn seen(&self, p: [f64; 3]) -> Seen {
        let v = DVec3::from(p) - DVec3::from(self.camera.target);
        let depth = self.camera.distance - v.dot(self.axes[2]);
        let (shrink, q) = match self.camera.projection {
            Projection::Perspective => (self.camera.distance / depth, self.camera.distance / depth),
            Projection::Orthographic => (1.0, -depth / self.camera.distance),
        };
        let scale = shrink / self.unit;
        Seen { x: v.dot(self.axes[0]) * scale, y: v.dot(self.axes[1]) * scale, q }
    }
}

/// The part of a convex polygon, a segment or a point where `height` ≤ 0; `height` is affine.
pub(super) fn clip_polygon(corners: &[[f64; 3]], height: impl Fn([f64; 3]) -> f64) -> Vec<[f64; 3]> {
    let heights: Vec<f64> = corners.iter().map(|&p| height(p)).collect();
    if heights.iter().all(|h| *h <= 0.0) {
        return corners.to_vec();
    }
    let n = corners.len();
    // A segment has one side, a polygon as many as corners.
    let sides = if n == 2 { 1 } else { n };
    let mut kept = Vec::with_capacity(n + 1);
    for i in 0..n {
        let j = (i + 1) % n;
        if heights[i] <= 0.0 {
            kept.push(corners[i]);
        }
        if i < sides && (heights[i] < 0.0 && 0.0 < heights[j] || 0.0 < heights[i] && heights[j] < 0.0) {
            let t = heights[i] / (heights[i] - heights[j]);
            kept.push(std::array::from_fn(|k| corners[i][k] + t * (corners[j][k] - corners[i][k])));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_segments_and_points_are_cut() {
        let height = |p: [f64; 3]| p[2] - 1.0;
        let triangle = [[0., 0., 0.], [2., 0., 0.], [0., 0., 2.]];
        assert_eq!(clip_polygon(&triangle, height), [[0., 0., 0.], [2., 0., 0.], [1., 0., 1.], [0., 0., 1.]]);
        assert_eq!(clip_polygon(&triangle[1..], height), [[2., 0., 0.], [1., 0., 1.]]);
        assert_eq!(clip_polygon(&[triangle[2], triangle[1]], height), [[1., 0., 1.], [2., 0., 0.]]);
        assert!(clip_polygon(&triangle[2..], height).is_empty());
        assert_eq!(clip_polygon(&triangle[..1], height), triangle[..1]);
    }

    #[test]
    fn points_are_seen_where_the_camera_projects_them() {
        for camera in [Camera::default(), Camera::default().toggle_projection()] {
            let p = [0.4, -0.3, 0.8];
            let [x, y] = camera.project(p, 300.0).unwrap();
            let seen = Projector::new(&camera, 300.0).seen(p);
            assert!((seen.x - x).abs() < 1e-9 && (seen.y + y).abs() < 1e-9, "{seen:?} is not {x}, {y}");
            let nearer = Projector::new(&camera, 300.0).seen(camera.axes()[2]);
            assert!(Projector::new(&camera, 300.0).seen([0.0; 3]).q < nearer.q);
        }
    }
}
