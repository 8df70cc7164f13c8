//! `lar render`: the cells of an arrangement in space or in the plane, as a picture.

#[cfg(feature = "viewer")]
mod accent;
#[cfg(feature = "viewer")]
mod direction;
#[cfg(feature = "viewer")]
mod draw;
#[cfg(feature = "viewer")]
mod look;
#[cfg(feature = "viewer")]
mod pose;

#[cfg(feature = "viewer")]
pub(super) use accent::Accent;
#[cfg(feature = "viewer")]
pub(super) use draw::cells;
#[cfg(feature = "window")]
pub(super) use draw::cells_of;
#[cfg(feature = "viewer")]
pub(super) use look::{Background, Cut, Look};
#[cfg(feature = "viewer")]
pub(super) use pose::Pose;

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

/// A picture of the inputs' arrangement: PNG or, as a drawing without hidden lines, SVG. Inputs are
/// surfaces in space or drawings in the plane (.svg, .seg).
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
    lar render a.obj b.obj -o cells.png --explode 1.8 --numbers cells\n  \
    lar render a.obj b.obj -o section.png --clip x=0.5 --color class --alpha 1 --outline solids\n  \
    lar render a.obj b.obj -o figure.svg --explode 1.5 --color size --background white\n  \
    lar render plan.svg -o plan.png --view top --ortho --numbers faces --alpha 1\n  \
    lar render a.obj b.obj -o boundary.png --only c1,c2 --boundary c1 --numbers faces\n  \
    lar render a.obj b.obj -o wrapped.png --wrapping c3:1\n  \
    lar render a.obj b.obj -o same.png --eye 4,-6,3 --target 0,0,0.5   (the camera that lar view copies)")]
pub(crate) struct Render {
    #[command(flatten)]
    inputs: Inputs,
    /// The picture, SVG or PNG by the extension.
    #[arg(short, long, value_name = "OUT.png|.svg")]
    output: PathBuf,
    /// In SVG, draws lines only: faces hide what is behind them but are not filled.
    #[arg(long)]
    lines: bool,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x800")]
    size: Size,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    pose: Pose,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    look: Look,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    accent: Accent,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    cut: Cut,
}

#[cfg(not(feature = "viewer"))]
impl Render {
    #[expect(clippy::unused_self, reason = "the same call with and without the viewer")]
    pub(crate) fn run(&self, _: &mut dyn std::io::Write) -> Result<(), CommandError> {
        Err(CommandError::NotBuilt { feature: "viewer" })
    }
}
