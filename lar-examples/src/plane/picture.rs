//! Pictures of the plane: painted paths, one over the other, and what of an arrangement they show.

use super::color::{cyclic, face_colors};
use lar_arrangement::planar::{PlanarArrangement, Polygons};
use lar_core::{FaceId, Points, SvgStyle, SvgWriter};
use std::fmt;

/// Red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Color(pub [u8; 3]);

/// Colour of edges and vertices.
pub(super) const INK: Color = Color([0x2b, 0x2d, 0x33]);

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// A line: its colour, and its width in pixels of a picture 800 pixels high.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The colour.
    pub color: Color,
    /// The width.
    pub width: f64,
}

/// The edges of a partition.
const EDGE: Stroke = Stroke { color: INK, width: 1.6 };
/// Its vertices.
const VERTEX: Stroke = Stroke { color: INK, width: 5.0 };
/// Boundary cycles and fragments, which are all there is to see.
const BOLD: f64 = 3.0;

/// Lines are no wider than this part of the mean length of what is drawn, so that many small cells are not a black heap.
const WIDEST: f64 = 0.2;

/// Pictures have this part of their size free on each side.
const MARGIN: f64 = 0.03;

/// Height in pixels for which line widths are given.
const DESIGN_HEIGHT: f64 = 800.0;

/// One run of a path: its points, and whether the last is joined to the first. One point alone is a dot.
pub type Run = (Vec<[f64; 2]>, bool);

/// Runs that are painted alike.
#[derive(Clone, Debug, PartialEq)]
pub struct PaintedPath {
    /// Name of what it shows: `f1`, `edges`, …
    pub id: String,
    /// Its runs. With a fill the closed ones bound one polygon: its outline, and its holes.
    pub runs: Vec<Run>,
    /// Colour of the inside.
    pub fill: Option<Color>,
    /// The lines.
    pub stroke: Option<Stroke>,
}

/// Painted paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// From back to front.
    pub paths: Vec<PaintedPath>,
}

/// Where a picture stands: the box that it shows, and the length of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub lo: [f64; 2],
    pub hi: [f64; 2],
    pub per_pixel: f64,
    /// Pixels for one pixel of a line's width.
    pub scale: f64,
}

