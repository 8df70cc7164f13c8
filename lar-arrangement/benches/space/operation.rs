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
        Ok(match operation {
            Operation::Cells => Outcome::Cells(Box::new(self.arranger.arrange(&self.surfaces)?)),
            Operation::Boolean => {
                let (rule, detail) = (FillRule::NonZero, Detail::Simplified);
                let (solid, stats) = self.arranger.boolean(&self.surfaces, &self.expression, rule, detail)?;
                Outcome::Boolean(Box::new(solid), stats)
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
            Self::Boolean(solid, _) => solid.volume(),
        }
    }

    /// Of the surfaces of all cells, the exterior's among them, or of the solid.
    pub(crate) fn area(&self) -> f64 {
        match self {
            Self::Cells(a) => 2.0 * (0..a.n_faces() as u32).map(|face| a.area(FaceId(face))).sum::<f64>(),
            Self::Boolean(solid, _) => solid.area(),
        }
    }
}
