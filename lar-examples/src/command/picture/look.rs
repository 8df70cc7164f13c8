//! What of a complex is shown, and how: the options that `lar render` and `lar view` share, and what they make of a
//! session.

use super::accent::cell;
use super::factor;
use crate::CommandError;
use lar_core::Chain;
use lar_viewer::session::{
    Center, ColorBy, Command, Explode, ExplodeBy, Exterior, LEVEL_NAMES, Session, size_range,
};
use lar_viewer::{CellData, CellRef, Clip, ColorBar, ColorMap, LEVELS, Outlined, Rgb, SLATE, WHITE};
use std::str::FromStr;

/// How the cells are shown.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct Look {
    /// Moves each cell away from the middle, by one factor or one for each axis; 1 leaves it in place.
    #[arg(long, value_name = "S | SX,SY,SZ", default_value = "1", allow_hyphen_values = true)]
    explode: Factors,
    /// What the explosion pulls apart.
    #[arg(long, value_enum, value_name = "WHAT", default_value_t)]
    by: By,
    /// Factors for solids, cells, faces and edges, one inside the other, instead of --explode.
    #[arg(long, value_name = "S0,S1,S2,S3", value_parser = levels, allow_hyphen_values = true, conflicts_with_all = ["explode", "by"])]
    levels: Option<[f32; LEVELS]>,
    /// What stays in place when the rest is exploded.
    #[arg(long, value_enum, value_name = "POINT", default_value_t)]
    about: About,
    /// Opacity of the cells, from 0 to 1.
    #[arg(long, value_name = "A", default_value = "0.6", value_parser = alpha, allow_hyphen_values = true)]
    alpha: f32,
    /// Multiplies the opacity of single inputs: of the cells that they are the first to contain.
    #[arg(long, value_name = "NAME=A,…", value_parser = alpha_of, value_delimiter = ',')]
    alpha_of: Vec<(String, f32)>,
    /// Which cells are shown.
    #[arg(long, value_enum, value_name = "WHICH", default_value_t)]
    cells: Which,
    /// Hides these cells: v0, e5, f12, c3.
    #[arg(long, value_name = "CELL,…", value_delimiter = ',')]
    hide: Vec<String>,
    /// Shows these cells alone, with all cells in their boundaries.
    #[arg(long, value_name = "CELL,…", value_delimiter = ',')]
    only: Vec<String>,
    /// Dimensions that are drawn: vertices, edges, faces (each as a piece of its own), cells.
    #[arg(long, value_enum, value_name = "DIM,…", value_delimiter = ',', default_values_t = [Dim::Edges, Dim::Cells])]
    draw: Vec<Dim>,
    /// Dimensions whose cells carry their numbers.
    #[arg(long, value_enum, value_name = "DIM,…", value_delimiter = ',')]
    numbers: Vec<Dim>,
    /// What colours mean.
    #[arg(long, value_enum, value_name = "MEANING", default_value_t)]
    color: Meaning,
    /// The exterior cell; when not given it is a shell if all cells are shown exploded, else hidden.
    #[arg(long, value_enum, value_name = "HOW")]
    exterior: Option<Outside>,
    /// Draws a line around what is seen of the model, of each input or of each cell.
    #[arg(long, value_enum, value_name = "WHAT")]
    outline: Option<Lined>,
    /// Colour behind everything: slate, white, dark, transparent, or #rrggbb.
    #[arg(long, value_name = "COLOR", default_value = "slate")]
    background: Background,
}

/// A clip plane.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Cut {
    /// Cuts away what lies beyond a plane: x=0.5 keeps x ≤ 0.5, -x=0.5 the other side; or the normal and its product with
    /// a point of the plane.
    #[arg(long, value_name = "AXIS=AT | NX,NY,NZ,D", allow_hyphen_values = true)]
    clip: Option<Plane>,
    /// The clip plane takes or leaves whole cells.
    #[arg(long, requires = "clip")]
    whole_cells: bool,
}

