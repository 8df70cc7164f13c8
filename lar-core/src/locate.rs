//! Point location: inside, on the boundary, outside.
//!
//! Decided by signs of exact predicates, never by a tolerance. A ray that meets a vertex or an edge is not
//! thrown away and shot again: the point is moved, in thought, by (ε, ε²) across the ray with ε smaller than
//! any number, so that it meets neither; what remains are signs of orientations, and where one is zero the
//! sign of a difference of coordinates.
//!
//! References: J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates", DCG 18 (1997); H. Edelsbrunner, E. P. Mücke, "Simulation of simplicity", ACM TOG 9 (1990).

mod boxes;
mod polygon;
mod solid;

pub use polygon::locate_in_polygon;
pub use solid::{LocateError, SolidLocator};

use robust::{Coord, orient2d};

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Location {
    /// In the interior.
    Inside,
    /// On the boundary.
    Boundary,
    /// Outside.
    Outside,
}

type Point2 = [f64; 2];

/// Positive when a, b, c turn counter-clockwise, zero when they lie on a line: exact as long as no product of
/// differences overflows or underflows.
fn orientation([a, b, c]: [Point2; 3]) -> f64 {
    let coord = |[x, y]: Point2| Coord { x, y };
    orient2d(coord(a), coord(b), coord(c))
}

/// On which side of the directed line a → b the point p + (ε, ε²) lies: +1 left, −1 right, 0 only when a = b.
fn side(a: Point2, b: Point2, p: Point2) -> i32 {
    let exact = orientation([a, b, p]);
    if exact == 0. {
        // The orientation grows with p as ε (a.y − b.y) + ε² (b.x − a.x).
        let by_x = sign(a[1], b[1]);
        return if by_x == 0 { sign(b[0], a[0]) } else { by_x };
    }
    sign(exact, 0.)
}

/// The sign of x − y.
fn sign(x: f64, y: f64) -> i32 {
    i32::from(x > y) - i32::from(x < y)
}

/// The sign with which the triangle a, b, c covers p + (ε, ε²): its orientation, 0 when it does not cover it.
fn cover([a, b, c]: [Point2; 3], p: Point2) -> i32 {
    let first = side(a, b, p);
    if first != 0 && side(b, c, p) == first && side(c, a, p) == first { first } else { 0 }
}

/// True when p lies on the closed segment a b.
fn on_segment(a: Point2, b: Point2, p: Point2) -> bool {
    let between = |k: usize| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]);
    between(0) && between(1) && orientation([a, b, p]) == 0.
}
