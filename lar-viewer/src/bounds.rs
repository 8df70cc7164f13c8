//! Axis-aligned boxes: what a camera is fitted to.

use glam::DVec3;

/// A closed box in space, never empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Corner with the smallest coordinates.
    pub min: [f64; 3],
    /// Corner with the largest coordinates.
    pub max: [f64; 3],
}

impl Bounds {
    /// The smallest box around the points; `None` when there are none.
    ///
    /// ```
    /// let b = lar_viewer::Bounds::of([[0., 2., 0.], [1., 0., 3.]]).unwrap();
    /// assert_eq!(b.max, [1., 2., 3.]);
    /// ```
    #[must_use]
    pub fn of(points: impl IntoIterator<Item = [f64; 3]>) -> Option<Self> {
        points.into_iter().map(|p| Self { min: p, max: p }).reduce(Self::union)
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: DVec3::from(self.min).min(other.min.into()).to_array(),
            max: DVec3::from(self.max).max(other.max.into()).to_array(),
        }
    }

    /// The box moved by `shift`.
    #[must_use]
    pub fn moved(self, shift: [f64; 3]) -> Self {
        Self {
            min: std::array::from_fn(|k| self.min[k] + shift[k]),
            max: std::array::from_fn(|k| self.max[k] + shift[k]),
        }
    }

    /// The middle of the box.
    #[must_use]
    pub fn center(&self) -> [f64; 3] {
        std::array::from_fn(|k| 0.5 * self.min[k] + 0.5 * self.max[k])
    }

    /// Half of the diagonal: the radius of the sphere about `center()` through the corners.
    #[must_use]
    pub fn radius(&self) -> f64 {
        DVec3::from_array(std::array::from_fn(|k| 0.5 * self.max[k] - 0.5 * self.min[k])).length()
    }

    /// The eight corners.
    pub fn corners(&self) -> impl Iterator<Item = [f64; 3]> + use<> {
        let Self { min, max } = *self;
        (0..8).map(move |i| std::array::from_fn(|k| if i >> k & 1 == 0 { min[k] } else { max[k] }))
    }
}
