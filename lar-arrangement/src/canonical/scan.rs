//! Which points are nearly one, and which pairs of facets lie nearly in one plane.

use super::{Input, Tolerance, near};
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::vector::{distance, dot, minus};

/// Pairs of facets a chunk of work.
const PAIRS_A_CHUNK: usize = 1 << 11;

/// What the pass found.
#[derive(Debug)]
pub(crate) struct Scan {
    /// Pairs of points within the tolerance, ascending.
    pub near: Vec<[u32; 2]>,
    /// Pairs of facets of different polygons that lie nearly in one plane.
    pub coplanar: Vec<[u32; 2]>,
}

/// A facet seen as a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    unit: [f64; 3],
    origin: [f64; 3],
    /// Twice the area of the triangle that gives the plane, over its longest side.
    pub width: f64,
    /// No corner is farther from the origin.
    reach: f64,
    /// How far from a plane its corners may lie.
    planes: f64,
}

/// The same in 32 bits, for the great majority of pairs.
#[derive(Clone, Copy, Debug)]
struct Outline {
    unit: [f32; 3],
    width: f32,
    reach: f32,
    planes: f32,
}

impl Scan {
    pub(crate) fn new(input: &Input, course: &Course) -> Result<Self, Cancelled> {
        let largest = Tolerance::largest(&input.soup.tolerances).planes();
        let of_pairs = || {
            let outlines = Outlines::new(input);
            let is_coplanar = |pair: &[u32; 2]| {
                let [f, g] = pair.map(|f| outlines.number[f as usize] as usize);
                let is_across = outlines.outlines[f].is_across(&outlines.outlines[g]);
                !is_across && are_nearly_coplanar(input, *pair, |f| *outlines.shape(f))
            };
            let (n_chunks, range) = parallel::chunks(input.pairs.len(), PAIRS_A_CHUNK);
            course.map(n_chunks, |chunk| {
                input.pairs[range(chunk)].iter().copied().filter(is_coplanar).collect::<Vec<_>>()
            })
        };
        let of_neighbours = || {
            let (n_chunks, range) = parallel::chunks(input.soup.edges.len(), PAIRS_A_CHUNK);
            course.map(n_chunks, |chunk| {
                let pairs = range(chunk).filter_map(|edge| {
                    let pair = input.neighbours_at(edge as u32)?;
                    has_coplanar_sides(input, edge as u32, pair, largest).then_some(pair)
                });
                pairs.collect::<Vec<_>>()
            })
        };
        // The first is one thread's work; the others have the second to do meanwhile.
        let (near, coplanar) = parallel::join(|| near::points(input), || Ok((of_pairs()?, of_neighbours()?)));
        let (of_pairs, of_neighbours) = coplanar?;
        course.go_on()?;
        Ok(Self { near, coplanar: of_pairs.into_iter().chain(of_neighbours).flatten().collect() })
    }
}

/// Outlines of the facets that are in some pair.
struct Outlines {
    number: Vec<u32>,
    outlines: Vec<Outline>,
    shapes: Vec<Shape>,
}

impl Outlines {
    fn new(input: &Input) -> Self {
        let mut number = vec![u32::MAX; input.soup.n_facets()];
        let mut paired = Vec::new();
        for &facet in input.pairs.as_flattened() {
            if number[facet as usize] == u32::MAX {
                number[facet as usize] = paired.len() as u32;
                paired.push(facet);
            }
        }
        let shapes = parallel::map_light(paired.len(), |i| Shape::of(input, paired[i]));
        let outlines = parallel::map_light(shapes.len(), |i| Outline::of(&shapes[i]));
        Self { number, outlines, shapes }
    }

    fn shape(&self, facet: u32) -> &Shape {
        &self.shapes[self.number[facet as usize] as usize]
    }
}

/// Whether the facets at an edge, which are not among the pairs, lie nearly in one plane.
fn has_coplanar_sides(input: &Input, edge: u32, pair: [u32; 2], largest: f64) -> bool {
    !is_bent(input, edge, pair, largest) && are_nearly_coplanar(input, pair, |f| Shape::of(input, f))
}

