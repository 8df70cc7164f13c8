//! Where a picture is seen from.

use super::direction::Direction;
use crate::CommandError;
use crate::command::camera::CameraArguments;
use lar_viewer::{Camera, Scene, View};

/// An eye, or a direction of sight.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Pose {
    #[command(flatten)]
    camera: CameraArguments,
    #[command(flatten)]
    direction: Direction,
}

impl Pose {
    /// The camera for a picture of this width by height; it is fitted to the scene where no eye is given.
    pub(crate) fn camera(&self, view: &View, scene: &Scene, aspect: f64) -> Result<Camera, CommandError> {
        self.camera.camera(|lens| {
            let orientation = self.direction.orientation().unwrap_or(lens.orientation);
            View { camera: Camera { orientation, ..lens }, ..*view }.fit(scene, aspect).camera
        })
    }

    /// Whether the size of what is seen is given, by an eye or a height.
    pub(crate) fn is_sized(&self) -> bool {
        self.camera.is_placed() || self.camera.has_height()
    }
}
