//! The clip plane: which part of a scene a view leaves out.

use crate::ViewerError;
use glam::DVec3;

/// A half space that is cut away: where `normal` · p > `offset`, for points p of the scene before it is exploded, so that
/// the pieces of a cut solid can still be pulled apart.
///
/// ```
/// use lar_viewer::Clip;
/// let above = Clip::new([0.0, 0.0, 1.0], 0.5);
/// assert!(above.removes([0.0, 0.0, 0.6]) && !above.removes([9.0, 9.0, 0.5]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clip {
    /// Points into what is cut away; of any length but 0.
    pub normal: [f64; 3],
    /// `normal` · p on the plane.
    pub offset: f64,
    /// Groups whose centroid is cut away vanish whole and all others stay whole; what is in no group is cut by the plane.
    pub whole_cells: bool,
}

impl Clip {
    /// The plane `normal` · p = `offset`, cutting through cells.
    #[must_use]
    pub fn new(normal: [f64; 3], offset: f64) -> Self {
        Self { normal, offset, whole_cells: false }
    }

    /// Taking or leaving whole cells.
    #[must_use]
    pub fn whole_cells(self) -> Self {
        Self { whole_cells: true, ..self }
    }

    /// Whether a point is cut away.
    #[must_use]
    pub fn removes(&self, point: [f64; 3]) -> bool {
        self.offset < DVec3::from(self.normal).dot(point.into())
    }

    /// `normal` · p − `offset`: positive where a point is cut away.
    pub(crate) fn height(&self, point: [f64; 3]) -> f64 {
        DVec3::from(self.normal).dot(point.into()) - self.offset
    }

    pub(crate) fn validate(&self) -> Result<(), ViewerError> {
        let length = DVec3::from(self.normal).length();
        let refused =
            |parameter, value, expected| Err(ViewerError::InvalidView { parameter, value, expected });
        if !(1e-100..=1e100).contains(&length) {
            return refused("the length of the clip plane's normal", length, "in 1e-100..=1e100");
        }
        if self.offset.is_nan() || 1e200 < self.offset.abs() {
            return refused("the clip plane's offset", self.offset, "in ±1e200");
        }
        Ok(())
    }

    /// The same plane for points p = center + unit · q, as unit normal and distance: n · q − d is the height over it.
    pub(crate) fn in_scene(&self, center: [f64; 3], unit: f64) -> [f64; 4] {
        let normal = DVec3::from(self.normal);
        let length = normal.length();
        let n = normal / length;
        let d = (self.offset / length - n.dot(center.into())) / unit;
        [n.x, n.y, n.z, d]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_in_the_scene_are_those_of_the_world() {
        let clip = Clip::new([0.0, 3.0, 4.0], 10.0);
        let [x, y, z, d] = clip.in_scene([1.0, 2.0, 3.0], 2.0);
        let q = [0.5, -1.0, 0.25];
        let p = [2.0, 0.0, 3.5];
        let height = x * q[0] + y * q[1] + z * q[2] - d;
        assert!((2.0 * height - (0.6 * p[1] + 0.8 * p[2] - 2.0)).abs() < 1e-12);
    }
}
