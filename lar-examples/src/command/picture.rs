//! `lar render`: the cells of the arrangement, exploded and translucent.

use super::camera::CameraArguments;
use super::input::Inputs;
use crate::CommandError;
use crate::size::Size;
use std::io::Write;
use std::path::PathBuf;
use std::str::FromStr;

/// Largest explosion factor.
const EXPLODE_LIMIT: f32 = 1e6;

/// A picture of the inputs' arrangement as PNG.
#[derive(Debug, clap::Args)]
pub(crate) struct Render {
    #[command(flatten)]
    inputs: Inputs,
    /// The picture.
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x800")]
    size: Size,
    #[command(flatten)]
    look: Look,
    #[command(flatten)]
    camera: CameraArguments,
}

/// How the cells are shown.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct Look {
    /// Moves each cell away from the middle, by one factor or one for each axis; 1 leaves it in place.
    #[arg(long, value_name = "S | SX,SY,SZ", default_value = "1", allow_hyphen_values = true)]
    pub(super) explode: Explode,
    /// Opacity of the cells, from 0 to 1.
    #[arg(long, value_name = "A", default_value = "0.6", value_parser = alpha, allow_hyphen_values = true)]
    pub(super) alpha: f32,
    /// Which cells are shown.
    #[arg(long, value_enum, value_name = "WHICH", default_value_t)]
    pub(super) cells: Which,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Which {
    /// Every cell, cavities too; when exploded, also the exterior as a white shell in its place.
    All,
    /// Those inside an input.
    #[default]
    Solid,
}

/// Factors of the explosion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Explode(pub(super) [f32; 3]);

impl FromStr for Explode {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let factors: Option<Vec<f32>> = text.split(',').map(factor).collect();
        match factors.as_deref() {
            Some(&[s]) => Ok(Self([s; 3])),
            Some(&[x, y, z]) => Ok(Self([x, y, z])),
            _ => Err("an explosion is one factor or three separated by commas, each within ±1e6"),
        }
    }
}

/// A factor of an explosion.
pub(crate) fn factor(text: &str) -> Option<f32> {
    text.trim().parse().ok().filter(|factor: &f32| factor.abs() <= EXPLODE_LIMIT)
}

fn alpha(text: &str) -> Result<f32, &'static str> {
    let value = text.parse().ok().filter(|a| (0.0..=1.0).contains(a));
    value.ok_or("an opacity lies between 0 and 1")
}

#[cfg(not(feature = "viewer"))]
impl Render {
    #[expect(clippy::unused_self, reason = "the same call with and without the viewer")]
    pub(crate) fn run(&self, _: &mut dyn Write) -> Result<(), CommandError> {
        Err(CommandError::NotBuilt { feature: "viewer" })
    }
}

#[cfg(feature = "viewer")]
mod with_viewer {
    use super::{CommandError, Explode, Inputs, Look, Render, Which, Write};
    use crate::bar::Bar;
    use crate::output::check_file;
    use crate::shapes::Shapes;
    use lar_arrangement::{Arrangement, Arranger};
    use lar_core::{CellId, FaceId};
    use lar_viewer::{CellShape, CellStyle, Drawable, OffscreenRenderer, Scene, View, WHITE, push_cells};

    impl Render {
        pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
            check_file(&self.output)?;
            let scene = scene(&self.inputs, self.look)?;
            let (width, height) = (self.size.width, self.size.height);
            let (Explode(factors), aspect) = (self.look.explode, f64::from(width) / f64::from(height));
            let fitted = View::fitted(&scene, factors, aspect);
            let camera =
                self.camera.camera(|lens| View { camera: lens, ..fitted }.fit(&scene, aspect).camera)?;
            let view = View { camera, ..fitted };
            let mut renderer = OffscreenRenderer::new()?;
            renderer.render(&scene, &view, width, height)?.write_png(&self.output)?;
            writeln!(
                out,
                "{}: {width} × {height}, drawn by {}",
                self.output.display(),
                renderer.adapter_name()
            )?;
            Ok(())
        }
    }

    fn scene(inputs: &Inputs, look: Look) -> Result<Scene, CommandError> {
        let surfaces = inputs.read()?.surfaces;
        let bar = Bar::new();
        let arrangement = Arranger::new().progress(&|progress| bar.show(progress)).arrange(&surfaces)?;
        drop(bar);
        let shapes = Shapes::new(&arrangement)?;
        let style = CellStyle { opacity: look.alpha, ..CellStyle::default() };
        let mut scene = Scene::new();
        push_cells(&mut scene, shown(&arrangement, &shapes, look.cells)?, &style)?;
        if look.cells == Which::All && look.explode != Explode([1.0; 3]) {
            let exterior = shapes.cell(CellId(0))?;
            let mesh = Drawable::mesh("exterior", exterior.mesh).color(WHITE).opacity(0.5 * look.alpha);
            scene.push(mesh.cell(exterior.cell))?;
            scene.push(Drawable::edges("exterior", exterior.edges).cell(exterior.cell))?;
        }
        Ok(scene)
    }

    /// The chosen bounded cells, and the faces that bound none of them.
    fn shown(
        arrangement: &Arrangement,
        shapes: &Shapes<'_>,
        which: Which,
    ) -> Result<Vec<CellShape>, CommandError> {
        let is_solid = |c: CellId| (0..arrangement.n_solids()).any(|s| arrangement.winding(c, s) != 0);
        let is_shown = |c: CellId| c != CellId(0) && (which == Which::All || is_solid(c));
        let bounds_none = |f: FaceId| {
            let [front, back] = arrangement.cells_of_face(f);
            front == back || !(is_shown(front) || is_shown(back))
        };
        let cells = (0..).map(CellId).take(arrangement.n_cells()).filter(|&c| is_shown(c));
        let sheets = (0..).map(FaceId).take(arrangement.n_faces()).filter(|&f| bounds_none(f));
        Ok(cells.map(|c| shapes.cell(c)).chain(sheets.map(|f| shapes.face(f))).collect::<Result<_, _>>()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_explode(text: &str, expected: Option<[f32; 3]>) {
        assert_eq!(text.parse::<Explode>().ok().map(|e| e.0), expected, "{text}");
    }

    #[test]
    fn explosions() {
        check_explode("1.5", Some([1.5; 3]));
        check_explode("1, 2,-3", Some([1.0, 2.0, -3.0]));
        for text in ["", "1,2", "1,2,3,4", "NaN", "inf", "1e7", "a"] {
            check_explode(text, None);
        }
    }

    #[test]
    fn opacities() {
        assert_eq!(["0", "0.5", "1"].map(|t| alpha(t).ok()), [Some(0.0), Some(0.5), Some(1.0)]);
        assert_eq!(["-0.1", "1.1", "NaN", ""].map(|t| alpha(t).ok()), [None; 4]);
    }
}
