//! What `lar render` draws: the stage of a session, as the window shows it.

use super::look::{Background, Look};
use super::{Inputs, Render};
use crate::bar::Bar;
use crate::output::check_file;
use crate::plane::{self, Shapes, Source};
use crate::{CommandError, exploration};
use lar_arrangement::planar::Dangling;
use lar_arrangement::{Arrangement, Arranger};
use lar_core::atomic_write;
use lar_viewer::session::{Session, Stage};
use lar_viewer::{CellData, LineDrawing, OffscreenRenderer, Scene, View};
use std::io::Write;
use std::num::NonZeroUsize;

/// How far a curve of a drawing may be from the chords that it is replaced by.
const TOLERANCE: f64 = 0.01;

impl Render {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        check_file(&self.output)?;
        let is_svg = match plane::extension(&self.output).as_str() {
            "svg" => true,
            "png" => false,
            _ => return Err(CommandError::PictureFormat { path: self.output.clone() }),
        };
        // What cannot be drawn is not computed.
        let renderer = if is_svg { None } else { Some(OffscreenRenderer::new()?) };
        let (width, height) = (self.size.width, self.size.height);
        let (session, scene) = staged(&self.inputs, &self.look)?;
        let view = self.view(&session, &scene)?;
        let path = self.output.display();
        if let Some(mut renderer) = renderer {
            let mut image = renderer.render(&scene, &view, width, height)?;
            if let Some(bar) = self.look.color_bar(&session) {
                let bar = bar.image(&mut renderer, (height / 2).clamp(1, 800))?;
                let margin = height / 40;
                image.overlay(&bar, width.saturating_sub(bar.width() + margin), margin);
            }
            image.write_png(&self.output)?;
            writeln!(out, "{path}: {width} × {height}, drawn by {}", renderer.adapter_name())?;
        } else {
            let draw = if self.lines { LineDrawing::new } else { LineDrawing::filled };
            let mut drawing = draw(&scene, &view, [width, height])?;
            if let Some(bar) = self.look.color_bar(&session) {
                let (bar, margin) = (bar.drawing((height / 2).clamp(1, 800))?, height / 40);
                let left = width.saturating_sub(bar.size()[0] + margin);
                drawing.overlay(&bar, [left, margin].map(f64::from));
            }
            let text = drawing.to_svg();
            atomic_write(&self.output, |file| file.write_all(text.as_bytes()))?;
            writeln!(
                out,
                "{path}: {width} × {height}, {} faces, {} lines",
                drawing.areas().len(),
                drawing.lines().len()
            )?;
        }
        Ok(())
    }
}

impl Render {
    fn view(&self, session: &Session, scene: &Scene) -> Result<View, CommandError> {
        let aspect = f64::from(self.size.width) / f64::from(self.size.height);
        let Background(background, background_opacity) = self.look.background();
        let explode = self.look.explosion().explosion();
        let outline = session.outline();
        let view = View {
            explode,
            clip: self.cut.clip(),
            outline,
            background,
            background_opacity,
            ..View::default()
        };
        Ok(View { camera: self.pose.camera(&view, scene, aspect)?, ..view })
    }
}

/// The session that the options ask for, and its scene.
fn staged(inputs: &Inputs, look: &Look) -> Result<(Session, Scene), CommandError> {
    let session = look.session(cells(inputs, |_| ())?.0);
    let scene = Stage::new(session.data(), session.pieces())?.scene(&session)?;
    Ok((session, scene))
}

/// The cells of the inputs' arrangement, and what `ask` wants to know of it where it is one of space.
pub(crate) fn cells<R>(
    inputs: &Inputs,
    ask: impl FnOnce(Arrangement) -> R,
) -> Result<(CellData, Option<R>), CommandError> {
    let drawings = inputs.drawings()?;
    if drawings.is_empty() {
        let surfaces = inputs.read()?.surfaces;
        let bar = Bar::new();
        let arrangement = Arranger::new().progress(&|progress| bar.show(progress)).arrange(&surfaces)?;
        drop(bar);
        return Ok((exploration::cell_data(&arrangement)?, Some(ask(arrangement))));
    }
    let sources = drawings.into_iter().map(|(name, path)| Source { name, path }).collect();
    let drawing = Shapes::read(sources, TOLERANCE)?.drawing();
    let threads = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    Ok((exploration::plane_data(&plane::arranged(&drawing, threads, Dangling::Keep)?)?, None))
}
