//! Rounded positions of the vertices.

use crate::grid::Grid;
use crate::kernel::{Fraction, Int, rounded_quotient};
use crate::parallel;
use crate::planar::along::parameter;
use crate::planar::carriers::Carriers;
use crate::planar::chains::{Chains, VertexSource};
use crate::planar::faces::exact_crossing;

/// Correctly rounded positions in grid steps.
pub(crate) fn positions(carriers: &Carriers, chains: &Chains) -> Vec<[f64; 2]> {
    parallel::map_light(chains.vertices.len(), |v| match chains.source(v as u32) {
        VertexSource::Point(p) => carriers.points[p as usize].map(|x| x as f64),
        VertexSource::Crossing([s, t]) => {
            let (num, den) = parameter(carriers, s, t);
            let fraction = Fraction::new(num, den);
            let ([p, _], d) = (carriers.at(s), carriers.direction(s));
            let exactly = |k: usize| {
                let (x, w) = exact_crossing(carriers, s, t);
                rounded_quotient(&x[k], &w.into())
            };
            [0, 1].map(|k| fraction.between(p[k], d[k]).unwrap_or_else(|| exactly(k)))
        }
    })
}

/// Positions in the drawing's unit of length: those in grid steps scaled exactly, or, far from the origin, rounded
/// from the exact ones again.
pub(crate) fn lengths(
    grid: &Grid,
    carriers: &Carriers,
    chains: &Chains,
    mut positions: Vec<[f64; 2]>,
) -> Vec<[f64; 2]> {
    let offset = grid.offset();
    if offset != [0; 3] {
        positions = parallel::map_light(positions.len(), |v| match chains.source(v as u32) {
            VertexSource::Point(p) => {
                [0, 1].map(|k| (i128::from(carriers.points[p as usize][k]) + offset[k]) as f64)
            }
            VertexSource::Crossing([s, t]) => {
                let (x, w) = exact_crossing(carriers, s, t);
                [0, 1].map(|k| rounded_quotient(&(x[k] + Int::from(offset[k]) * Int::from(w)), &w.into()))
            }
        });
    }
    parallel::each_chunk(&mut positions, |_, part| {
        part.iter_mut().flatten().for_each(|x| *x = grid.length(*x));
    });
    positions
}
