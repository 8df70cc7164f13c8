//! Figure 3: the pipeline from two solids to the chain complex, in eight panels.

use super::collection::{Drawn, Request};
use super::gallery::counts;
use super::parts::{Part, Point, Segment, cyclic, exploded, moved, plain};
use super::sheet::{ABOVE, Eye, Panel, Sheet, lettered};
use crate::shapes::{self, Shapes};
use crate::{CommandError, scenes};
use lar_arrangement::planar::{Dangling, Drawing, PlanarArrangement, PlanarArranger};
use lar_arrangement::{Arrangement, arrange};
use lar_core::Surface;
use lar_viewer::{Bounds, CellShape, Coloring, INK, Rgb, palette_color};

/// The second cube is turned so that the chosen face meets several of its faces.
const SEED: u64 = 2;

/// Codes of the palette: σ, and the faces that may meet it.
const SIGMA: u32 = 2;
const OTHERS: u32 = 4;

const GHOST: Rgb = [0.6, 0.63, 0.68];
const EYE: Eye = Eye { azimuth: -2.2, elevation: 0.45 };

/// A face of the input and those that may meet it.
struct Local {
    /// In the order of all faces of the input.
    faces: Vec<CellShape>,
    sigma: usize,
    others: Vec<usize>,
}

/// Figure 3, of two crossing cubes.
pub(super) fn figure3(request: &Request) -> Result<Drawn, CommandError> {
    let scene = scenes::crossing_cubes(request.seed.unwrap_or(SEED));
    let surfaces = scenes::surfaces(&scene)?;
    let arrangement = arrange(&surfaces)?;
    let local = Local::new(&surfaces)?;
    let planar = PlanarArranger::new().dangling(Dangling::Keep).arrange(&local.drawing())?;
    let [a, b] = solids(&surfaces)?;
    let [g, h] = exploded_cells(&arrangement)?;
    let [c, d, e] = [local.candidates(), local.flattened(), local.segments()];
    let panels = lettered([a, b, c, d, e, crossings(&planar), g, h]);
    let title = "the pipeline, from two solids to the cells of their arrangement";
    let figure = Sheet { panels, columns: 4 }.figure("figure3", title, 300, request.size)?;
    let [vertices, edges] = [planar.n_vertices(), planar.n_edges()];
    let text = format!(
        "face f{} may meet {} others; in its plane: {} segments, {vertices} vertices and {edges} edges\n",
        local.sigma,
        local.others.len(),
        local.cuts().len()
    );
    Ok(Drawn { numbers: text + &counts(&arrangement), figures: vec![figure] })
}

/// Panels a and b: the solids, and their faces exploded.
fn solids(surfaces: &[Surface]) -> Result<[Panel; 2], CommandError> {
    let shapes = (0..).zip(surfaces).map(|(i, s)| shapes::surface(s, i)).collect::<Result<Vec<_>, _>>()?;
    let faces = surfaces.iter().map(shapes::surface_faces).collect::<Result<Vec<_>, _>>()?.concat();
    let solids = Panel::new(cyclic(shapes, 1.0)).from(EYE);
    Ok([solids, Panel::new(cyclic(exploded(faces, [1.7; 3]), 1.0)).from(EYE)])
}

/// Panels g and h: the faces and the cells of the arrangement, exploded.
fn exploded_cells(arrangement: &Arrangement) -> Result<[Panel; 2], CommandError> {
    let shapes = Shapes::new(arrangement)?;
    let cells = shapes.bounded_cells()?;
    let faces = Panel::new(cyclic(exploded(shapes.faces()?, [1.7; 3]), 1.0)).from(EYE);
    Ok([faces, Panel::new(cyclic(exploded(cells, [2.4; 3]), 0.75)).from(EYE)])
}

impl Local {
    /// Of the faces of the first solid that look towards the eye, the one with the most faces whose boxes meet its own.
    fn new(surfaces: &[Surface]) -> Result<Self, CommandError> {
        let faces = surfaces.iter().map(shapes::surface_faces).collect::<Result<Vec<_>, _>>()?.concat();
        let boxes: Vec<Option<Bounds>> =
            faces.iter().map(|f| Bounds::of(f.edges.as_flattened().iter().copied())).collect();
        let meeting = |sigma: usize| -> Vec<usize> {
            (0..boxes.len()).filter(|&f| f != sigma && meet(boxes[f], boxes[sigma])).collect()
        };
        // Quadratic in the dozen faces of two cubes.
        let all: Vec<Vec<usize>> = (0..faces.len()).map(meeting).collect();
        let first = 0..surfaces.first().map_or(0, Surface::n_faces);
        let sigma =
            first.filter(|&f| looks_at_eye(&faces[f])).max_by_key(|&f| all[f].len()).unwrap_or_default();
        let others = all.into_iter().nth(sigma).unwrap_or_default();
        Ok(Self { faces, sigma, others })
    }

    fn sigma_and_others(&self, place: impl Fn(Point) -> Point) -> Vec<Part> {
        let one = |f: usize| moved(self.faces[f].clone(), &place);
        let others = plain(self.others.iter().map(|&f| one(f)), palette_color(OTHERS), 0.4);
        Part::of_cell(one(self.sigma), palette_color(SIGMA), 1.0).into_iter().chain(others).collect()
    }

