//! The camera: a target, an orientation, a distance, with perspective or orthographic projection.
//!
//! The eye sits at `distance` from `target`, backwards along the orientation's line of sight. No parameter that passes
//! [`Camera::validate`] yields NaN, and looking straight down is as good a view as any.
//!
//! The *target plane* passes through the target, parallel to the screen. Both projections show it at the same size,
//! pan and zoom keep its point under the cursor, so switching projection never loses the object.
//!
//! All lengths are world units in f64; the renderer rounds only the finished matrices, relative to the scene.

mod fit;
mod matrices;

use crate::{Orientation, ViewerError};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Vertical opening angle when nothing else is asked for, in radians.
pub(crate) const DEFAULT_FOV: f64 = 0.45;

/// Opening angles that a camera may have, in radians.
const FOVS: std::ops::RangeInclusive<f64> = 1e-3..=3.0;

/// Zoom is refused beyond these distances, in world units, to keep every product finite in f64.
const DISTANCES: std::ops::RangeInclusive<f64> = 1e-90..=1e110;

/// How depth becomes size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Projection {
    /// Near things are larger.
    #[default]
    Perspective,
    /// Parallel lines stay parallel.
    Orthographic,
}

/// Where the scene is seen from.
///
/// ```
/// use lar_viewer::{Bounds, Camera};
/// let cube = Bounds { min: [0.; 3], max: [1.; 3] };
/// let camera = Camera::default().fit(&cube, 16.0 / 9.0);
/// assert!(camera.project([1.; 3], 720.).is_some());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point that is turned about, in the middle of the picture.
    pub target: [f64; 3],
    /// From the target to the eye.
    pub distance: f64,
    /// Which way is right, up and back.
    pub orientation: Orientation,
    /// Vertical opening angle in radians.
    pub fov_y: f64,
    /// Perspective or orthographic.
    pub projection: Projection,
}

impl Default for Camera {
    /// A three-quarter view of the unit sphere: x to the right and towards the eye, z up.
    fn default() -> Self {
        Self {
            target: [0.0; 3],
            distance: 6.0,
            orientation: Orientation::default(),
            fov_y: DEFAULT_FOV,
            projection: Projection::Perspective,
        }
    }
}

impl Camera {
    /// Checks that all parameters are finite and in range.
    ///
    /// # Errors
    /// `InvalidView` with the parameter and its value.
    pub fn validate(&self) -> Result<(), ViewerError> {
        let within = |parameter, value: f64, ok: bool, expected| {
            if ok { Ok(()) } else { Err(ViewerError::InvalidView { parameter, value, expected }) }
        };
        for x in self.target {
            within("a camera target coordinate", x, x.abs() <= 1e108, "at most 1e108 in magnitude")?;
        }
        within("the camera distance", self.distance, DISTANCES.contains(&self.distance), "in 1e-90..=1e110")?;
        within("the field of view", self.fov_y, FOVS.contains(&self.fov_y), "in 0.001..=3 radians")
    }

    /// A perspective camera with its eye here, this target in the middle of the picture, and this direction as far
    /// upwards as that allows.
    ///
    /// ```
    /// let camera = lar_viewer::Camera::looking([3., 0., 0.], [0.; 3], [0., 0., 1.])?;
    /// assert_eq!(camera.distance, 3.0);
    /// # Ok::<(), lar_viewer::ViewerError>(())
    /// ```
    ///
    /// # Errors
    /// `InvalidView` when eye and target coincide, when up is parallel to the line of sight, or when a coordinate is
    /// not finite or too large.
    pub fn looking(eye: [f64; 3], target: [f64; 3], up: [f64; 3]) -> Result<Self, ViewerError> {
        let back = DVec3::from(eye) - DVec3::from(target);
        let orientation = Orientation::facing(back.to_array(), up)?;
        let camera = Self { target, distance: back.length(), orientation, ..Self::default() };
        camera.validate()?;
        Ok(camera)
    }

    /// The same camera with parallel projection, showing this height of the world.
    ///
    /// # Errors
    /// `InvalidView` when the height is not above zero and finite, or too large.
    pub fn orthographic(self, height: f64) -> Result<Self, ViewerError> {
        let distance = 0.5 * height / (0.5 * self.fov_y).tan();
        let camera = Self { distance, projection: Projection::Orthographic, ..self };
        camera.validate()?;
        Ok(camera)
    }

    /// Height of the world that the picture shows in the target plane.
    #[must_use]
    pub fn visible_height(&self) -> f64 {
        self.world_per_pixel(1.0)
    }

