//! From lines, curves and arcs to polylines that stay within a tolerance.
//!
//! Curves are transformed first and cut into equal steps of their parameter. A chord over a step h leaves its
//! curve by at most h² max|B″| / 8; a chord over an angle a of an ellipse with half-axes u, v leaves it by at
//! most √(|u|² + |v|²) (1 − cos(a/2)). So the number of steps is known beforehand, and checked against what is
//! allowed before any point is made.

use super::{Drawing, Polyline};
use crate::Points;
use std::f64::consts::{FRAC_PI_2, TAU};

pub(super) type Point = [f64; 2];

/// A map of the plane, columns (a, b), (c, d), (e, f): x′ = a x + c y + e, y′ = b x + d y + f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Map(pub(super) [f64; 6]);

impl Map {
    /// y downwards becomes y upwards.
    pub(super) const UPRIGHT: Self = Self([1., 0., 0., -1., 0., 0.]);

    pub(super) fn translation(x: f64, y: f64) -> Self {
        Self([1., 0., 0., 1., x, y])
    }

    pub(super) fn apply(&self, [x, y]: Point) -> Point {
        let [dx, dy] = self.linear([x, y]);
        [dx + self.0[4], dy + self.0[5]]
    }

    fn linear(&self, [x, y]: Point) -> Point {
        let [a, b, c, d, ..] = self.0;
        [a * x + c * y, b * x + d * y]
    }

    /// `self` after `first`.
    pub(super) fn after(&self, first: &Self) -> Self {
        let [a, b, c, d, e, f] = first.0;
        let ([a, b], [c, d], [e, f]) = (self.linear([a, b]), self.linear([c, d]), self.apply([e, f]));
        Self([a, b, c, d, e, f])
    }
}

/// Part of an ellipse: centre + u cos t + v sin t, t from `start` over `sweep`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) centre: Point,
    pub(super) u: Point,
    pub(super) v: Point,
    pub(super) start: f64,
    pub(super) sweep: f64,
}

/// What stopped a pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stop {
    NonFinite(Point),
    TooMany,
}

/// Draws in local coordinates; keeps what it has drawn in those of the drawing.
pub(super) struct Pen {
    pub(super) map: Map,
    pub(super) id: Option<String>,
    pub(super) shape: usize,
    pub(super) even_odd: bool,
    pub(super) drawing: Drawing,
    tolerance: f64,
    /// Points that may still be made.
    budget: usize,
    current: Vec<f64>,
}

impl Pen {
    pub(super) fn new(tolerance: f64, budget: usize) -> Self {
        let (map, drawing, current) = (Map::UPRIGHT, Drawing::default(), Vec::new());
        Self { map, id: None, shape: 0, even_odd: false, drawing, tolerance, budget, current }
    }

    /// Ends the polyline before, open, and starts another.
    pub(super) fn move_to(&mut self, to: Point) -> Result<(), Stop> {
        self.finish(false);
        self.push(self.map.apply(to))
    }

    pub(super) fn line_to(&mut self, to: Point) -> Result<(), Stop> {
        self.push(self.map.apply(to))
    }

    /// A Bézier curve of degree 2 or 3 given by its control points, the first of which is the current point.
    pub(super) fn curve<const N: usize>(&mut self, control: [Point; N]) -> Result<(), Stop> {
        let control = control.map(|p| self.map.apply(p));
        let second = |w: &[Point]| {
            let bend = [0, 1].map(|k| w[0][k] - 2. * w[1][k] + w[2][k]);
            bend[0].hypot(bend[1])
        };
        let degree = (N - 1) as f64;
        let bend = degree * (degree - 1.) * control.windows(3).map(second).fold(0., f64::max);
        let n = self.steps((bend / (8. * self.tolerance)).sqrt())?;
        for k in 1..n {
            self.push(casteljau(control, f64::from(k) / f64::from(n)))?;
        }
        self.push(control[N - 1])
    }