    /// Panel c: σ, the others, and the edges of the rest.
    fn candidates(&self) -> Panel {
        let mut parts = self.sigma_and_others(|p| p);
        parts.extend(self.faces.iter().map(|face| Part::outline(face, GHOST, 1.0)));
        Panel::new(parts).from(EYE)
    }

    /// The affine map that brings σ into z = 0, its first corner to the origin and its first side to the x axis.
    fn to_plane(&self) -> impl Fn(Point) -> Point + use<> {
        let mesh = &self.faces[self.sigma].mesh;
        let corner = mesh.triangles.first().copied().unwrap_or_default().map(|v| mesh.points.xyz(v as usize));
        let [origin, u, v] = [corner[0], sub(corner[1], corner[0]), sub(corner[2], corner[0])];
        let x = unit(u);
        let z = unit(cross(u, v));
        let y = cross(z, x);
        move |p| {
            let p = sub(p, origin);
            [dot(p, x), dot(p, y), dot(p, z)]
        }
    }

    /// Panel d: σ in z = 0 with the others.
    fn flattened(&self) -> Panel {
        let place = self.to_plane();
        let parts = self.sigma_and_others(place);
        let plane = Bounds::of(parts.iter().flat_map(Part::points)).map(|b| outline_of_plane(&b));
        Panel::new(parts.into_iter().chain(plane.into_iter().flatten()))
            .from(Eye { azimuth: -1.05, elevation: 0.5 })
    }

    /// Where the others meet the plane of σ, each with its face.
    fn cuts(&self) -> Vec<(usize, Segment)> {
        let place = self.to_plane();
        let cut = |&f: &usize| Some((f, cut(&moved(self.faces[f].clone(), &place))?));
        self.others.iter().filter_map(cut).collect()
    }

    fn sides(&self) -> Vec<Segment> {
        moved(self.faces[self.sigma].clone(), self.to_plane()).edges
    }

    /// Panel e: the sides of σ, and where the others meet its plane.
    fn segments(&self) -> Panel {
        let cuts = self.cuts().into_iter().map(|(_, segment)| segment).collect();
        let cuts = Part::lines("others", cuts, palette_color(OTHERS), 3.0);
        Panel::new([Part::lines("face", self.sides(), palette_color(SIGMA), 3.0), cuts]).from(ABOVE)
    }

    fn drawing(&self) -> Drawing {
        let all = self.sides().into_iter().chain(self.cuts().into_iter().map(|(_, segment)| segment));
        let flat: Vec<[f64; 4]> = all.map(|[a, b]| [a[0], a[1], b[0], b[1]]).collect();
        Drawing::from_segments(&flat)
    }
}

/// Panel f: the edges into which the segments cut each other, and the crossings.
fn crossings(planar: &PlanarArrangement) -> Panel {
    let complex = planar.complex();
    let at = |v: u32| {
        let p = complex.points().point(v as usize);
        [p[0], p[1], 0.0]
    };
    let edges = (0..planar.n_edges()).filter_map(|e| complex.edge_ends(e)).enumerate();
    let line = |(i, ends): (usize, [u32; 2])| {
        Part::lines("edge", vec![ends.map(at)], Coloring::Cyclic.color(i), 3.0)
    };
    let dots = Part::dots("vertices", (0..planar.n_vertices() as u32).map(at).collect(), INK, 8.0);
    Panel::new(edges.map(line).chain([dots])).from(ABOVE)
}

/// The segment in which a convex face meets z = 0; `None` when it does not reach through the plane or lies in it.
fn cut(face: &CellShape) -> Option<Segment> {
    let mut ends: Vec<Point> = face.edges.iter().filter_map(|&[a, b]| through(a, b)).collect();
    ends.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    ends.dedup();
    match ends.as_slice() {
        [first, .., last] => Some([*first, *last]),
        _ => None,
    }
}

/// Where a segment passes z = 0.
fn through(a: Point, b: Point) -> Option<Point> {
    let parts = a[2] / (a[2] - b[2]);
    let crosses = (a[2] < 0.0) != (b[2] < 0.0);
    crosses.then(|| [a[0] + parts * (b[0] - a[0]), a[1] + parts * (b[1] - a[1]), 0.0])
}

/// The rectangle of z = 0 within a box, as lines.
fn outline_of_plane(bounds: &Bounds) -> [Part; 1] {
    let [lo, hi] = [bounds.min, bounds.max];
    let corners = [[lo[0], lo[1]], [hi[0], lo[1]], [hi[0], hi[1]], [lo[0], hi[1]]].map(|[x, y]| [x, y, 0.0]);
    let sides = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
    [Part::lines("z = 0", sides, GHOST, 1.5)]
}

/// Whether the outer side of a face is seen.
fn looks_at_eye(face: &CellShape) -> bool {
    face.mesh.triangles.first().is_some_and(|t| {
        let [a, b, c] = t.map(|v| face.mesh.points.xyz(v as usize));
        0.0 < dot(cross(sub(b, a), sub(c, a)), EYE.direction())
    })
}

fn meet(a: Option<Bounds>, b: Option<Bounds>) -> bool {
    let (Some(a), Some(b)) = (a, b) else { return false };
    (0..3).all(|k| a.min[k] <= b.max[k] && b.min[k] <= a.max[k])
}

fn sub(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}
