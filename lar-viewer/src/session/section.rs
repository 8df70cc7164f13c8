//! The clip plane as the user sets it: an axis or a free direction, and a position between the ends of the model.

use crate::{Bounds, Clip};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Direction of the clip plane's normal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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
    /// The clip plane that cuts this half space away from a model in this box; one that lies outside of the box stands at
    /// its nearer end.
    #[must_use]
    pub fn at(clip: &Clip, bounds: &Bounds) -> Self {
        let direction = DVec3::from(clip.normal);
        let along = |k: usize| (0..3).all(|i| i == k || clip.normal[i] == 0.0);
        let (normal, flipped) = match (0..3).find(|&k| along(k)) {
            Some(k) => (Normal::Axis(k), clip.normal[k] < 0.0),
            None => {
                let [x, y, z] = clip.normal;
                (Normal::Free { azimuth: y.atan2(x), elevation: z.atan2(x.hypot(y)) }, false)
            }
        };
        let offset = clip.offset / direction.length() * if flipped { -1.0 } else { 1.0 };
        let (low, high) = extent(normal, bounds);
        let position = ((offset - low) / (high - low)).clamp(0.0, 1.0);
        let position = if position.is_nan() { 0.5 } else { position };
        Self { on: true, normal, position, flipped, whole_cells: clip.whole_cells }
    }

    /// The half space that is cut away from a model in this box.
    #[must_use]
    pub fn clip(&self, bounds: &Bounds) -> Option<Clip> {
        let normal = DVec3::from(self.normal.direction());
        let (low, high) = extent(self.normal, bounds);
        let offset = low + self.position * (high - low);
        let sign = if self.flipped { -1.0 } else { 1.0 };
        let mut clip = Clip::new((normal * sign).to_array(), offset * sign);
        clip.whole_cells = self.whole_cells;
        (self.on && offset.is_finite()).then_some(clip)
    }
}

/// The least and the greatest height along a normal.
fn extent(normal: Normal, bounds: &Bounds) -> (f64, f64) {
    let normal = DVec3::from(normal.direction());
    let heights = bounds.corners().map(|c| normal.dot(c.into()));
    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
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

    #[track_caller]
    fn check_at(normal: [f64; 3], offset: f64) {
        let clip = Clip::new(normal, offset);
        let found = Section::at(&clip, &BOX).clip(&BOX).unwrap();
        let length = DVec3::from(normal).length();
        let same = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(same(found.offset, offset / length), "{found:?}");
        assert!((0..3).all(|k| same(found.normal[k], normal[k] / length)), "{found:?}");
    }

    #[test]
    fn clip_planes_are_found_again() {
        check_at([1.0, 0.0, 0.0], 0.25);
        check_at([0.0, 0.0, -2.0], -6.0);
        check_at([1.0, -2.0, 0.5], -1.0);
        let beyond = Section::at(&Clip::new([0.0, 1.0, 0.0], 9.0).whole_cells(), &BOX);
        assert_eq!((beyond.position, beyond.whole_cells, beyond.on), (1.0, true, true));
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