    /// The camera as arguments of `lar render`: `--eye`, `--target`, `--up`, and `--fov` in degrees or `--ortho` with
    /// the height that is shown. Coordinates have all their digits.
    ///
    /// ```
    /// let camera = lar_viewer::Camera::looking([3., 0., 0.], [0.; 3], [0., 0., 1.])?;
    /// assert!(camera.arguments().starts_with("--eye=3,0,0 --target=0,0,0 --up="));
    /// # Ok::<(), lar_viewer::ViewerError>(())
    /// ```
    #[must_use]
    pub fn arguments(&self) -> String {
        let list = |[x, y, z]: [f64; 3]| format!("{x},{y},{z}");
        let lens = match self.projection {
            Projection::Perspective => format!("--fov={}", self.fov_y.to_degrees()),
            Projection::Orthographic => format!("--ortho={}", self.visible_height()),
        };
        let [_, up, _] = self.axes();
        format!("--eye={} --target={} --up={} {lens}", list(self.eye()), list(self.target), list(up))
    }

    /// The camera's axes in the world: right, up, and back (from the target towards the eye); orthonormal and
    /// right-handed.
    #[must_use]
    pub fn axes(&self) -> [[f64; 3]; 3] {
        self.orientation.axes()
    }

    fn basis(&self) -> [DVec3; 3] {
        self.orientation.basis()
    }

    /// Where the eye is; for an orthographic camera the centre of the picture lies on the line from here to the target.
    #[must_use]
    pub fn eye(&self) -> [f64; 3] {
        (DVec3::from(self.target) + self.basis()[2] * self.distance).to_array()
    }

    /// Moved parallel to the screen by a mouse motion of this many pixels, x to the right and y down, in a picture
    /// `height` pixels high: the point of the target plane that was under the cursor stays under it. A motion that
    /// leaves the space of valid cameras (NaN, overflow) moves nothing.
    #[must_use]
    pub fn pan(self, pixels: [f64; 2], height: f64) -> Self {
        let [right, up, _] = self.basis();
        let scale = self.world_per_pixel(height);
        let shift = right * (-pixels[0] * scale) + up * (pixels[1] * scale);
        let target = (DVec3::from(self.target) + shift).to_array();
        let moved = Self { target, ..self };
        if moved.validate().is_ok() { moved } else { self }
    }

    /// Nearer by this factor (above 1 enlarges), keeping the point of the target plane under the cursor where it is.
    /// `cursor` is in pixels from the middle of the picture, x to the right and y down.
    #[must_use]
    pub fn zoom(self, factor: f64, cursor: [f64; 2], height: f64) -> Self {
        let distance = (self.distance / factor).clamp(*DISTANCES.start(), *DISTANCES.end());
        if distance.is_nan() {
            return self;
        }
        let kept = 1.0 - distance / self.distance;
        let nearer = self.pan(cursor.map(|c| -c * kept), height);
        Self { distance, ..nearer }
    }

    /// With the other projection; the target plane keeps its size.
    #[must_use]
    pub fn toggle_projection(self) -> Self {
        let projection = match self.projection {
            Projection::Perspective => Projection::Orthographic,
            Projection::Orthographic => Projection::Perspective,
        };
        Self { projection, ..self }
    }

    /// Length in the target plane that one pixel shows, in a picture `height` pixels high.
    #[must_use]
    pub fn world_per_pixel(&self, height: f64) -> f64 {
        2.0 * self.distance * (0.5 * self.fov_y).tan() / height
    }

    /// Where the point appears: pixels from the middle of the picture, x to the right and y down; `None` when it is
    /// not before the eye.
    #[must_use]
    pub fn project(&self, point: [f64; 3], height: f64) -> Option<[f64; 2]> {
        let [right, up, _] = self.basis();
        let v = DVec3::from(point) - DVec3::from(self.target);
        let shrink = match self.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective => self.distance / self.depth(point),
        };
        let scale = shrink / self.world_per_pixel(height);
        (0.0 < shrink && shrink.is_finite()).then(|| [v.dot(right) * scale, -v.dot(up) * scale])
    }

    /// How far the point lies before the eye, along the line of sight.
    pub(crate) fn depth(&self, point: [f64; 3]) -> f64 {
        self.distance - (DVec3::from(point) - DVec3::from(self.target)).dot(self.basis()[2])
    }
}

#[cfg(test)]
mod tests;
