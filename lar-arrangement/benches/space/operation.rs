//! What is measured: surfaces in memory in, the whole arrangement or the surface of a Boolean out.

use crate::workloads::{Combination, Workload};
use lar_arrangement::{
    Arrangement, Arranger, Detail, Expression, FillRule, SolidComplex, Stats, operand_names,
};
use lar_core::{FaceId, Surface};
use std::error::Error;
use std::num::NonZeroUsize;

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Operation {
    /// All cells: the chain complex with provenance and membership.
    Cells,
    /// One Boolean of all operands: the simplified surface.
    Boolean,
}

impl Operation {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Cells => "cells",
            Self::Boolean => "boolean",
        }
    }
}

/// A workload, its surfaces in memory, and how many threads arrange them.
pub(crate) struct Job {
    pub(crate) surfaces: Vec<Surface>,
    expression: Expression,
    arranger: Arranger<'static>,
}

pub(crate) enum Outcome {
    Cells(Box<Arrangement>),
    Boolean(Box<SolidComplex>, Stats),
}

impl Job {
    pub(crate) fn new(workload: &Workload, threads: NonZeroUsize) -> Self {
        let surfaces = workload.surfaces();
        let expression = expression(workload.combination, surfaces.len());
        Self { surfaces, expression, arranger: Arranger::new().threads(threads) }
    }

    pub(crate) fn n_facets(&self) -> u64 {
        self.surfaces.iter().map(|s| s.n_faces() as u64).sum()
    }

    pub(crate) fn run(&self, operation: Operation) -> Result<Outcome, Box<dyn Error>> {
        let arrangement = self.arranger.arrange(&self.surfaces)?;
        Ok(match operation {
            Operation::Cells => Outcome::Cells(Box::new(arrangement)),
            Operation::Boolean => {
                let solid = arrangement.boolean(&self.expression, FillRule::NonZero)?;
                Outcome::Boolean(Box::new(solid.to_complex(Detail::Simplified)), arrangement.stats().clone())
            }
        })
    }
}

fn expression(combination: Combination, n: usize) -> Expression {
    match combination {
        Combination::Union => Expression::union_of(n),
        Combination::Difference => {
            let names = operand_names(n);
            let text = format!("{} - ({})", names[0], names[1..].join(" | "));
            Expression::parse(&text, &names).expect("names and operators")
        }
    }
}

impl Outcome {
    pub(crate) fn stats(&self) -> &Stats {
        match self {
            Self::Cells(arrangement) => arrangement.stats(),
            Self::Boolean(_, stats) => stats,
        }
    }

    /// Vertices, edges, faces, and cells with the exterior, or none for a surface.
    pub(crate) fn counts(&self) -> [Option<usize>; 4] {
        match self {
            Self::Cells(a) => [a.n_vertices(), a.n_edges(), a.n_faces(), a.n_cells()].map(Some),
            Self::Boolean(solid, _) => {
                let [v, e, f] = [0, 1, 2].map(|p| Some(solid.complex.n_cells(p)));
                [v, e, f, None]
            }
        }
    }

    /// Of all bounded cells together, or of the solid.
    pub(crate) fn volume(&self) -> f64 {
        match self {
            Self::Cells(arrangement) => arrangement.volumes().into_iter().skip(1).sum(),
            Self::Boolean(solid, _) => volume(solid),
        }
    }

    /// Of the surfaces of all cells, the exterior's among them, or of the solid.
    pub(crate) fn area(&self) -> f64 {
        match self {
            Self::Cells(a) => 2.0 * (0..a.n_faces() as u32).map(|face| a.area(FaceId(face))).sum::<f64>(),
            Self::Boolean(solid, _) => area(solid),
        }
    }
}

/// From the loops alone: a loop is a fan of triangles, those of holes count against the others.
fn volume(solid: &SolidComplex) -> f64 {
    let triangles = faces(solid).flat_map(|face| triangles(solid, face));
    triangles.map(|[a, b, c]| dot(a, cross(b, c)) / 6.0).sum()
}

fn area(solid: &SolidComplex) -> f64 {
    let vector = |face| {
        let products = triangles(solid, face).map(|[a, b, c]| cross(minus(b, a), minus(c, a)));
        products.fold([0.0; 3], |sum, v| [0, 1, 2].map(|k| sum[k] + v[k] / 2.0))
    };
    faces(solid).map(vector).map(|v| dot(v, v).sqrt()).sum()
}

fn faces(solid: &SolidComplex) -> impl Iterator<Item = FaceId> {
    (0..solid.n_faces() as u32).map(FaceId)
}

fn triangles(solid: &SolidComplex, face: FaceId) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
    let point = |v: u32| solid.complex.points().xyz(v as usize);
    let fan = move |cycle: &'_ [u32]| {
        let corners: Vec<_> = cycle.iter().map(|&v| point(v)).collect();
        (2..corners.len()).map(move |i| [corners[0], corners[i - 1], corners[i]])
    };
    solid.face_loops(face).flat_map(fan)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}