impl Picture {
    /// The faces of an arrangement, neighbours in different colours. In place there are its edges over them, and dots for
    /// its vertices but those along smooth curves; exploded by another factor than 1 each face moves with its own edges.
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, planar_arrangement};
    /// use lar_examples::plane::Picture;
    /// let triangle = Drawing::from_segments(&[[0., 0., 1., 0.], [1., 0., 0., 1.], [0., 1., 0., 0.]]);
    /// let picture = Picture::partition(&planar_arrangement(&triangle)?, 1.0);
    /// let ids: Vec<&str> = picture.paths.iter().map(|path| path.id.as_str()).collect();
    /// assert_eq!(ids, ["f1", "edges", "vertices"]);
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[must_use]
    pub fn partition(arrangement: &PlanarArrangement, explode: f64) -> Self {
        let in_place = explode == 1.0;
        let colors = face_colors(arrangement);
        let face = |f: usize| PaintedPath {
            id: format!("f{f}"),
            runs: face_runs(arrangement, f, !in_place),
            fill: Some(colors[f]),
            stroke: (!in_place).then_some(EDGE),
        };
        let mut paths: Vec<PaintedPath> = (1..=arrangement.n_faces()).map(face).collect();
        if !in_place {
            paths.push(line("edges", dangling_runs(arrangement, FaceId(0)), EDGE));
            return Self { paths }.exploded(explode);
        }
        paths.push(line("edges", edge_runs(arrangement).collect(), EDGE));
        paths.push(line("vertices", corners(arrangement), VERTEX));
        Self { paths }
    }

    /// The boundary cycles of the bounded faces, each face's in a colour of its own, exploded.
    #[must_use]
    pub fn cycles(arrangement: &PlanarArrangement, explode: f64) -> Self {
        let colors = face_colors(arrangement);
        let cycles = |f: usize| {
            let stroke = Stroke { color: colors[f].darker(), width: BOLD };
            line(&format!("f{f}"), face_runs(arrangement, f, true), stroke)
        };
        Self { paths: (1..=arrangement.n_faces()).map(cycles).collect() }.exploded(explode)
    }

    /// The edges, each moved by itself, in the colours of the shapes that they are from: shape k is made of
    /// `shape_sizes[k]` of the segments that were arranged.
    #[must_use]
    pub fn fragments(arrangement: &PlanarArrangement, shape_sizes: &[usize], explode: f64) -> Self {
        let mut shape_of = vec![0; arrangement.n_edges()];
        let segments = shape_sizes.iter().enumerate().flat_map(|(k, &n)| std::iter::repeat_n(k, n));
        for (segment, shape) in segments.enumerate() {
            arrangement.edges_of(segment).for_each(|(edge, _)| shape_of[edge.index()] = shape);
        }
        let fragment = |(e, run): (usize, Run)| {
            let stroke = Stroke { color: cyclic(shape_of[e]).darker(), width: BOLD };
            line(&format!("e{e}"), vec![run], stroke)
        };
        Self { paths: edge_runs(arrangement).enumerate().map(fragment).collect() }.exploded(explode)
    }

    /// Closed outlines, each in a colour of its own.
    #[must_use]
    pub fn outlines(outlines: impl IntoIterator<Item = Vec<[f64; 2]>>) -> Self {
        let outline = |(k, points): (usize, Vec<[f64; 2]>)| {
            let stroke = Stroke { color: cyclic(k).darker(), width: 2.4 };
            line(&format!("s{k}"), vec![(points, true)], stroke)
        };
        Self { paths: outlines.into_iter().enumerate().map(outline).collect() }
    }

    /// Polygons with holes in cyclic colours, with their outlines, exploded.
    #[must_use]
    pub fn polygons(polygons: &Polygons, explode: f64) -> Self {
        let polygon = |(k, loops): (usize, &Vec<Vec<u32>>)| PaintedPath {
            id: format!("p{k}"),
            runs: closed_runs(&polygons.points, loops),
            fill: Some(cyclic(k)),
            stroke: Some(EDGE),
        };
        Self { paths: polygons.polygons.iter().enumerate().map(polygon).collect() }.exploded(explode)
    }

    /// Each path moved rigidly: its centroid, the mean of its distinct points, becomes `factor` times as far from the
    /// middle of the picture. O(n log n).
    #[must_use]
    pub fn exploded(mut self, factor: f64) -> Self {
        let Some([lo, hi]) = self.bounds() else { return self };
        let middle = [0, 1].map(|k| lo[k] / 2.0 + hi[k] / 2.0);
        if factor == 1.0 {
            return self;
        }
        for path in &mut self.paths {
            let centroid = mean(path.runs.iter().flat_map(|(points, _)| points).copied().collect());
            let shift = [0, 1].map(|k| (factor - 1.0) * (centroid[k] - middle[k]));
            for point in path.runs.iter_mut().flat_map(|(points, _)| points) {
                *point = [0, 1].map(|k| point[k] + shift[k]);
            }
        }
        self
    }

    /// The picture as the text of an SVG document: holes are left out by parity, lines are as wide as in a PNG of
    /// `size` pixels. Coordinates are those of the points, y negated.
    #[must_use]
    pub fn to_svg(&self, size: [u32; 2]) -> String {
        let frame = self.frame(size);
        let mut svg = SvgWriter::new(frame.lo, frame.hi);
        for path in &self.paths {
            let fill = path.fill.map(|color| color.to_string());
            let stroke = path.stroke.map(|s| (s.color.to_string(), s.width * frame.scale * frame.per_pixel));
            let style = SvgStyle {
                id: &path.id,
                fill: fill.as_deref(),
                stroke: stroke.as_ref().map(|(color, width)| (color.as_str(), *width)),
                opacity: None,
            };
            svg.path(&style, path.runs.iter().map(|(points, closed)| (points, *closed)));
        }
        svg.finish()
    }

    /// Lower and upper corner of the box around all points.
    fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        let points = self.paths.iter().flat_map(|path| &path.runs).flat_map(|(points, _)| points);
        points.map(|&p| [p, p]).reduce(|[lo, hi], [p, _]| {
            [[lo[0].min(p[0]), lo[1].min(p[1])], [hi[0].max(p[0]), hi[1].max(p[1])]]
        })
    }

    /// The box around all points with a margin, as large as fits into `size` pixels.
    pub(super) fn frame(&self, size: [u32; 2]) -> Frame {
        let [mut lo, mut hi] = self.bounds().unwrap_or([[0.0; 2]; 2]);
        let size = size.map(|n| f64::from(n.max(1)));
        let extent = [0, 1].map(|k| hi[k] - lo[k]);
        let room = |k: usize| extent[k] / (size[k] * (1.0 - 2.0 * MARGIN));
        let fitting = room(0).max(room(1));
        let per_pixel = if fitting > 0.0 { fitting } else { size[1].recip() };
        let margin = MARGIN * size[0].min(size[1]) * per_pixel;
        for k in 0..2 {
            lo[k] -= margin;
            hi[k] += margin;
        }
        let scale = (size[1] / DESIGN_HEIGHT).clamp(0.4, 4.0);
        let widest = WIDEST * self.mean_length() / (EDGE.width * per_pixel);
        Frame { lo, hi, per_pixel, scale: if widest > 0.0 { scale.min(widest) } else { scale } }
    }

    /// Mean length of the segments that are drawn.
    fn mean_length(&self) -> f64 {
        let (mut sum, mut n) = (0.0, 0.0);
        let stroked = self.paths.iter().filter(|path| path.stroke.is_some());
        for w in stroked.flat_map(|path| &path.runs).flat_map(|(points, _)| points.windows(2)) {
            sum += (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
            n += 1.0;
        }
        if n > 0.0 { sum / n } else { 0.0 }
    }
}

