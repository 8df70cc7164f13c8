//! Complexes from polygons with holes, and back to polygons and to models.

use crate::complex::sign_columns;
use crate::{Cells, ChainComplex, FaceId, Model, ModelError, ModelViolation, Points, Surface, VertexId};
use rustc_hash::FxHashMap;

impl ChainComplex {
    /// The complex of dimension 2 of faces given as directed loops: `faces[f]` are the loops of face f, holes
    /// turned the other way than outer loops. The orientation of the loops is kept. Edges are the sides of the
    /// loops, numbered in first-seen order; a side that a face runs along in both directions (a slit) is no
    /// part of its boundary. O(n) expected.
    ///
    /// # Errors
    /// When a loop names a vertex that does not exist, a vertex follows itself, or a face runs along an edge
    /// twice in one direction.
    ///
    /// ```
    /// use lar_core::{ChainComplex, Points};
    /// let xy = [0., 0., 4., 0., 4., 4., 0., 4., 1., 1., 1., 2., 2., 2., 2., 1.];
    /// let points = Points::from_columns(2, xy.to_vec());
    /// let ring = vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]];
    /// let complex = ChainComplex::from_face_loops(points, &[ring.clone()]).unwrap();
    /// assert_eq!((complex.f_vector(), complex.face_area(0)), (vec![8, 8, 1], 15.));
    /// assert_eq!(complex.all_face_loops(), [ring]);
    /// ```
    #[doc(alias("build_copFE", "lar2cop"))]
    pub fn from_face_loops(points: Points, faces: &[Vec<Vec<u32>>]) -> Result<Self, ModelError> {
        let faces = faces.iter().map(|loops| loops.iter().map(Vec::as_slice));
        let (edges, columns) = edges_and_columns(points.len(), faces)?;
        let d1 = sign_columns(points.len(), edges.iter().map(|&[a, b]| [(a, -1), (b, 1)]));
        let d2 = sign_columns(edges.len(), columns.into_iter());
        Ok(Self::new(points, vec![d1, d2]))
    }

    /// The complex of the faces of a surface, holes included; see [`from_face_loops`](Self::from_face_loops).
    /// The coefficients of the faces are not kept.
    ///
    /// # Errors
    /// As [`from_face_loops`](Self::from_face_loops).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let surface = cuboid_grid(&[1, 1, 1]).to_surface("cube").unwrap();
    /// let complex = ChainComplex::from_surface(&surface).unwrap();
    /// assert_eq!(complex.f_vector(), [8, 12, 6]);
    /// assert_eq!(complex.betti_numbers().unwrap(), [1, 0, 1]);
    /// ```
    pub fn from_surface(surface: &Surface) -> Result<Self, ModelError> {
        let faces: Vec<Vec<Vec<u32>>> =
            (0..surface.n_faces()).map(|f| surface.face(f).map(<[u32]>::to_vec).collect()).collect();
        Self::from_face_loops(surface.points.clone(), &faces)
    }

    /// The loops of every face, as [`face_loops`](Self::face_loops) gives them. O(n log n).
    ///
    /// # Panics
    /// When the complex has no ∂2 or its operators do not fit each other.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let two = ChainComplex::from_model(&cuboid_grid(&[2, 1])).unwrap();
    /// assert_eq!(two.all_face_loops(), [[[0, 2, 3, 1]], [[2, 4, 5, 3]]]);
    /// ```
    #[doc(alias = "faces2polygons")]
    #[must_use]
    pub fn all_face_loops(&self) -> Vec<Vec<Vec<u32>>> {
        (0..self.n_cells(2)).map(|f| self.face_loops(f)).collect()
    }

    /// The model with the vertices of each cell: 0-cells are all points, each p-cell the rising list of the
    /// vertices of its boundary. Orientation is lost, and so is the difference between an outer loop and a
    /// hole. O(size of the products).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let grid = cuboid_grid(&[2, 2, 1]);
    /// assert_eq!(ChainComplex::from_model(&grid).unwrap().to_model(), grid);
    /// ```
    #[doc(alias = "cop2lar")]
    #[must_use]
    pub fn to_model(&self) -> Model {
        let incidence = self.incidence();
        let above = (1..=self.dim()).map(|p| incidence.relation(p, 0));
        let cells = std::iter::once(Cells::singletons(self.n_cells(0))).chain(above).collect();
        Model::new(self.points().clone(), cells)
    }
}

type Columns = Vec<Vec<(u32, i8)>>;

