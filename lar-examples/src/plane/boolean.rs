//! Boolean expressions over the regions of drawings.
//!
//! Each shape has its own winding numbers and its own fill rule; a region holds where one of its shapes does.

use super::input::{Regions, Shapes};
use crate::CommandError;
use crate::bar::Bar;
use lar_arrangement::planar::{Dangling, Drawing, PlanarArrangement, PlanarArranger, Polygons};
use lar_arrangement::{ArrangementError, BooleanError, Closure, Expression, FillRule};
use lar_core::{FaceId, Points};
use std::num::NonZeroUsize;

/// Faces of an arrangement of some shapes in which an expression holds.
#[derive(Debug)]
pub(crate) struct Boolean {
    pub arrangement: PlanarArrangement,
    /// The bounded faces of the result in rising order.
    pub faces: Vec<FaceId>,
    /// The exterior is part of the result as well.
    pub is_unbounded: bool,
    /// Number of the shapes that the expression is about.
    pub n_shapes: usize,
}

impl Boolean {
    pub(crate) fn polygons(&self) -> Polygons {
        self.arrangement.polygons_of(&self.faces)
    }
}

/// How a Boolean is computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BooleanOptions {
    /// For all shapes, instead of their own fill rules.
    pub rule: Option<FillRule>,
    pub threads: NonZeroUsize,
}

impl Regions {
    /// Arranges the shapes that an expression over the regions is about, and finds the faces where it holds.
    /// O((n + k) log n) for n segments with k crossings, and the number of shapes that a face lies in for each face.
    pub(crate) fn boolean(
        &self,
        all: &Shapes,
        expression: &Expression,
        options: BooleanOptions,
    ) -> Result<Boolean, CommandError> {
        let operands = expression.operands();
        let mut used: Vec<usize> = operands.iter().flat_map(|&operand| self.shapes_of(operand)).collect();
        used.sort_unstable();
        used.dedup();
        let rules: Vec<FillRule> =
            used.iter().map(|&shape| options.rule.unwrap_or(all.shapes[shape].rule)).collect();
        let arrangement = arrange(all, &used, options.threads)?;
        for (i, &shape) in used.iter().enumerate() {
            check_outline(arrangement.closure(i), rules[i], || self.called(&operands, shape))
                .map_err(|source| CommandError::Boolean { file: all.file_of(shape), source })?;
        }
        let mut regions_of = vec![Vec::new(); used.len()];
        for &operand in &operands {
            for shape in self.shapes_of(operand) {
                let i = used.binary_search(&shape).expect("the shapes of all operands are used");
                regions_of[i].push(operand);
            }
        }
        let mut inside = vec![false; self.names.len()];
        let mut holds = |face: FaceId| {
            let within = || arrangement.windings(face).filter(|&(i, winding)| rules[i].is_inside(winding));
            within().flat_map(|(i, _)| &regions_of[i]).for_each(|&region| inside[region] = true);
            let holds = expression.evaluate(|region| inside[region]);
            within().flat_map(|(i, _)| &regions_of[i]).for_each(|&region| inside[region] = false);
            holds
        };
        let is_unbounded = holds(FaceId(0));
        let faces = (1..).map(FaceId).take(arrangement.n_faces()).filter(|&face| holds(face)).collect();
        Ok(Boolean { arrangement, faces, is_unbounded, n_shapes: used.len() })
    }

    fn shapes_of(&self, region: usize) -> impl Iterator<Item = usize> + '_ {
        self.shapes[region].iter().cloned().flatten()
    }

    /// The first of the operands that a shape belongs to.
    fn called(&self, operands: &[usize], shape: usize) -> String {
        let has = |&&operand: &&usize| self.shapes[operand].iter().any(|shapes| shapes.contains(&shape));
        operands.iter().find(has).map_or_else(String::new, |&operand| self.names[operand].clone())
    }
}

/// Whether a rule tells the inside of a shape.
fn check_outline(
    closure: Closure,
    rule: FillRule,
    name: impl FnOnce() -> String,
) -> Result<(), BooleanError> {
    match closure {
        Closure::Closed => Ok(()),
        Closure::Unoriented if rule == FillRule::EvenOdd => Ok(()),
        Closure::Unoriented => Err(BooleanError::Unoriented { solid: name() }),
        Closure::Open => Err(BooleanError::OpenOutline { region: name() }),
    }
}

/// The arrangement of some shapes, a region each. Dangling edges are kept: an outline that they leave open is known by
/// them.
fn arrange(
    all: &Shapes,
    used: &[usize],
    threads: NonZeroUsize,
) -> Result<PlanarArrangement, ArrangementError> {
    let ranges = || used.iter().map(|&shape| all.shapes[shape].segments.clone());
    let coords: Vec<f64> =
        ranges().flat_map(|range| all.segments[range].as_flattened().iter().copied()).collect();
    let mut drawing = Drawing::new(Points::from_columns(2, coords));
    let mut next = 0;
    for range in ranges() {
        let region = drawing.push_region("", []);
        for _ in range {
            drawing.push_region_segment(region, [next, next + 1]);
            next += 2;
        }
    }
    arranged(&drawing, threads, Dangling::Keep)
}

/// The arrangement of a drawing, with a bar when it takes a while.
pub(crate) fn arranged(
    drawing: &Drawing,
    threads: NonZeroUsize,
    dangling: Dangling,
) -> Result<PlanarArrangement, ArrangementError> {
    let bar = Bar::new();
    let show = |progress| bar.show(progress);
    PlanarArranger::new().threads(threads).dangling(dangling).progress(&show).arrange(drawing)
}