    /// An arc from the current point to `to`.
    pub(super) fn arc(&mut self, arc: Arc, to: Point) -> Result<(), Stop> {
        let n = self.arc_steps(&arc, 1)?;
        for k in 1..n {
            let (sin, cos) = (arc.start + arc.sweep * f64::from(k) / f64::from(n)).sin_cos();
            self.push(self.map.apply(arc.at(cos, sin)))?;
        }
        self.push(self.map.apply(to))
    }

    /// A whole ellipse, closed; its four vertices are among the points.
    pub(super) fn ellipse(&mut self, centre: Point, u: Point, v: Point) -> Result<(), Stop> {
        self.finish(false);
        let arc = Arc { centre, u, v, start: 0., sweep: TAU };
        let n = self.arc_steps(&arc, 4)?;
        for k in 0..n {
            let (cos, sin) = turn(k, n);
            self.push(self.map.apply(arc.at(cos, sin)))?;
        }
        self.finish(true);
        Ok(())
    }

    /// Ends the current polyline; one point alone is none.
    pub(super) fn finish(&mut self, closed: bool) {
        let mut coords = std::mem::take(&mut self.current);
        let n = coords.len();
        if closed && n > 2 && coords[..2] == coords[n - 2..] {
            coords.truncate(n - 2);
        }
        if coords.len() > 2 {
            let points = Points::from_columns(2, coords);
            let (id, shape, even_odd) = (self.id.clone(), self.shape, self.even_odd);
            self.drawing.polylines.push(Polyline { id, shape, even_odd, points, closed });
        }
    }

    /// Steps of an arc, a multiple of `multiple`, none longer than a quarter turn.
    fn arc_steps(&self, arc: &Arc, multiple: u32) -> Result<u32, Stop> {
        let [u, v] = [arc.u, arc.v].map(|axis| self.map.linear(axis));
        let size = u[0].hypot(u[1]).hypot(v[0].hypot(v[1]));
        let sagitta = (self.tolerance / size).min(1.);
        // 1 − cos(a/2) = 2 sin²(a/4), which keeps its digits for small angles.
        let step = (4. * (sagitta / 2.).sqrt().asin()).min(FRAC_PI_2);
        Ok(self.steps(arc.sweep.abs() / step)?.next_multiple_of(multiple))
    }

    fn steps(&self, wanted: f64) -> Result<u32, Stop> {
        if wanted.is_nan() || wanted >= self.budget.min(1 << 30) as f64 {
            return Err(Stop::TooMany);
        }
        Ok((wanted.ceil() as u32).max(1))
    }

    fn push(&mut self, [x, y]: Point) -> Result<(), Stop> {
        if !x.is_finite() || !y.is_finite() {
            return Err(Stop::NonFinite([x, y]));
        }
        self.budget = self.budget.checked_sub(1).ok_or(Stop::TooMany)?;
        self.current.extend([x + 0., y + 0.]);
        Ok(())
    }
}

impl Arc {
    fn at(&self, cos: f64, sin: f64) -> Point {
        [0, 1].map(|k| self.centre[k] + cos * self.u[k] + sin * self.v[k])
    }
}

fn casteljau<const N: usize>(mut points: [Point; N], t: f64) -> Point {
    for last in (1..N).rev() {
        for i in 0..last {
            points[i] = [0, 1].map(|k| points[i][k] * (1. - t) + points[i + 1][k] * t);
        }
    }
    points[0]
}

/// Cosine and sine of k/n of a full turn, exact at the quarters when n is a multiple of 4.
fn turn(k: u32, n: u32) -> (f64, f64) {
    let (quarter, rest) = (k / (n / 4), k % (n / 4));
    let (sin, cos) = (FRAC_PI_2 * f64::from(rest) / f64::from(n / 4)).sin_cos();
    match quarter % 4 {
        0 => (cos, sin),
        1 => (-sin, cos),
        2 => (-cos, -sin),
        _ => (sin, -cos),
    }
}