impl Color {
    /// Dark enough for lines on white.
    fn darker(self) -> Self {
        Self(self.0.map(|channel| (f32::from(channel) * 0.75) as u8))
    }
}

fn line(id: &str, runs: Vec<Run>, stroke: Stroke) -> PaintedPath {
    PaintedPath { id: id.to_owned(), runs, fill: None, stroke: Some(stroke) }
}

pub(super) fn positions(points: &Points, vertices: &[u32]) -> Vec<[f64; 2]> {
    let at = |&v: &u32| [0, 1].map(|k| points.point(v as usize)[k]);
    vertices.iter().map(at).collect()
}

fn closed_runs(points: &Points, loops: &[Vec<u32>]) -> Vec<Run> {
    loops.iter().map(|cycle| (positions(points, cycle), true)).collect()
}

/// A path for each polygon, `id1`, `id2`, …, or `id` for a single one.
pub(super) fn filled<'a>(
    id: &'a str,
    polygons: &'a Polygons,
    fill: Color,
) -> impl Iterator<Item = PaintedPath> + 'a {
    let is_single = polygons.polygons.len() == 1;
    (1..).zip(&polygons.polygons).map(move |(k, loops)| PaintedPath {
        id: if is_single { id.to_owned() } else { format!("{id}{k}") },
        runs: closed_runs(&polygons.points, loops),
        fill: Some(fill),
        stroke: None,
    })
}

fn edge_runs(arrangement: &PlanarArrangement) -> impl Iterator<Item = Run> + '_ {
    let complex = arrangement.complex();
    let edges = (0..arrangement.n_edges()).filter_map(|e| complex.edge_ends(e));
    edges.map(|ends| (positions(complex.points(), &ends), false))
}

