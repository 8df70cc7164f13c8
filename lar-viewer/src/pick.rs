//! What is under the cursor: an element of a drawable, its cell, and the point of it that is seen.

use crate::gpu::picking::Seen;
use crate::{Camera, CellRef, Projection, Scene, View};
use glam::DVec3;

/// What is seen at a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the drawable in [`Scene::drawables`].
    pub drawable: usize,
    /// Index of its triangle, segment or dot.
    pub element: usize,
    /// The cell that the element shows; see [`crate::Drawable::cell_of_element`].
    pub cell: Option<CellRef>,
    /// The cell that the whole drawable shows: the 3-cell on whose face the cursor is.
    pub owner: Option<CellRef>,
    /// The point that is seen, in the scene before it is exploded.
    pub point: [f64; 3],
    /// How far the explosion moves it.
    pub moved: [f64; 3],
    /// The pixel, from the left and the top.
    pub pixel: [u32; 2],
}

impl Hit {
    /// What was seen of a scene whose centre is `center`.
    pub(crate) fn new(scene: &Scene, center: [f64; 3], view: &View, size: [u32; 2], seen: Seen) -> Self {
        let Seen { drawable, element, pixel, .. } = seen;
        let shown = &scene.drawables()[drawable];
        let element = shown.label_of_stroke(element).unwrap_or(element);
        let moved = scene.displacement(shown, &view.explode, center);
        let [width, height] = size.map(f64::from);
        let cursor = [f64::from(pixel[0]) + 0.5 - 0.5 * width, f64::from(pixel[1]) + 0.5 - 0.5 * height];
        let (origin, direction) = ray(&view.camera, cursor, height);
        let point = point_on(&shown.corners_of_element(element), origin - DVec3::from(moved), direction);
        let (cell, owner) = (shown.cell_of_element(element), shown.cell_ref());
        Self { drawable, element, cell, owner, point: point.to_array(), moved, pixel }
    }
}

/// Origin and direction of the line of sight at `cursor`, in pixels from the middle of a picture `height` pixels high,
/// x to the right and y down.
fn ray(camera: &Camera, cursor: [f64; 2], height: f64) -> (DVec3, DVec3) {
    let [right, up, back] = camera.axes().map(DVec3::from);
    let scale = camera.world_per_pixel(height);
    let seen = DVec3::from(camera.target) + right * (cursor[0] * scale) - up * (cursor[1] * scale);
    let eye = DVec3::from(camera.eye());
    match camera.projection {
        Projection::Perspective => (eye, seen - eye),
        Projection::Orthographic => (seen + back * camera.distance, -back),
    }
}

/// The point of a triangle's plane, a segment or a dot that a ray meets or comes nearest to.
fn point_on(corners: &[[f64; 3]], origin: DVec3, direction: DVec3) -> DVec3 {
    let corners: Vec<DVec3> = corners.iter().copied().map(DVec3::from).collect();
    match *corners.as_slice() {
        [a, b, c] => {
            let normal = (b - a).cross(c - a);
            let along = normal.dot(a - origin) / normal.dot(direction);
            if along.is_finite() { origin + along * direction } else { (a + b + c) / 3.0 }
        }
        [a, b] => {
            // Least distance of a + t (b − a) from the ray: t solves the normal equations of both lines.
            let (u, w) = (b - a, a - origin);
            let (uu, uv, vv) = (u.dot(u), u.dot(direction), direction.dot(direction));
            let t = (uv * direction.dot(w) - vv * u.dot(w)) / (uu * vv - uv * uv);
            a + if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.5 } * u
        }
        [a] => a,
        _ => origin,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_meet_what_they_see() {
        let (origin, down) = (DVec3::new(0.25, 0.25, 5.0), DVec3::new(0.0, 0.0, -2.0));
        let near = |corners: &[[f64; 3]], expected: [f64; 3]| {
            let found = point_on(corners, origin, down);
            assert!(found.abs_diff_eq(expected.into(), 1e-12), "{found}");
        };
        near(&[[0., 0., 1.], [1., 0., 1.], [0., 1., 1.]], [0.25, 0.25, 1.0]);
        near(&[[0., 0., 1.], [1., 0., 1.]], [0.25, 0.0, 1.0]);
        near(&[[1., 0., 1.], [2., 0., 1.]], [1.0, 0.0, 1.0]);
        near(&[[0.25, 0.25, 1.], [0.25, 0.25, 2.]], [0.25, 0.25, 1.5]);
        near(&[[9., 8., 7.]], [9.0, 8.0, 7.0]);
    }

    #[test]
    fn rays_pass_through_the_point_that_is_projected_there() {
        for camera in [Camera::default(), Camera::default().toggle_projection()] {
            let p = [0.3, -0.2, 0.4];
            let cursor = camera.project(p, 480.0).unwrap();
            let (origin, direction) = ray(&camera, cursor, 480.0);
            let offset = DVec3::from(p) - origin;
            let beside = offset - offset.project_onto(direction);
            assert!(beside.length() < 1e-12, "{beside} with {:?}", camera.projection);
        }
    }
}
