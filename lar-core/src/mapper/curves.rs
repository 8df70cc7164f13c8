//! Curves: complexes of edges.

use super::{GluedGrid, MapError, finite, polar, positive, turn};
use crate::Model;
use std::f64::consts::TAU;

/// A circle about the origin of the plane, or an arc of it from angle 0 on: 36 edges of a full turn of radius
/// 1.
///
/// ```
/// use lar_core::mapper::Circle;
/// let circle = Circle::default().model()?;
/// assert_eq!(circle.f_vector(), [36, 36]);
/// let arc = Circle { angle: 1., shape: 10, ..Circle::default() }.model()?;
/// assert_eq!(arc.f_vector(), [11, 10]);
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "circle")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// Positive.
    pub radius: f64,
    /// Above 0, at most 2π.
    pub angle: f64,
    /// Number of edges.
    pub shape: usize,
}

impl Default for Circle {
    fn default() -> Self {
        Self { radius: 1., angle: TAU, shape: 36 }
    }
}

impl Circle {
    /// The edges, in the plane.
    ///
    /// # Errors
    /// When a parameter is out of range; a full circle needs three edges.
    pub fn model(&self) -> Result<Model, MapError> {
        let (radius, angle) = (positive("radius", self.radius)?, turn("angle", self.angle)?);
        GluedGrid::new(&[self.shape]).full_turn(0, angle).cuboids(|p| polar(radius, angle * p[0]))
    }
}

/// A helix about the z axis, rising from z = 0: 2 turns of 36 edges each, radius 1, rise 1 a turn.
///
/// ```
/// use lar_core::mapper::Helix;
/// let helix = Helix { n_turns: 3, ..Helix::default() }.model()?;
/// assert_eq!(helix.f_vector(), [3 * 36 + 1, 3 * 36]);
/// assert_eq!(helix.points().point(108), [1., 0., 3.]);
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "helix")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    /// Positive.
    pub radius: f64,
    /// Rise along z in one turn; negative for a left-handed helix.
    pub pitch: f64,
    /// Number of turns.
    pub n_turns: usize,
    /// Number of edges in each turn.
    pub shape: usize,
}

impl Default for Helix {
    fn default() -> Self {
        Self { radius: 1., pitch: 1., n_turns: 2, shape: 36 }
    }
}

impl Helix {
    /// The edges, in space.
    ///
    /// # Errors
    /// When a parameter is out of range or there is no edge.
    pub fn model(&self) -> Result<Model, MapError> {
        let (radius, pitch) = (positive("radius", self.radius)?, finite("pitch", self.pitch)?);
        let turns = turns(self.n_turns);
        GluedGrid::new(&[self.n_turns.saturating_mul(self.shape)]).cuboids(|p| {
            let [x, y] = polar(radius, TAU * (turns * p[0]));
            [x, y, pitch * turns * p[0]]
        })
    }
}

#[expect(clippy::cast_precision_loss, reason = "turns have edges, of which there are fewer than 2^32")]
pub(super) fn turns(n: usize) -> f64 {
    n as f64
}
