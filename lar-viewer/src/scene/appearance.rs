//! What of a drawable may change from frame to frame without touching its geometry.

use crate::{Rgb, ViewerError};

/// Visibility, colour, opacity and highlight of one drawable. The renderer keeps these in a table of its own, 32 bytes
/// a drawable, so that changing them uploads that table and no geometry.
///
/// ```
/// use lar_viewer::{Appearance, Drawable};
/// let dot = Drawable::points("dot", [[0.0; 3]]);
/// assert_eq!(dot.appearance(), Appearance { visible: true, highlighted: false, ..dot.appearance() });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Appearance {
    /// Whether it is drawn, and can be picked.
    pub visible: bool,
    /// Drawn in the highlight colour, nearly opaque, lines and dots larger.
    pub highlighted: bool,
    /// Its colour.
    pub color: Rgb,
    /// 0 invisible to 1 opaque.
    pub opacity: f32,
}

impl Appearance {
    /// Visible and opaque, in this colour.
    #[must_use]
    pub fn new(color: Rgb) -> Self {
        Self { visible: true, highlighted: false, color, opacity: 1.0 }
    }

    pub(crate) fn validate(&self, drawable: &str) -> Result<(), ViewerError> {
        for channel in self.color {
            attribute(drawable, "a colour channel", channel, 1.0)?;
        }
        attribute(drawable, "the opacity", self.opacity, 1.0)
    }
}

/// Refuses an attribute outside of 0 to `high`.
pub(crate) fn attribute(
    drawable: &str,
    attribute: &'static str,
    value: f32,
    high: f64,
) -> Result<(), ViewerError> {
    let (value, low) = (f64::from(value), 0.0);
    if low <= value && value <= high {
        Ok(())
    } else {
        Err(ViewerError::Attribute { drawable: drawable.to_owned(), attribute, value, low, high })
    }
}
