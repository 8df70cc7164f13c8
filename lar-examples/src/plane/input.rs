//! Drawings from files, and the regions that they name.
//!
//! A *shape* is what one element of an SVG drawing draws, or all of a file of segments. A *region* is a union of shapes
//! with a name. Of a single drawing the regions are its elements: by their `id`, a group being the union of what is in
//! it; shapes without an `id` are A, B, C, … by their number. Of several drawings, or one that is given as `name=path`,
//! each drawing is a region, and its elements are regions named `name.id`.

use crate::CommandError;
use lar_arrangement::planar::Drawing;
use lar_arrangement::{FillRule, operand_names};
use lar_core::{read_segments, read_svg};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A drawing to be read.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub name: String,
    pub path: PathBuf,
}

/// A drawing that was read.
#[derive(Clone, Debug)]
pub(crate) struct Input {
    pub name: String,
    pub path: PathBuf,
    pub shapes: Range<usize>,
    pub segments: Range<usize>,
}

/// One element of a drawing: its segments, among those of all drawings.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub segments: Range<usize>,
    /// How its inside is told: as its drawing says, by parity for segments.
    pub rule: FillRule,
    /// The `id` of the element or of the nearest one around it.
    pub id: Option<String>,
}

/// Drawings as segments x1, y1, x2, y2, shape by shape.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    pub inputs: Vec<Input>,
    pub segments: Vec<[f64; 4]>,
    pub shapes: Vec<Shape>,
    /// Elements with an `id`: number of the drawing, `id`, shapes.
    named: Vec<(usize, String, Range<usize>)>,
}

impl Shapes {
    /// Reads drawings one after the other; curves keep within `tolerance` of their chords.
    pub(crate) fn read(sources: Vec<Source>, tolerance: f64) -> Result<Self, CommandError> {
        let mut out = Self::default();
        for Source { name, path } in sources {
            let (shapes, segments) = (out.shapes.len(), out.segments.len());
            match extension(&path).as_str() {
                "seg" => out.push_segments(read_segments(&path)?),
                "svg" => out.push_svg(&read_svg(&path, tolerance)?),
                _ => return Err(CommandError::NotADrawing { path }),
            }
            if out.segments.len() == segments {
                return Err(CommandError::NothingDrawn { path });
            }
            let (shapes, segments) = (shapes..out.shapes.len(), segments..out.segments.len());
            out.inputs.push(Input { name, path, shapes, segments });
        }
        Ok(out)
    }

    /// One drawing that was read from an SVG document of this name.
    #[cfg(feature = "viewer")]
    pub(crate) fn of_svg(path: &str, drawing: &lar_core::Drawing) -> Self {
        let mut out = Self::default();
        out.push_svg(drawing);
        let (shapes, segments) = (0..out.shapes.len(), 0..out.segments.len());
        out.inputs.push(Input { name: String::new(), path: path.into(), shapes, segments });
        out
    }

    fn push_segments(&mut self, segments: Vec<[f64; 4]>) {
        let first = self.segments.len();
        if first == 0 {
            self.segments = segments;
        } else {
            self.segments.extend(segments);
        }
        self.shapes.push(Shape { segments: first..self.segments.len(), rule: FillRule::EvenOdd, id: None });
    }

    fn push_svg(&mut self, drawing: &lar_core::Drawing) {
        let first_shape = self.shapes.len();
        for shape in drawing.polylines.chunk_by(|a, b| a.shape == b.shape) {
            let first = self.segments.len();
            for polyline in shape {
                let points: Vec<[f64; 2]> = polyline.points.iter().map(|p| [p[0], p[1]]).collect();
                self.segments.extend(points.windows(2).map(|w| [w[0][0], w[0][1], w[1][0], w[1][1]]));
                if let (true, [start, .., end]) = (polyline.closed, points.as_slice()) {
                    self.segments.push([end[0], end[1], start[0], start[1]]);
                }
            }
            let rule = if shape[0].even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
            self.shapes.push(Shape { segments: first..self.segments.len(), rule, id: shape[0].id.clone() });
        }
        for named in &drawing.named {
            let shapes = first_shape + named.shapes.start..first_shape + named.shapes.end;
            self.named.push((self.inputs.len(), named.id.clone(), shapes));
        }
    }

    /// The segments as a drawing without regions.
    pub(crate) fn drawing(&self) -> Drawing {
        Drawing::from_segments(&self.segments)
    }

    /// The regions by their names; `as_wholes` when the drawings are regions themselves.
    pub(crate) fn regions(&self, as_wholes: bool) -> Result<Regions, CommandError> {
        let mut names = Names::default();
        for (i, input) in self.inputs.iter().enumerate().filter(|_| as_wholes) {
            names.add(input.name.clone(), Origin::Drawing(i), input.shapes.clone())?;
        }
        let in_drawing = |i: usize, name: &str| {
            if as_wholes { format!("{}.{name}", self.inputs[i].name) } else { name.to_owned() }
        };
        for (i, id, shapes) in &self.named {
            names.add(in_drawing(*i, id), Origin::Element(*i), shapes.clone())?;
        }
        for (i, input) in self.inputs.iter().enumerate() {
            let letters = operand_names(input.shapes.len());
            for (shape, letter) in
                input.shapes.clone().zip(letters).filter(|(s, _)| self.shapes[*s].id.is_none())
            {
                names.add(in_drawing(i, &letter), Origin::Shape(shape), shape..shape + 1)?;
            }
        }
        Ok(Regions { names: names.names, shapes: names.shapes })
    }

    /// The shapes of the elements of this `id`.
    pub(crate) fn of_element(&self, id: &str) -> impl Iterator<Item = &Shape> {
        let ranges = self.named.iter().filter(move |(_, known, _)| known == id);
        ranges.flat_map(|(_, _, shapes)| &self.shapes[shapes.clone()])
    }

    /// The drawing that a shape is from.
    pub(crate) fn file_of(&self, shape: usize) -> Option<PathBuf> {
        self.inputs.iter().find(|input| input.shapes.contains(&shape)).map(|input| input.path.clone())
    }
}

pub(crate) fn extension(path: &Path) -> String {
    path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_ascii_lowercase())
}

/// What a name comes from: two of one name must be one thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Drawing(usize),
    /// An `id` in a drawing; elements drawn twice by `use` have it twice.
    Element(usize),
    Shape(usize),
}

#[derive(Debug, Default)]
struct Names {
    names: Vec<String>,
    shapes: Vec<Vec<Range<usize>>>,
    known: BTreeMap<String, (Origin, usize)>,
}

impl Names {
    fn add(&mut self, name: String, origin: Origin, shapes: Range<usize>) -> Result<(), CommandError> {
        match self.known.get(&name) {
            Some(&(known, at)) if known == origin => self.shapes[at].push(shapes),
            Some(_) => return Err(CommandError::SameRegion { name }),
            None => {
                self.known.insert(name.clone(), (origin, self.names.len()));
                self.names.push(name);
                self.shapes.push(vec![shapes]);
            }
        }
        Ok(())
    }
}

/// Names of regions and the shapes that each is the union of.
#[derive(Clone, Debug)]
pub(crate) struct Regions {
    pub names: Vec<String>,
    pub shapes: Vec<Vec<Range<usize>>>,
}
