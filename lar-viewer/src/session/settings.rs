//! What of a session can be set, apart from the complex: how it is shown.

use super::{ColorBy, Explode, Section, Session, Visibility};
use crate::{Outlined, Rgb};
use serde::{Deserialize, Serialize};

/// How a complex is shown: all of a session but the complex, what is selected, and the way back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// What is visible.
    pub visibility: Visibility,
    /// Whether the cells of each dimension carry their numbers.
    pub numbers: [bool; 4],
    /// How far the pieces are pulled apart.
    pub explode: Explode,
    /// The clip plane.
    pub section: Section,
    /// What colours mean.
    pub coloring: ColorBy,
    /// Opacity of triangles.
    pub opacity: f32,
    /// What has an outline.
    pub outline: Option<Outlined>,
    /// Colour behind everything.
    pub background: Rgb,
}

impl Session {
    /// How the complex is shown.
    #[must_use]
    pub fn settings(&self) -> Settings {
        let Self { numbers, explode, section, coloring, opacity, outline, background, .. } = *self;
        let visibility = self.visibility.clone();
        Settings { visibility, numbers, explode, section, coloring, opacity, outline, background }
    }

    /// The same complex, shown like this.
    #[must_use]
    pub fn with_settings(self, settings: Settings) -> Self {
        let Settings { visibility, numbers, explode, section, coloring, opacity, outline, background } =
            settings;
        Self { visibility, numbers, explode, section, coloring, opacity, outline, background, ..self }
    }
}