/// A dot for each vertex but those of two edges that go on in nearly the same direction.
fn corners(arrangement: &PlanarArrangement) -> Vec<Run> {
    /// Squared length of the sum of two unit vectors at an angle of 165°: a circle of 24 sides is still smooth.
    const SMOOTH: f64 = 0.069;
    let complex = arrangement.complex();
    let points = complex.points();
    // Degree, and the sum of the directions to the neighbours.
    let mut stars = vec![(0_u32, [0.0_f64; 2]); points.len()];
    for [a, b] in (0..arrangement.n_edges()).filter_map(|e| complex.edge_ends(e)) {
        let (p, q) = (points.point(a as usize), points.point(b as usize));
        let [x, y] = [q[0] - p[0], q[1] - p[1]];
        let length = x.hypot(y);
        for (vertex, sign) in [(a, 1.0), (b, -1.0)] {
            let (degree, sum) = &mut stars[vertex as usize];
            *degree += 1;
            *sum = [sum[0] + sign * x / length, sum[1] + sign * y / length];
        }
    }
    let is_corner = |(degree, [x, y]): &(u32, [f64; 2])| *degree != 2 || SMOOTH <= x * x + y * y;
    let corners = stars.iter().zip(points.iter()).filter(|(star, _)| is_corner(star));
    corners.map(|(_, p)| (vec![[p[0], p[1]]], false)).collect()
}

/// The loops that bound a face and, when asked for, the edges that dangle in it.
fn face_runs(arrangement: &PlanarArrangement, face: usize, dangling: bool) -> Vec<Run> {
    let complex = arrangement.complex();
    let mut runs = closed_runs(complex.points(), &complex.face_loops(face));
    if dangling {
        runs.extend(dangling_runs(arrangement, FaceId(face as u32)));
    }
    runs
}

/// The edges with one face on both sides.
fn dangling_runs(arrangement: &PlanarArrangement, face: FaceId) -> Vec<Run> {
    let points = arrangement.complex().points();
    let mut sides = Vec::new();
    for cycle in arrangement.face_vertices(face) {
        let next = cycle.iter().skip(1).chain(cycle.first());
        sides.extend(cycle.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]));
    }
    sides.sort_unstable();
    let twice = sides.chunk_by(|a, b| a == b).filter(|same| same.len() == 2);
    twice.map(|same| (positions(points, &same[0]), false)).collect()
}

