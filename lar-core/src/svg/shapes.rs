//! The shapes of SVG, drawn with a pen.

use super::pen::{Arc, Map, Pen, Point, Stop};
use super::read::length;
use roxmltree::Node;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use svgtypes::{NumberListParser, PathParser, PathSegment, Transform};

/// What is wrong with an element.
#[derive(Clone, Copy)]
pub(super) enum Fault {
    /// The attribute, and what it should hold.
    Attribute(&'static str, &'static str),
    Stop(Stop),
}

impl From<Stop> for Fault {
    fn from(stop: Stop) -> Self {
        Self::Stop(stop)
    }
}

/// The map that an element's `transform` stands for.
pub(super) fn transform(node: Node<'_, '_>) -> Result<Map, Fault> {
    let text = node.attribute("transform").unwrap_or("");
    let Transform { a, b, c, d, e, f } =
        text.parse().map_err(|_| Fault::Attribute("transform", "a list of transforms"))?;
    Ok(Map([a, b, c, d, e, f]))
}

/// Draws an element when it is a shape.
pub(super) fn draw(pen: &mut Pen, node: Node<'_, '_>, name: &str) -> Result<(), Fault> {
    match name {
        "path" => path(pen, node.attribute("d").unwrap_or(""))?,
        "rect" => rect(pen, node)?,
        "circle" => {
            let r = radius(node, "r")?.unwrap_or(0.);
            ellipse(pen, node, r, r)?;
        }
        "ellipse" => {
            let (rx, ry) = (radius(node, "rx")?, radius(node, "ry")?);
            ellipse(pen, node, rx.or(ry).unwrap_or(0.), ry.or(rx).unwrap_or(0.))?;
        }
        "line" => {
            let ends = ["x1", "y1", "x2", "y2"].map(|name| length(node, name));
            let [x1, y1, x2, y2] = ends;
            pen.move_to([x1?.unwrap_or(0.), y1?.unwrap_or(0.)])?;
            pen.line_to([x2?.unwrap_or(0.), y2?.unwrap_or(0.)])?;
        }
        "polyline" | "polygon" => {
            corners(pen, node.attribute("points").unwrap_or(""))?;
            pen.finish(name == "polygon");
        }
        _ => {}
    }
    pen.finish(false);
    Ok(())
}

fn radius(node: Node<'_, '_>, name: &'static str) -> Result<Option<f64>, Fault> {
    match length(node, name)? {
        Some(r) if r < 0. => Err(Fault::Attribute(name, "a length that is not negative")),
        r => Ok(r),
    }
}

/// An ellipse without extent is not drawn.
fn ellipse(pen: &mut Pen, node: Node<'_, '_>, rx: f64, ry: f64) -> Result<(), Fault> {
    let centre = [length(node, "cx")?.unwrap_or(0.), length(node, "cy")?.unwrap_or(0.)];
    if rx > 0. && ry > 0. {
        pen.ellipse(centre, [rx, 0.], [0., ry])?;
    }
    Ok(())
}

fn corners(pen: &mut Pen, text: &str) -> Result<(), Fault> {
    let fault = || Fault::Attribute("points", "a list of pairs of numbers");
    let mut numbers = NumberListParser::from(text);
    let mut first = true;
    while let Some(x) = numbers.next() {
        let (Ok(x), Some(Ok(y))) = (x, numbers.next()) else { return Err(fault()) };
        if std::mem::take(&mut first) { pen.move_to([x, y])? } else { pen.line_to([x, y])? }
    }
    Ok(())
}

/// Clockwise as seen from the upper left corner; rounded corners are quarter ellipses.
fn rect(pen: &mut Pen, node: Node<'_, '_>) -> Result<(), Fault> {
    let (x, y) = (length(node, "x")?.unwrap_or(0.), length(node, "y")?.unwrap_or(0.));
    let (w, h) = (radius(node, "width")?.unwrap_or(0.), radius(node, "height")?.unwrap_or(0.));
    let (rx, ry) = (radius(node, "rx")?, radius(node, "ry")?);
    let (rx, ry) = (rx.or(ry).unwrap_or(0.).min(w / 2.), ry.or(rx).unwrap_or(0.).min(h / 2.));
    if w == 0. || h == 0. {
        return Ok(());
    }
    if rx == 0. || ry == 0. {
        pen.move_to([x, y])?;
        for corner in [[x + w, y], [x + w, y + h], [x, y + h]] {
            pen.line_to(corner)?;
        }
    } else {
        pen.move_to([x + rx, y])?;
        // Per corner: its quarter's start angle, centre, where the edge before ends, where the quarter ends.
        let (left, right, top, bottom) = (x + rx, x + w - rx, y + ry, y + h - ry);
        for (start, centre, from, to) in [
            (-FRAC_PI_2, [right, top], [right, y], [x + w, top]),
            (0., [right, bottom], [x + w, bottom], [right, y + h]),
            (FRAC_PI_2, [left, bottom], [left, y + h], [x, bottom]),
            (PI, [left, top], [x, top], [left, y]),
        ] {
            pen.line_to(from)?;
            pen.arc(Arc { centre, u: [rx, 0.], v: [0., ry], start, sweep: FRAC_PI_2 }, to)?;
        }
    }
    pen.finish(true);
    Ok(())
}

