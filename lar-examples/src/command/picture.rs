//! `lar render`: the cells of an arrangement in space or in the plane, as a picture.

#[cfg(feature = "viewer")]
mod direction;
#[cfg(feature = "viewer")]
mod draw;
#[cfg(feature = "viewer")]
mod look;

#[cfg(feature = "viewer")]
pub(super) use look::Look;

#[cfg(feature = "viewer")]
use super::camera::CameraArguments;
use super::input::Inputs;
#[cfg(not(feature = "viewer"))]
use crate::CommandError;
use crate::size::Size;
use std::path::PathBuf;

/// Largest explosion factor.
const EXPLODE_LIMIT: f32 = 1e6;

/// A factor of an explosion.
pub(crate) fn factor(text: &str) -> Option<f32> {
    text.trim().parse().ok().filter(|factor: &f32| factor.abs() <= EXPLODE_LIMIT)
}

/// A picture of the inputs' arrangement: PNG or, as a drawing of its lines without the hidden ones, SVG. Inputs are
/// surfaces in space or drawings in the plane (.svg, .seg).
#[derive(Debug, clap::Args)]
pub(crate) struct Render {
    #[command(flatten)]
    inputs: Inputs,
    /// The picture, SVG or PNG by the extension.
    #[arg(short, long, value_name = "OUT.png|.svg")]
    output: PathBuf,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x800")]
    size: Size,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    camera: CameraArguments,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    direction: direction::Direction,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    look: Look,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    cut: look::Cut,
}

#[cfg(not(feature = "viewer"))]
impl Render {
    #[expect(clippy::unused_self, reason = "the same call with and without the viewer")]
    pub(crate) fn run(&self, _: &mut dyn std::io::Write) -> Result<(), CommandError> {
        Err(CommandError::NotBuilt { feature: "viewer" })
    }
}
