//! The two exact predicates of the plane on which every decision rests.

use crate::steps::step;

/// A point of the plane.
pub(crate) type Xy = [f64; 2];

fn coord(p: Xy) -> robust::Coord<f64> {
    robust::Coord { x: p[0], y: p[1] }
}

/// Positive when a, b, c turn counter-clockwise, 0 when they are collinear; the sign is exact.
pub(crate) fn orient(a: Xy, b: Xy, c: Xy) -> f64 {
    step();
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Positive when d lies inside the circle of the counter-clockwise triangle a, b, c; the sign is exact.
pub(crate) fn incircle(a: Xy, b: Xy, c: Xy, d: Xy) -> f64 {
    step();
    robust::incircle(coord(a), coord(b), coord(c), coord(d))
}

/// True when p lies inside or on the counter-clockwise triangle.
pub(crate) fn in_closed_triangle([a, b, c]: [Xy; 3], p: Xy) -> bool {
    orient(a, b, p) >= 0.0 && orient(b, c, p) >= 0.0 && orient(c, a, p) >= 0.0
}