/// Where a path stands.
#[derive(Clone, Copy, Default)]
struct Cursor {
    start: Point,
    at: Point,
    /// The last control point, when the segment before was a cubic or a quadratic curve.
    cubic: Option<Point>,
    quadratic: Option<Point>,
    /// After a closing: the next segment starts a new subpath where the last one started.
    closed: bool,
}

fn path(pen: &mut Pen, text: &str) -> Result<(), Fault> {
    let mut cursor = Cursor::default();
    for segment in PathParser::from(text) {
        let segment = segment.map_err(|_| Fault::Attribute("d", "path data"))?;
        if cursor.closed && !matches!(segment, PathSegment::MoveTo { .. } | PathSegment::ClosePath { .. }) {
            pen.move_to(cursor.at)?;
        }
        cursor.draw(pen, segment)?;
    }
    Ok(())
}

impl Cursor {
    fn draw(&mut self, pen: &mut Pen, segment: PathSegment) -> Result<(), Stop> {
        let base = if segment.is_abs() { [0., 0.] } else { self.at };
        let point = |x: f64, y: f64| [base[0] + x, base[1] + y];
        let at = self.at;
        let (mut cubic, mut quadratic) = (None, None);
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                (self.start, self.at) = (point(x, y), point(x, y));
                pen.move_to(self.at)?;
            }
            PathSegment::LineTo { x, y, .. } => self.line(pen, point(x, y))?,
            PathSegment::HorizontalLineTo { x, .. } => self.line(pen, [base[0] + x, at[1]])?,
            PathSegment::VerticalLineTo { y, .. } => self.line(pen, [at[0], base[1] + y])?,
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                cubic = Some(point(x2, y2));
                self.curve(pen, [at, point(x1, y1), point(x2, y2), point(x, y)])?;
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                cubic = Some(point(x2, y2));
                let first = self.cubic.map_or(at, |control| reflected(control, at));
                self.curve(pen, [at, first, point(x2, y2), point(x, y)])?;
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                quadratic = Some(point(x1, y1));
                self.curve(pen, [at, point(x1, y1), point(x, y)])?;
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let control = self.quadratic.map_or(at, |control| reflected(control, at));
                quadratic = Some(control);
                self.curve(pen, [at, control, point(x, y)])?;
            }
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                let to = point(x, y);
                match centred(at, to, [rx.abs(), ry.abs()], x_axis_rotation.to_radians(), [large_arc, sweep])
                {
                    Some(arc) => pen.arc(arc, to)?,
                    None => pen.line_to(to)?,
                }
                self.at = to;
            }
            PathSegment::ClosePath { .. } => {
                self.at = self.start;
                pen.finish(true);
            }
        }
        self.closed = matches!(segment, PathSegment::ClosePath { .. });
        (self.cubic, self.quadratic) = (cubic, quadratic);
        Ok(())
    }

    fn line(&mut self, pen: &mut Pen, to: Point) -> Result<(), Stop> {
        self.at = to;
        pen.line_to(to)
    }

    fn curve<const N: usize>(&mut self, pen: &mut Pen, control: [Point; N]) -> Result<(), Stop> {
        self.at = control[N - 1];
        pen.curve(control)
    }
}

fn reflected(control: Point, about: Point) -> Point {
    [0, 1].map(|k| 2. * about[k] - control[k])
}

/// An arc given by its ends, half-axes, rotation and two flags, as part of an ellipse: SVG 2, appendix B.2.4,
/// half-axes too short for the ends enlarged as in B.2.5. `None` when it is a straight line.
fn centred(from: Point, to: Point, radii: Point, rotation: f64, [large, sweep]: [bool; 2]) -> Option<Arc> {
    if radii[0] == 0. || radii[1] == 0. || from == to {
        return None;
    }
    let (sin, cos) = rotation.sin_cos();
    let half = [0, 1].map(|k| from[k] / 2. - to[k] / 2.);
    // In units of the half-axes along the ellipse's own axes the ellipse is a circle of radius 1.
    let p = [(cos * half[0] + sin * half[1]) / radii[0], (cos * half[1] - sin * half[0]) / radii[1]];
    let size = p[0].hypot(p[1]);
    let grown = size.max(1.);
    let radii = radii.map(|r| r * grown);
    let p = p.map(|x| x / grown);
    let distance = size.min(1.);
    if distance == 0. {
        return None;
    }
    let away = ((1. - distance) * (1. + distance)).max(0.).sqrt() / distance;
    let away = if large == sweep { -away } else { away };
    let c = [away * p[1], -away * p[0]];
    let start = (p[1] - c[1]).atan2(p[0] - c[0]);
    let end = (-p[1] - c[1]).atan2(-p[0] - c[0]);
    let turned = match (sweep, end - start) {
        (true, angle) if angle < 0. => angle + TAU,
        (false, angle) if angle > 0. => angle - TAU,
        (_, angle) => angle,
    };
    let (u, v) = ([cos * radii[0], sin * radii[0]], [-sin * radii[1], cos * radii[1]]);
    let centre = [0, 1].map(|k| from[k] / 2. + to[k] / 2. + c[0] * u[k] + c[1] * v[k]);
    Some(Arc { centre, u, v, start, sweep: turned })
}
