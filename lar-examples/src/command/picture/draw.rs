//! What `lar render` draws: the stage of a session, as the window shows it.

use super::look::Background;
use super::{Inputs, Render};
use crate::bar::Bar;
use crate::command::input::read;
use crate::output::check_file;
use crate::plane::{self, Shapes, Source};
use crate::{CommandError, exploration, exploration::Explored};
use lar_arrangement::planar::Dangling;
use lar_arrangement::{Arrangement, ArrangementError, Arranger};
use lar_core::{Surface, atomic_write};
use lar_viewer::session::{Session, Stage};
use lar_viewer::{CellData, LineDrawing, NoQueries, OffscreenRenderer, Scene, View};
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

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
        let (session, scene) = self.staged()?;
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
        measured(&session, out)
    }
}

/// Prints what was measured.
fn measured(session: &Session, out: &mut dyn Write) -> Result<(), CommandError> {
    for distance in session.measuring().distances() {
        writeln!(out, "distance {distance}")?;
    }
    if let Some(angle) = session.measuring().angle() {
        writeln!(out, "angle {}°", angle.to_degrees())?;
    }
    Ok(())
}

impl Render {
    /// The session that the options ask for, and its scene.
    fn staged(&self) -> Result<(Session, Scene), CommandError> {
        let (data, explored) = cells(&self.inputs, Explored::new)?;
        let mut session = self.look.session(data)?;
        match &explored {
            Some(explored) => self.accent.apply(&mut session, explored)?,
            None => self.accent.apply(&mut session, &NoQueries)?,
        }
        let scene = Stage::new(session.data(), session.pieces())?.scene(&session)?;
        Ok((session, scene))
    }

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

/// The cells of the inputs' arrangement, and what `ask` wants to know of it where it is one of space.
pub(crate) fn cells<R>(
    inputs: &Inputs,
    ask: impl FnOnce(Arrangement) -> R,
) -> Result<(CellData, Option<R>), CommandError> {
    let arranged = |surfaces: &[Surface]| {
        let bar = Bar::new();
        Arranger::new().progress(&|progress| bar.show(progress)).arrange(surfaces)
    };
    cells_of(inputs.named()?, arranged, ask)
}

/// The same of these names and files, arranged like this when they are surfaces; drawings are one when all of them are.
pub(crate) fn cells_of<R>(
    named: Vec<(String, PathBuf)>,
    arranged: impl FnOnce(&[Surface]) -> Result<Arrangement, ArrangementError>,
    ask: impl FnOnce(Arrangement) -> R,
) -> Result<(CellData, Option<R>), CommandError> {
    let is_drawing = |path: &Path| ["svg", "seg"].contains(&plane::extension(path).as_str());
    if !named.iter().all(|(_, path)| is_drawing(path)) {
        let surfaces = named.iter().map(|(name, path)| read(name, path)).collect::<Result<Vec<_>, _>>()?;
        let arrangement = arranged(&surfaces)?;
        return Ok((exploration::cell_data(&arrangement)?, Some(ask(arrangement))));
    }
    let sources = named.into_iter().map(|(name, path)| Source { name, path }).collect();
    let drawing = Shapes::read(sources, TOLERANCE)?.drawing();
    let threads = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    Ok((exploration::plane_data(&plane::arranged(&drawing, threads, Dangling::Keep)?)?, None))
}
