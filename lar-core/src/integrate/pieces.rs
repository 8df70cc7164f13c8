//! Cells as signed sums of simplices.

use super::IntegrationError;
use crate::ChainComplex;
use crate::Points;
use crate::measure::{Vec3, cross, dot, loop_area_vector, sub, xyz};

/// A simplex with its signed measure: a vertex, edge, triangle or tetrahedron.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) measure: f64,
    vertices: [Vec3; 4],
    n_vertices: usize,
}

impl Piece {
    fn new<const N: usize>(measure: f64, corners: [Vec3; N]) -> Self {
        let mut vertices = [[0.; 3]; 4];
        vertices[..N].copy_from_slice(&corners);
        Self { measure, vertices, n_vertices: N }
    }

    pub(super) fn vertices(&self) -> &[Vec3] {
        &self.vertices[..self.n_vertices]
    }

    /// The triangle, counted positive.
    pub(super) fn triangle(corners: [Vec3; 3]) -> Self {
        let normal = doubled_area(corners);
        Self::new(dot(normal, normal).sqrt() / 2., corners)
    }

    /// `factor` times the tetrahedron from `apex` over a triangle that turns counter-clockwise seen from outside.
    pub(super) fn cone(factor: f64, [a, b, c]: [Vec3; 3], apex: Vec3) -> Self {
        let six = dot(sub(a, apex), cross(sub(b, apex), sub(c, apex)));
        Self::new(factor * six / 6., [apex, a, b, c])
    }
}

fn doubled_area([a, b, c]: [Vec3; 3]) -> Vec3 {
    cross(sub(b, a), sub(c, a))
}

/// The triangles that fan out from the first vertex of a loop.
pub(super) fn fan<'a>(points: &'a Points, cycle: &'a [u32]) -> impl Iterator<Item = [Vec3; 3]> + 'a {
    let at = |v: u32| xyz(points, v as usize);
    let rest = cycle.get(1..).unwrap_or_default();
    rest.windows(2).map(move |w| [at(cycle[0]), at(w[0]), at(w[1])])
}

/// The triangles of a face, each with the sign with which it turns about the face's normal; in the plane the
/// normal is the z axis.
pub(super) fn push_face<C: AsRef<[u32]>>(points: &Points, loops: &[C], pieces: &mut Vec<Piece>) {
    let Some(normal) = unit_normal(points, loops) else { return };
    for triangle in loops.iter().flat_map(|cycle| fan(points, cycle.as_ref())) {
        pieces.push(Piece::new(dot(doubled_area(triangle), normal) / 2., triangle));
    }
}

fn unit_normal<C: AsRef<[u32]>>(points: &Points, loops: &[C]) -> Option<Vec3> {
    if points.dim() < 3 {
        return Some([0., 0., 1.]);
    }
    let mut sum = [0.; 3];
    for vector in loops.iter().map(|cycle| loop_area_vector(points, cycle.as_ref())) {
        sum = [0, 1, 2].map(|k| sum[k] + vector[k]);
    }
    let size = sum.iter().fold(0_f64, |m, x| m.max(x.abs()));
    let scaled = sum.map(|x| x / size);
    (size > 0.).then(|| scaled.map(|x| x / dot(scaled, scaled).sqrt()))
}

/// The mean of some vertices, the origin when there are none.
pub(super) fn mean_vertex(points: &Points, vertices: impl Iterator<Item = u32>) -> Vec3 {
    let (mut sum, mut n) = ([0.; 3], 0.);
    for v in vertices {
        let p = xyz(points, v as usize);
        sum = [0, 1, 2].map(|k| sum[k] + p[k]);
        n += 1.;
    }
    if n > 0. { sum.map(|x| x / n) } else { sum }
}

/// The p-cells of a complex as simplices, one cell at a time.
pub(super) struct Pieces<'a> {
    complex: &'a ChainComplex,
    p: usize,
    /// The loops of the faces met so far.
    loops: Vec<Option<Vec<Vec<u32>>>>,
    pieces: Vec<Piece>,
}

impl<'a> Pieces<'a> {
    pub(super) fn new(complex: &'a ChainComplex, p: usize) -> Result<Self, IntegrationError> {
        let (dim, violations) = (complex.points().dim(), complex.shape_violations());
        if !violations.is_empty() {
            return Err(IntegrationError::NotComplex(violations));
        }
        if p > 3 {
            return Err(IntegrationError::CellDimension { p });
        }
        if dim > 3 || (dim < 3 && p == 3) {
            return Err(IntegrationError::SpaceDimension { dim });
        }
        let n_faces = if p >= 2 { complex.n_cells(2) } else { 0 };
        Ok(Self { complex, p, loops: vec![None; n_faces], pieces: Vec::new() })
    }

    /// The simplices of a cell that exists.
    pub(super) fn of_cell(&mut self, cell: usize) -> &[Piece] {
        self.pieces.clear();
        let points = self.complex.points();
        match self.p {
            0 => self.pieces.push(Piece::new(1., [xyz(points, cell)])),
            1 => self.push_edge(cell),
            2 => {
                let loops = self.complex.face_loops(cell);
                push_face(points, &loops, &mut self.pieces);
            }
            _ => self.push_solid(cell),
        }
        &self.pieces
    }

    fn push_edge(&mut self, e: usize) {
        if let Some(ends) = self.complex.edge_ends(e) {
            let [a, b] = ends.map(|v| xyz(self.complex.points(), v as usize));
            let along = sub(b, a);
            self.pieces.push(Piece::new(dot(along, along).sqrt(), [a, b]));
        }
    }

    fn push_solid(&mut self, cell: usize) {
        let points = self.complex.points();
        let Some(column) = self.complex.boundary(3).outer_view(cell) else { return };
        for &f in column.indices() {
            self.loops[f as usize].get_or_insert_with(|| self.complex.face_loops(f as usize));
        }
        let loops = |f: u32| self.loops[f as usize].iter().flatten();
        let apex = mean_vertex(points, column.indices().iter().flat_map(|&f| loops(f)).flatten().copied());
        for (&f, &sign) in column.indices().iter().zip(column.data()) {
            let triangles = loops(f).flat_map(|cycle| fan(points, cycle));
            self.pieces.extend(triangles.map(|triangle| Piece::cone(f64::from(sign), triangle, apex)));
        }
    }
}
