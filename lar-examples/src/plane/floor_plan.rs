//! `floor_plan`: Booleans and cells of a floor plan drawn as SVG.
//!
//! The drawing has a group `walls`, of shapes that may overlap. Where it has them, the group `openings` is cut out of the
//! walls, the shapes of the group `rooms` stand in the rooms that their `id`s name, and those of the group `fittings`
//! are drawn as lines. The rooms are the bounded faces of the partition by the walls, openings closed, that are not
//! walls.

use super::boolean::{Boolean, BooleanOptions};
use super::color::cyclic;
#[cfg(feature = "viewer")]
use super::figures::Pictures;
use super::figures::deliver;
use super::input::{Regions, Shapes, Source};
use super::picture::{Color, PaintedPath, Picture, Stroke, filled};
use crate::size::Size;
use crate::{CommandError, program};
use clap::Parser;
use lar_arrangement::Expression;
use lar_arrangement::planar::{Location, Polygons};
use lar_core::FaceId;
use std::ffi::OsString;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Curves keep within this part of a unit of their chords.
const TOLERANCE: f64 = 0.1;

const WALL: Color = Color([0x3c, 0x40, 0x48]);
const OPENING: Color = Color([0xec, 0xee, 0xf1]);
const FITTING: Stroke = Stroke { color: Color([0x6b, 0x70, 0x7a]), width: 1.5 };

/// Walls without their openings, and the rooms between them, of a floor plan.
#[derive(Debug, Parser)]
#[command(name = "floor_plan", version)]
struct Arguments {
    /// SVG drawing with a group `walls` and, where it has them, `openings`, `rooms` and `fittings`.
    #[arg(value_name = "PLAN.svg")]
    plan: PathBuf,
    /// Write floor_plan.svg and floor_plan.png into this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Open a window on the picture.
    #[arg(long)]
    view: bool,
    /// Length of a unit of the drawing in metres.
    #[arg(long, value_name = "M", default_value = "0.01")]
    unit: f64,
    /// Width and height of the PNG in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x800")]
    size: Size,
}

/// Runs the program: `args` begin with its name, the table of areas goes to `out`, an error is one line on `err`.
/// Returns the exit code: 0 done, 2 bad input or usage, 3 no graphics adapter; then the table is printed and the SVG
/// written all the same.
pub fn run(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |arguments: Arguments, out| {
        let source = Source { name: String::new(), path: arguments.plan };
        let plan = FloorPlan::new(&Shapes::read(vec![source], TOLERANCE)?)?;
        write!(out, "{}", plan.numbers(arguments.unit))?;
        let size = [arguments.size.width, arguments.size.height];
        deliver(vec![plan.named_picture()], arguments.out.as_deref(), arguments.view, size, out)
    })
}

/// The plan of an apartment, in hundredths of a metre.
#[cfg(feature = "viewer")]
pub(crate) fn apartment() -> Result<Pictures, CommandError> {
    let drawing = lar_core::parse_svg(include_str!("apartment.svg"), "apartment.svg", TOLERANCE)?;
    let plan = FloorPlan::new(&Shapes::of_svg("apartment.svg", &drawing))?;
    Ok(Pictures { numbers: plan.numbers(0.01), pictures: vec![plan.named_picture()] })
}

/// A room: its name, its outline with what stands in it left out, and its area in squared units.
struct Room {
    name: String,
    polygons: Polygons,
    area: f64,
}

struct FloorPlan {
    rooms: Vec<Room>,
    /// With openings closed, with openings cut out, and what was cut out.
    whole: Polygons,
    walls: Polygons,
    openings: Polygons,
    fittings: PaintedPath,
}

impl FloorPlan {
    fn new(shapes: &Shapes) -> Result<Self, CommandError> {
        let regions = shapes.regions(false)?;
        let walls = boolean(shapes, &regions, "walls")?;
        let has_openings = regions.names.iter().any(|name| name == "openings");
        let cut = |text: &str| Ok::<_, CommandError>(boolean(shapes, &regions, text)?.polygons());
        let [without, openings] = if has_openings {
            [cut("walls - openings")?, cut("walls & openings")?]
        } else {
            [walls.polygons(), cut("walls - walls")?]
        };
        let lines = shapes.of_element("fittings").flat_map(|shape| &shapes.segments[shape.segments.clone()]);
        let runs = lines.map(|&[a, b, c, d]| (vec![[a, b], [c, d]], false)).collect();
        Ok(Self {
            rooms: rooms(shapes, &walls),
            whole: walls.polygons(),
            walls: without,
            openings,
            fittings: PaintedPath { id: "fittings".to_owned(), runs, fill: None, stroke: Some(FITTING) },
        })
    }

    /// The table of areas, for units of this length in metres.
    fn numbers(&self, unit: f64) -> String {
        let square = unit * unit;
        let rows = self.rooms.iter().map(|room| (room.name.as_str(), room.area));
        let sum: f64 = self.rooms.iter().map(|room| room.area).sum();
        let sums = [
            ("rooms", sum),
            ("walls, openings cut out", self.walls.area()),
            ("openings in walls", self.openings.area()),
            ("all", sum + self.whole.area()),
        ];
        let width = rows.clone().chain(sums).map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        let row = |(name, area): (&str, f64)| format!("{name:<width$}  {:>9.3} m²\n", area * square);
        rows.chain(sums).map(row).collect()
    }

    fn named_picture(&self) -> (String, &'static str, Picture) {
        ("floor_plan".to_owned(), "floor plan", self.picture())
    }

    /// Rooms in their colours, walls dark, openings light, fittings as lines.
    fn picture(&self) -> Picture {
        let rooms = self.rooms.iter().enumerate();
        let mut paths: Vec<PaintedPath> =
            rooms.flat_map(|(i, room)| filled(&room.name, &room.polygons, cyclic(i))).collect();
        paths.extend(filled("opening", &self.openings, OPENING));
        paths.extend(filled("wall", &self.walls, WALL));
        paths.push(self.fittings.clone());
        Picture { paths }
    }
}

fn boolean(shapes: &Shapes, regions: &Regions, text: &str) -> Result<Boolean, CommandError> {
    let expression = Expression::parse(text, &regions.names)?;
    let threads = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    regions.boolean(shapes, &expression, BooleanOptions { rule: None, threads })
}

/// The bounded faces that are not walls, those with a name first, in the order of the names.
fn rooms(shapes: &Shapes, walls: &Boolean) -> Vec<Room> {
    let arrangement = &walls.arrangement;
    let locator = arrangement.locator();
    let mut faces: Vec<(FaceId, String)> = Vec::new();
    let mut named = vec![false; arrangement.n_faces() + 1];
    walls.faces.iter().for_each(|face| named[face.index()] = true);
    named[0] = true;
    for shape in shapes.of_element("rooms") {
        let [x, y, ..] = shapes.segments[shape.segments.start];
        if let Location::Face(face) = locator.locate([x, y])
            && !std::mem::replace(&mut named[face.index()], true)
        {
            faces.push((face, shape.id.clone().unwrap_or_default()));
        }
    }
    let rest = (0..).map(FaceId).zip(&named).filter(|(_, named)| !**named);
    faces.extend(rest.enumerate().map(|(i, (face, _))| (face, format!("room {}", i + 1))));
    let room = |(face, name): (FaceId, String)| Room {
        name,
        polygons: arrangement.polygons_of(&[face]),
        area: arrangement.area(face),
    };
    faces.into_iter().map(room).collect()
}