/// The sides of the loops and the columns of ∂2 over them.
fn edges_and_columns<'a, L: Iterator<Item = &'a [u32]>>(
    n_vertices: usize,
    faces: impl Iterator<Item = L>,
) -> Result<(Vec<[u32; 2]>, Columns), ModelError> {
    let mut edges: Vec<[u32; 2]> = Vec::new();
    let mut edge_of = FxHashMap::default();
    let mut columns = Vec::new();
    for (face, loops) in (0..).zip(faces) {
        let mut uses: Vec<(u32, i64)> = Vec::new();
        for cycle in loops {
            check_loop(face, cycle, n_vertices)?;
            for (i, &a) in cycle.iter().enumerate() {
                let b = cycle[(i + 1) % cycle.len()];
                let ends = [a.min(b), a.max(b)];
                let edge = *edge_of.entry(ends).or_insert_with(|| {
                    edges.push(ends);
                    u32::try_from(edges.len() - 1).expect("fewer than 2^32 edges")
                });
                uses.push((edge, if a < b { 1 } else { -1 }));
            }
        }
        uses.sort_unstable();
        columns.push(column(FaceId(face), &uses, &edges)?);
    }
    Ok((edges, columns))
}

fn check_loop(face: u32, cycle: &[u32], n_vertices: usize) -> Result<(), ModelError> {
    let (dim, cell) = (2, face as usize);
    let mut violations = Vec::new();
    for (i, &v) in cycle.iter().enumerate() {
        if v as usize >= n_vertices {
            violations.push(ModelViolation::VertexOutOfRange { dim, cell, vertex: VertexId(v), n_vertices });
        } else if cycle[(i + 1) % cycle.len()] == v {
            violations.push(ModelViolation::RepeatedVertex { dim, cell, vertex: VertexId(v) });
        }
    }
    if violations.is_empty() { Ok(()) } else { Err(ModelError::Malformed(violations)) }
}

/// The sums of the sorted uses, which are −1, 0 or +1.
fn column(face: FaceId, uses: &[(u32, i64)], edges: &[[u32; 2]]) -> Result<Vec<(u32, i8)>, ModelError> {
    let mut entries = Vec::with_capacity(uses.len());
    for same in uses.chunk_by(|a, b| a.0 == b.0) {
        let (edge, sum) = (same[0].0, same.iter().map(|u| u.1).sum::<i64>());
        let [a, b] = edges[edge as usize].map(VertexId);
        match sum {
            0 => (),
            1 => entries.push((edge, 1)),
            -1 => entries.push((edge, -1)),
            _ => {
                let side = if sum > 0 { [a, b] } else { [b, a] };
                let times = u32::try_from(sum.unsigned_abs()).unwrap_or(u32::MAX);
                return Err(ModelError::RepeatedSide { face, side, times });
            }
        }
    }
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cuboid_grid, simplex, triangular_prism};

    fn points(n: u32) -> Points {
        Points::from_columns(2, (0..n).flat_map(|i| [f64::from(i), f64::from(i * i)]).collect())
    }

    #[track_caller]
    fn check_error(faces: &[Vec<Vec<u32>>], message: &str) {
        assert_eq!(ChainComplex::from_face_loops(points(5), faces).unwrap_err().to_string(), message);
    }

    #[test]
    fn refusals() {
        check_error(
            &[vec![vec![0, 1, 2]], vec![vec![0, 1, 5]]],
            "malformed model: 2-cell 1 names vertex v5, but there are 5 vertices",
        );
        check_error(&[vec![vec![0, 1, 1]]], "malformed model: 2-cell 0 names vertex v1 more than once");
        check_error(&[vec![vec![4]]], "malformed model: 2-cell 0 names vertex v4 more than once");
        check_error(
            &[vec![vec![0, 2, 1], vec![2, 1, 3]]],
            "2-cell f0 runs 2 times from vertex v2 to vertex v1",
        );
    }

    //  0 ------- 1      a slit from the outer loop to vertex 4 is no boundary
    //  |    4    |
    //  |   /     |
    //  3 ------- 2
    #[test]
    fn slits_cancel() {
        let slit = vec![vec![0, 3, 4, 3, 2, 1]];
        let complex = ChainComplex::from_face_loops(points(5), &[slit]).unwrap();
        assert_eq!((complex.f_vector(), complex.boundary(2).nnz()), (vec![5, 5, 1], 4));
        assert_eq!(complex.validate(), []);
    }

    #[test]
    fn polygons_there_and_back() {
        for model in [cuboid_grid(&[3, 2]), cuboid_grid(&[2, 1, 1]), simplex(3), triangular_prism()] {
            let complex = ChainComplex::from_model(&model).unwrap();
            let polygons = complex.all_face_loops();
            let again = ChainComplex::from_face_loops(model.points().clone(), &polygons).unwrap();
            assert_eq!(again.validate(), []);
            assert_eq!(again.all_face_loops(), polygons);
            assert_eq!(again.n_cells(1), complex.n_cells(1));
            assert_eq!(complex.to_model().f_vector(), model.f_vector());
        }
    }

    #[test]
    fn no_faces_at_all() {
        let complex = ChainComplex::from_face_loops(points(2), &[]).unwrap();
        assert_eq!((complex.f_vector(), complex.validate()), (vec![2, 0, 0], vec![]));
    }
}
