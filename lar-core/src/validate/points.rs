//! All coordinates are finite.

use super::Violation;
use crate::{ChainComplex, VertexId};

pub(super) fn check(complex: &ChainComplex, found: &mut Vec<Violation>) {
    for (i, axis, value) in complex.points().non_finite() {
        let vertex = VertexId(u32::try_from(i).unwrap_or(u32::MAX));
        found.push(Violation::NonFinite { vertex, axis, value });
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{bar, check, with_points};

    #[test]
    fn none_and_two() {
        check(super::check, &bar(), &[]);
        let mut points = bar().points().clone();
        points.coords_mut()[5] = f64::NAN;
        points.coords_mut()[6] = f64::INFINITY;
        let expected = ["coordinate 2 of vertex v1 is NaN", "coordinate 0 of vertex v2 is inf"];
        check(super::check, &with_points(&bar(), points), &expected);
    }
}