impl Cut {
    /// What is cut away.
    pub(crate) fn clip(&self) -> Option<Clip> {
        let Plane(clip) = self.clip?;
        Some(if self.whole_cells { clip.whole_cells() } else { clip })
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Which {
    /// Every cell, cavities too; when exploded, also the exterior as a white shell in its place.
    All,
    /// Those inside an input.
    #[default]
    Solid,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum By {
    /// The cells of each input together.
    Solids,
    /// Each cell.
    #[default]
    Cells,
    /// Each face of each cell.
    Faces,
    /// Each edge of each face.
    Edges,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum About {
    /// The middle of the model.
    #[default]
    Model,
    /// The origin.
    Origin,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Dim {
    Vertices,
    Edges,
    Faces,
    Cells,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Meaning {
    /// Each cell its own, in turn.
    #[default]
    Cell,
    /// The first input that contains the cell.
    Solid,
    /// The set of inputs that contain the cell.
    Class,
    /// Volume or area, from the least to the greatest.
    Size,
    /// One colour for all.
    Plain,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Outside {
    /// Not drawn.
    Hidden,
    /// A white shell in its place.
    Shell,
    /// A barely visible shell.
    Translucent,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Lined {
    /// Everything as one.
    Model,
    /// The cells of each input together.
    Solids,
    /// Each cell.
    Cells,
}

/// Factors of an explosion.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Factors([f32; 3]);

impl FromStr for Factors {
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

fn levels(text: &str) -> Result<[f32; LEVELS], String> {
    let factors: Option<Vec<f32>> = text.split(',').map(factor).collect();
    let refused = || format!("factors for {}, separated by commas, each within ±1e6", LEVEL_NAMES.join(", "));
    factors.and_then(|f| f.try_into().ok()).ok_or_else(refused)
}

fn alpha(text: &str) -> Result<f32, &'static str> {
    let value = text.parse().ok().filter(|a| (0.0..=1.0).contains(a));
    value.ok_or("an opacity lies between 0 and 1")
}

fn alpha_of(text: &str) -> Result<(String, f32), &'static str> {
    let (name, opacity) = text.rsplit_once('=').ok_or("an input and its opacity, such as A=0.5")?;
    Ok((name.to_owned(), alpha(opacity)?))
}

/// The half space that a clip plane takes away.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plane(Clip);

impl FromStr for Plane {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let plane = match text.split_once('=') {
            Some((axis, at)) => along_axis(axis, at),
            None => {
                let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
                match numbers.as_deref() {
                    Some(&[x, y, z, d]) => Some(Clip::new([x, y, z], d)),
                    _ => None,
                }
            }
        };
        let has_direction = |c: &Clip| c.normal.iter().any(|x| *x != 0.0);
        let finite = |c: &Clip| c.normal.iter().chain([&c.offset]).all(|x| x.abs() <= 1e100);
        let plane = plane.filter(|c| has_direction(c) && finite(c)).map(Self);
        plane.ok_or("a clip plane is x=0.5, -x=0.5, or four numbers nx,ny,nz,d, the first three not all 0")
    }
}

fn along_axis(axis: &str, at: &str) -> Option<Clip> {
    let (sign, axis) = axis.strip_prefix('-').map_or((1.0, axis), |axis| (-1.0, axis));
    let k = ["x", "y", "z"].iter().position(|a| *a == axis)?;
    let at: f64 = at.trim().parse().ok()?;
    let normal = std::array::from_fn(|i| if i == k { sign } else { 0.0 });
    Some(Clip::new(normal, sign * at))
}

/// A colour and its opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Background(pub Rgb, pub f32);

impl FromStr for Background {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let hexadecimal = |digits: &str| {
            let value = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6)?;
            let channel = |shift: u32| (value >> shift & 255) as f32 / 255.0;
            Some(Self([channel(16), channel(8), channel(0)], 1.0))
        };
        match text {
            "slate" => Ok(Self(SLATE, 1.0)),
            "white" => Ok(Self(WHITE, 1.0)),
            "dark" => Ok(Self([0.09, 0.10, 0.12], 1.0)),
            "transparent" => Ok(Self(WHITE, 0.0)),
            _ => text
                .strip_prefix('#')
                .and_then(hexadecimal)
                .ok_or("a background is slate, white, dark, transparent, or #rrggbb"),
        }
    }
}

impl Look {
    /// The session that shows a complex like this.
    ///
    /// # Errors
    /// `Usage` when a cell that is named does not exist.
    pub(crate) fn session(&self, data: CellData) -> Result<Session, CommandError> {
        let mut session = Session::new(data);
        match self.cells {
            Which::All => session.apply(Command::ShowAll),
            Which::Solid => session.apply(Command::Show(enclosed_by_sheets(session.data()))),
        }
        session.apply(Command::SetExterior(self.exterior()));
        let top = session.data().dim();
        let drawn = |session: &Session, dim: u8| session.visibility().layers[usize::from(dim)];
        for dim in 0..4 {
            if drawn(&session, dim) != self.draws(dim, top) {
                session.apply(Command::ToggleLayer(dim));
            }
        }
        self.numbered(top).into_iter().for_each(|dim| session.apply(Command::ToggleNumbers(dim)));
        session.explode = self.explosion();
        session.coloring = match self.color {
            Meaning::Cell => ColorBy::Cell,
            Meaning::Solid => ColorBy::Solid,
            Meaning::Class => ColorBy::Class,
            Meaning::Size => ColorBy::Size,
            Meaning::Plain => ColorBy::Plain,
        };
        session.outline = self.outline.map(|of| match of {
            Lined::Model => Outlined::Model,
            Lined::Solids => Outlined::Solids,
            Lined::Cells => Outlined::Cells,
        });
        session.opacity = self.alpha;
        session.background = self.background.0;
        let named =
            |names: &[String]| names.iter().map(|name| cell(&session, name)).collect::<Result<Vec<_>, _>>();
        let (only, hidden) = (named(&self.only)?, named(&self.hide)?);
        if !only.is_empty() {
            session.apply(Command::Isolate(only));
        }
        session.apply(Command::Hide(hidden));
        for (name, opacity) in &self.alpha_of {
            let solid = session.data().solids().iter().position(|solid| solid == name);
            let solid = solid.ok_or_else(|| CommandError::Usage(format!("no input is named {name}")))?;
            session.apply(Command::SetOpacity(solid as u32, *opacity));
        }
        Ok(session)
    }

    /// How far the pieces are pulled apart.
    pub(crate) fn explosion(&self) -> Explode {
        let by = match self.by {
            By::Solids => ExplodeBy::Solids,
            By::Cells => ExplodeBy::Cells,
            By::Faces => ExplodeBy::Faces,
            By::Edges => ExplodeBy::Edges,
        };
        let center = match self.about {
            About::Model => Center::Model,
            About::Origin => Center::Origin,
        };
        let one = Explode { by, factors: self.explode.0, center, ..Explode::default() };
        match self.levels {
            Some(levels) => Explode { by: ExplodeBy::Hierarchy, levels, ..one },
            None => one,
        }
    }

    fn exterior(&self) -> Exterior {
        let exploded = self.explode != Factors([1.0; 3]) || self.levels.is_some();
        match self.exterior {
            Some(Outside::Shell) => Exterior::Shell,
            Some(Outside::Translucent) => Exterior::Translucent,
            None if self.cells == Which::All && exploded => Exterior::Shell,
            Some(Outside::Hidden) | None => Exterior::Hidden,
        }
    }

    /// Whether the cells of a dimension are drawn; what is highest counts as cells, in the plane the faces.
    fn draws(&self, dim: u8, top: u8) -> bool {
        self.draw.iter().any(|d| *d as u8 == dim) || (dim == top && self.draw.contains(&Dim::Cells))
    }

    fn numbered(&self, top: u8) -> Vec<u8> {
        let mut dims: Vec<u8> = self.numbers.iter().map(|d| (*d as u8).min(top)).collect();
        dims.sort_unstable();
        dims.dedup();
        dims
    }

    /// The legend of colours that mean numbers.
    pub(crate) fn color_bar(&self, session: &Session) -> Option<ColorBar> {
        let dim = session.data().dim();
        let title = ["", "length", "area", "volume"][usize::from(dim.min(3))];
        let range = size_range(session.data(), dim).filter(|_| self.color == Meaning::Size)?;
        Some(ColorBar { map: ColorMap::Sequential, range, title: title.into() })
    }

    /// Colour and opacity behind everything.
    pub(crate) fn background(&self) -> Background {
        self.background
    }
}

/// Bounded cells in no solid that have a face which bounds no solid either: what open surfaces enclose, which would
/// otherwise not be seen.
fn enclosed_by_sheets(data: &CellData) -> Vec<CellRef> {
    if data.dim() != 3 {
        return Vec::new();
    }
    let faces = (0..data.n_cells(2) as u32).map(|index| CellRef::new(2, index));
    let beside = |face: CellRef| -> Vec<CellRef> {
        let sides = data.coboundary(face);
        sides.iter().flat_map(Chain::entries).map(|&(index, _)| CellRef::new(3, index)).collect()
    };
    let of_sheets = faces.map(beside).filter(|sides| sides.iter().all(|&c| data.solids_of(c).is_empty()));
    of_sheets.flatten().filter(|&c| !data.is_exterior(c)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_factors(text: &str, expected: Option<[f32; 3]>) {
        assert_eq!(text.parse::<Factors>().ok().map(|e| e.0), expected, "{text}");
    }

    #[test]
    fn explosions() {
        check_factors("1.5", Some([1.5; 3]));
        check_factors("1, 2,-3", Some([1.0, 2.0, -3.0]));
        for text in ["", "1,2", "1,2,3,4", "NaN", "inf", "1e7", "a"] {
            check_factors(text, None);
        }
        assert_eq!(levels("1,2,3,4"), Ok([1.0, 2.0, 3.0, 4.0]));
        assert!(levels("1,2,3").is_err() && levels("1,2,3,x").is_err());
    }

    #[test]
    fn opacities() {
        assert_eq!(["0", "0.5", "1"].map(|t| alpha(t).ok()), [Some(0.0), Some(0.5), Some(1.0)]);
        assert_eq!(["-0.1", "1.1", "NaN", ""].map(|t| alpha(t).ok()), [None; 4]);
    }

    #[test]
    fn clip_planes() {
        let plane = |text: &str| text.parse::<Plane>().ok().map(|p| p.0);
        assert_eq!(plane("x=0.5"), Some(Clip::new([1.0, 0.0, 0.0], 0.5)));
        assert_eq!(plane("-z=2"), Some(Clip::new([0.0, 0.0, -1.0], -2.0)));
        assert_eq!(plane("1,-2,0,3"), Some(Clip::new([1.0, -2.0, 0.0], 3.0)));
        for text in ["", "w=1", "x=", "x=NaN", "0,0,0,1", "1,2,3", "1,2,3,inf"] {
            assert_eq!(plane(text), None, "{text}");
        }
    }

    #[test]
    fn backgrounds() {
        let background = |text: &str| text.parse::<Background>().ok();
        assert_eq!(background("#ff0000"), Some(Background([1.0, 0.0, 0.0], 1.0)));
        assert_eq!(background("white"), Some(Background(WHITE, 1.0)));
        assert_eq!(background("transparent").map(|b| b.1), Some(0.0));
        for text in ["", "red", "#fff", "#gggggg", "#1234567"] {
            assert_eq!(background(text), None, "{text}");
        }
    }
}
