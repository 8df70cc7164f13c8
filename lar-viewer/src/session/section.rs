//! The clip plane as the user sets it: an axis or a free direction, and a position between the ends of the model.

use crate::{Bounds, Clip};
use glam::DVec3;

/// Direction of the clip plane's normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Normal {
    /// Along coordinate axis 0, 1 or 2.
    Axis(usize),
    /// Any direction, by azimuth and elevation in radians.
    Free {
        /// About z, from x towards y.
        azimuth: f64,
        /// Above the xy plane.
        elevation: f64,
    },
}

impl Normal {
    /// As a unit vector.
    #[must_use]
    pub fn direction(self) -> [f64; 3] {
        match self {
            Self::Axis(k) => std::array::from_fn(|i| if i == k.min(2) { 1.0 } else { 0.0 }),
            Self::Free { azimuth, elevation } => {
                let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth.sin_cos(), elevation.sin_cos());
                [cos_e * cos_a, cos_e * sin_a, sin_e]
            }
        }
    }
}

/// A clip plane that may be switched off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Whether anything is cut away.
    pub on: bool,
    /// Its normal.
    pub normal: Normal,
    /// Where it stands: 0 at the near end of the model along the normal, 1 at the far end.
    pub position: f64,
    /// Cuts away the other half.
    pub flipped: bool,
    /// Takes or leaves whole cells.
    pub whole_cells: bool,
}

impl Default for Section {
    /// Off; half of the model along x when switched on.
    fn default() -> Self {
        Self { on: false, normal: Normal::Axis(0), position: 0.5, flipped: false, whole_cells: false }
    }
}

impl Section {
    /// The half space that is cut away from a model in this box.
    #[must_use]
    pub fn clip(&self, bounds: &Bounds) -> Option<Clip> {
        let normal = DVec3::from(self.normal.direction());
        let heights = bounds.corners().map(|c| normal.dot(c.into()));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let offset = low + self.position * (high - low);
        let sign = if self.flipped { -1.0 } else { 1.0 };
        let mut clip = Clip::new((normal * sign).to_array(), offset * sign);
        clip.whole_cells = self.whole_cells;
        (self.on && offset.is_finite()).then_some(clip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Bounds = Bounds { min: [-1.0, 0.0, 2.0], max: [1.0, 4.0, 6.0] };

    #[track_caller]
    fn check(section: Section, removed: [f64; 3], kept: [f64; 3]) {
        let clip = Section { on: true, ..section }.clip(&BOX).unwrap();
        assert!(clip.removes(removed) && !clip.removes(kept), "{clip:?}");
    }

    #[test]
    fn positions_run_from_end_to_end() {
        let half = Section::default();
        assert_eq!(half.clip(&BOX), None);
        check(half, [0.1, 9., 9.], [-0.1, 9., 9.]);
        check(Section { flipped: true, ..half }, [-0.1, 9., 9.], [0.1, 9., 9.]);
        check(Section { normal: Normal::Axis(2), position: 0.25, ..half }, [0., 0., 3.1], [0., 0., 2.9]);
        let free = Normal::Free { azimuth: std::f64::consts::FRAC_PI_2, elevation: 0.0 };
        check(Section { normal: free, position: 1.0, ..half }, [0., 4.1, 0.], [0., 3.9, 0.]);
        let whole = Section { on: true, whole_cells: true, ..half };
        assert!(whole.clip(&BOX).unwrap().whole_cells);
    }
}