/// Mean of the distinct points.
pub(super) fn mean(mut points: Vec<[f64; 2]>) -> [f64; 2] {
    points.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let n = points.len().max(1) as f64;
    points.iter().fold([0.0; 2], |sum, p| [sum[0] + p[0] / n, sum[1] + p[1] / n])
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_arrangement::planar::{Dangling, Drawing, PlanarArranger};

    fn arrangement(segments: &[[f64; 4]]) -> PlanarArrangement {
        PlanarArranger::new().dangling(Dangling::Keep).arrange(&Drawing::from_segments(segments)).unwrap()
    }

    /// The sides of an upright square.
    fn square(x: f64, y: f64, side: f64) -> [[f64; 4]; 4] {
        let (u, v) = (x + side, y + side);
        [[x, y, u, y], [u, y, u, v], [u, v, x, v], [x, v, x, y]]
    }

    /// Names without numbers, and numbers of points of the closed and of the open runs, of all paths in any order.
    #[track_caller]
    fn check_runs(picture: &Picture, expected: &[(&str, &[usize], &[usize])]) {
        let sizes = |path: &PaintedPath, closed| -> Vec<usize> {
            path.runs.iter().filter(|run| run.1 == closed).map(|run| run.0.len()).collect()
        };
        let kind = |id: &str| id.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned();
        let mut found: Vec<(String, Vec<usize>, Vec<usize>)> =
            picture.paths.iter().map(|p| (kind(&p.id), sizes(p, true), sizes(p, false))).collect();
        found.sort_unstable();
        let mut expected: Vec<_> =
            expected.iter().map(|(id, c, o)| ((*id).to_owned(), c.to_vec(), o.to_vec())).collect();
        expected.sort_unstable();
        assert_eq!(found, expected);
    }

    #[test]
    fn holes_and_dangling_edges_belong_to_their_face() {
        let inner = [[6., 6., 7., 7.]];
        let outer = [[10., 10., 12., 12.]];
        let all = [&square(0., 0., 10.)[..], &square(1., 1., 3.), &inner, &outer].concat();
        let a = arrangement(&all);
        let outside = ("edges", &[][..], &[2][..]);
        check_runs(&Picture::partition(&a, 2.0), &[("f", &[4, 4], &[2]), ("f", &[4], &[]), outside]);
        let (edges, corners) = (("edges", &[][..], &[2; 10][..]), ("vertices", &[][..], &[1; 11][..]));
        check_runs(&Picture::partition(&a, 1.0), &[("f", &[4, 4], &[]), ("f", &[4], &[]), edges, corners]);
        check_runs(&Picture::cycles(&a, 2.0), &[("f", &[4, 4], &[2]), ("f", &[4], &[])]);
    }

    #[test]
    fn explosions_are_rigid_and_about_the_middle() {
        let a = arrangement(&[square(0., 0., 2.), square(2., 0., 2.)].concat());
        let [plain, exploded] = [1.0, 3.0].map(|factor| Picture::partition(&a, factor));
        for (before, after) in plain.paths.iter().zip(&exploded.paths).take(2) {
            let [p, q] = [before, after].map(|path| mean(path.runs[0].0.clone()));
            assert_eq!(q, [2.0 + 3.0 * (p[0] - 2.0), p[1]]);
            for (x, y) in before.runs[0].0.iter().zip(&after.runs[0].0) {
                assert_eq!([y[0] - x[0], y[1] - x[1]], [q[0] - p[0], q[1] - p[1]]);
            }
        }
        assert_eq!(plain.clone().exploded(1.0), plain);
        assert_eq!(Picture::default().exploded(2.0), Picture::default());
    }

    #[test]
    fn smooth_curves_have_no_dots() {
        let circle = |n: u32| -> Vec<[f64; 4]> {
            let at = |k: u32| (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
            (0..n).map(|k| [at(k).0, at(k).1, at(k + 1).0, at(k + 1).1]).collect()
        };
        for (n, dots) in [(6, 6), (20, 20), (30, 0), (64, 0)] {
            assert_eq!(corners(&arrangement(&circle(n))).len(), dots, "{n}");
        }
        let crossed = [circle(64), vec![[-2.0, 0.3, 2.0, 0.4]]].concat();
        assert_eq!(corners(&arrangement(&crossed)).len(), 4, "two crossings, two ends");
    }

    #[test]
    fn fragments_have_the_colors_of_their_shapes() {
        let a = arrangement(&[square(0., 0., 2.), square(1., 1., 2.)].concat());
        let picture = Picture::fragments(&a, &[4, 4], 1.5);
        let of = |k: usize| {
            let color = cyclic(k).darker();
            picture.paths.iter().filter(|path| path.stroke.is_some_and(|s| s.color == color)).count()
        };
        assert_eq!([picture.paths.len(), of(0), of(1)], [12, 6, 6]);
    }

    #[test]
    fn frames_hold_the_picture() {
        let picture = Picture::outlines([vec![[0., 0.], [30., 0.], [30., 10.]]]);
        let wide = picture.frame([300, 100]);
        assert!(wide.lo[0] < 0.0 && 30.0 < wide.hi[0] && 10.0 < wide.hi[1]);
        assert!((wide.hi[0] - wide.lo[0]) / wide.per_pixel <= 300.0);
        assert!((picture.frame([100, 300]).hi[0] - picture.frame([100, 300]).lo[0]) > 30.0);
        let empty = Picture::default().frame([100, 100]);
        assert!(empty.per_pixel > 0.0 && empty.lo[0] < empty.hi[0]);
        assert!(Picture::default().to_svg([100, 100]).ends_with("</svg>\n"));
    }
}