/// Whether two triangles at an edge are bent there by more than the tolerance. Their planes hold the edge; the corner of
/// one lies off the plane of the other by det / |n|, and `nearly_holds` allows for tolerance · (1 + 2 · distance / width)
/// with width = |n| / longest side. No length is above s, and |n| not above s².
fn is_bent(input: &Input, edge: u32, pair: [u32; 2], tolerance: f64) -> bool {
    let (soup, geometry) = (input.soup, &input.soup.geometry);
    if !soup.are_triangles() && !pair.iter().all(|&f| soup.is_triangle(f)) {
        return false;
    }
    let [p, q] = soup.edges[edge as usize];
    let origin = geometry.position(p);
    let to = |at: u32| minus(geometry.position(at), origin);
    let to_corner = |f: u32| {
        let [a, b, c] = geometry.base(f);
        to(a ^ b ^ c ^ p ^ q)
    };
    // Edges are in the order of the first facets that have them: those have been read last.
    let first = pair[0].min(pair[1]);
    let [own, off] = [first, pair[0] ^ pair[1] ^ first].map(to_corner);
    // For the sum s of the three sizes this is at least s²; no root is needed.
    let square = 3.0 * [to(q), own, off].iter().map(|&v| dot(v, v)).sum::<f64>();
    // Rounding changes the determinant by less than 2^-48 · s³, and s is below 2^44.
    dot(geometry.normal(first), off).abs() > (4.0 * tolerance + 1.0) * square
}

fn are_nearly_coplanar(input: &Input, [f, g]: [u32; 2], shape: impl Fn(u32) -> Shape) -> bool {
    let polygons = [f, g].map(|f| input.soup.facet_polygon[f as usize]);
    if polygons[0] == polygons[1] || polygons.iter().any(|&p| !input.soup.polygon_flat[p as usize]) {
        return false;
    }
    let (a, b) = (&shape(f), &shape(g));
    let (wide, narrow, facet) = if a.width >= b.width { (a, b, g) } else { (b, a, f) };
    wide.nearly_holds(narrow, input.corners(facet).map(|p| input.soup.geometry.position(p)))
}

impl Outline {
    fn of(shape: &Shape) -> Self {
        Self {
            unit: shape.unit.map(|x| x as f32),
            width: shape.width as f32,
            reach: shape.reach as f32,
            planes: shape.planes as f32,
        }
    }

    /// Whether the angle between the planes alone tells that two facets whose boxes meet are not nearly coplanar.
    fn is_across(&self, other: &Self) -> bool {
        let (m, n) = (self.unit, other.unit);
        let normal = [m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2], m[0] * n[1] - m[1] * n[0]];
        let sine = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        let (wide, narrow) = (self.width.max(other.width), self.width.min(other.width));
        let tolerance = self.planes.max(other.planes);
        // Two corners of a facet of width w at an angle to the plane differ in height by w · sine, and `nearly_holds` allows
        // for twice its limit. The boxes are within the reach of the origins and, up to the tolerance, meet; rounding to
        // 32 bits changes a sine by less than 2^-20.
        let apart = 2.0 * (self.reach + other.reach + 2.0 * tolerance) + self.reach.max(other.reach);
        (sine - 1e-6) * narrow > 2.0 * tolerance * (1.0 + 2.0 * apart / wide)
    }
}

impl Shape {
    pub(super) fn of(input: &Input, facet: u32) -> Self {
        let geometry = &input.soup.geometry;
        let [a, b, c] = geometry.base(facet).map(|p| geometry.position(p));
        let normal = geometry.normal(facet);
        let length = dot(normal, normal).sqrt();
        let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
        let reach = match input.soup.facet_edges[facet as usize].len() {
            3 => longest,
            _ => input.corners(facet).map(|p| distance(a, geometry.position(p))).fold(0.0, f64::max),
        };
        Self {
            unit: normal.map(|x| x / length),
            origin: a,
            width: length / longest,
            reach,
            planes: input.tolerance(facet).planes(),
        }
    }

    /// Whether the corners of another facet lie near this one's plane, the tolerance growing with the distance.
    fn nearly_holds(&self, other: &Self, mut corners: impl Iterator<Item = [f64; 3]>) -> bool {
        let tolerance = self.planes.max(other.planes);
        let limit = |distance: f64| tolerance * (1.0 + 2.0 * distance / self.width);
        corners.all(|p| {
            let d = minus(p, self.origin);
            dot(self.unit, d).abs() <= limit(dot(d, d).sqrt())
        })
    }
}
