//! Cameras as matrices.

use super::{Camera, Projection};
use glam::{DMat3, DMat4, DVec3, DVec4};

impl Camera {
    /// The transformation from the world to camera axes with the eye at the origin and looking along −z.
    pub(crate) fn view_from_world(&self) -> DMat4 {
        let [right, up, back] = self.basis();
        let rotation = DMat3::from_cols(right, up, back).transpose();
        let target = rotation * DVec3::from(self.target);
        DMat4::from_mat3_translation(rotation, -target - DVec3::new(0.0, 0.0, self.distance))
    }

    /// The same camera for a world whose origin is `center` and whose unit of length is `unit`.
    pub(crate) fn relative_to(self, center: [f64; 3], unit: f64) -> Self {
        let target = std::array::from_fn(|k| (self.target[k] - center[k]) / unit);
        Self { target, distance: self.distance / unit, ..self }
    }

    /// The projection to clip space (depth 0 at `near` to 1 at `far`) in a picture of this aspect.
    pub(crate) fn clip_from_view(&self, aspect: f64, near: f64, far: f64) -> DMat4 {
        let cot = 1.0 / (0.5 * self.fov_y).tan();
        match self.projection {
            Projection::Perspective => {
                let z = far / (near - far);
                DMat4::from_cols(
                    DVec4::new(cot / aspect, 0.0, 0.0, 0.0),
                    DVec4::new(0.0, cot, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, z, -1.0),
                    DVec4::new(0.0, 0.0, near * z, 0.0),
                )
            }
            Projection::Orthographic => {
                let scale = cot / self.distance;
                let z = 1.0 / (near - far);
                DMat4::from_cols(
                    DVec4::new(scale / aspect, 0.0, 0.0, 0.0),
                    DVec4::new(0.0, scale, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, z, 0.0),
                    DVec4::new(0.0, 0.0, near * z, 1.0),
                )
            }
        }
    }
}
