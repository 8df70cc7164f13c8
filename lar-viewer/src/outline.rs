//! Outlines: ink around what is seen of the model, of each solid or of each cell.

use crate::{INK, Rgb, ViewerError};
use serde::{Deserialize, Serialize};

/// What is outlined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outlined {
    /// Everything as one, against the background.
    Model,
    /// Each outermost group: in a session the cells of each solid together.
    #[default]
    Solids,
    /// Each group of the next level: in a session each cell.
    Cells,
}

impl Outlined {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Model, Self::Solids, Self::Cells];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Model => "model",
            Self::Solids => "solids",
            Self::Cells => "cells",
        }
    }

    /// Level of the groups; `None` when all are one.
    pub(crate) fn level(self) -> Option<usize> {
        match self {
            Self::Model => None,
            Self::Solids => Some(0),
            Self::Cells => Some(1),
        }
    }
}

/// Silhouettes as an option of a view: a line where one thing ends on the screen and another, or the background, begins.
///
/// Pictures draw it where what is seen changes; line drawings along the edges beyond which a surface bends out of sight.
///
/// ```
/// use lar_viewer::{Outline, Outlined, View};
/// let view = View { outline: Some(Outline { of: Outlined::Model, ..Outline::default() }), ..View::default() };
/// assert!(view.validate().is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// What is outlined.
    pub of: Outlined,
    /// Width in pixels.
    pub width: f32,
    /// Colour.
    pub color: Rgb,
}

impl Default for Outline {
    /// A dark line around each solid, twice as wide as edges.
    fn default() -> Self {
        Self { of: Outlined::default(), width: 4.0, color: INK }
    }
}

impl Outline {
    pub(crate) fn validate(&self) -> Result<(), ViewerError> {
        let refused = |parameter, value: f32, expected| {
            Err(ViewerError::InvalidView { parameter, value: f64::from(value), expected })
        };
        if !(0.0..=100.0).contains(&self.width) {
            return refused("the width of outlines", self.width, "in 0..=100");
        }
        match self.color.into_iter().find(|c| !(0.0..=1.0).contains(c)) {
            Some(channel) => refused("a channel of the outlines' colour", channel, "in 0..=1"),
            None => Ok(()),
        }
    }
}
