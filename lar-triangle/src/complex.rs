//! All faces of a complex, and meshes of its faces and cells (stage 7).

use crate::TriangulateError;
use crate::face::{Quality, Triangulator};
use crate::flat::small;
use crate::loops::{FaceLoops, columns};
use crate::parallel;
use lar_core::{CellId, ChainComplex, FaceId, Points, TriangleMesh};
use std::ops::Range;

/// Triangles of every face of a complex.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Triangulation {
    /// Triangles over the points of the complex, turning like their faces.
    pub triangles: Vec<[u32; 3]>,
    /// Face f has the triangles `face_offsets[f]..face_offsets[f + 1]`.
    pub face_offsets: Vec<u32>,
    /// Number of faces with a triangulation that is only combinatorial ([`Quality::Combinatorial`]).
    pub fallbacks: usize,
}

impl Triangulation {
    /// Triangulates all faces, given by their loops.
    /// O(n log n) for n corners of one face, as a rule; some faces after the other on each thread of the current pool.
    ///
    /// # Errors
    /// Those of [`crate::triangulate_face`], of the first face that has one, and [`TriangulateError::TooMany`].
    pub fn new(points: &Points, loops: &FaceLoops) -> Result<Self, TriangulateError> {
        let parts = parallel::map_parts(loops.n_faces(), |faces| Self::of_part(points, loops, faces))?;
        let n_triangles: usize = parts.iter().map(|part| part.triangles.len()).sum();
        small(n_triangles)?;
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_default();
        all.triangles.reserve_exact(n_triangles - all.triangles.len());
        all.face_offsets.reserve_exact(loops.n_faces() + 1 - all.face_offsets.len());
        parts.for_each(|part| all.append(&part));
        Ok(all)
    }

    fn of_part(points: &Points, loops: &FaceLoops, faces: Range<usize>) -> Result<Self, TriangulateError> {
        let mut all = Self { face_offsets: vec![0], ..Self::default() };
        let mut triangulator = Triangulator::new();
        for f in faces {
            let quality = triangulator.face(points, loops.face(FaceId(f as u32)), &mut all.triangles)?;
            all.fallbacks += usize::from(quality == Quality::Combinatorial);
            all.face_offsets.push(small(all.triangles.len())?);
        }
        Ok(all)
    }

    /// Adds the faces of another, behind its own.
    fn append(&mut self, other: &Self) {
        let begin = self.triangles.len() as u32;
        self.triangles.extend_from_slice(&other.triangles);
        self.face_offsets.extend(other.face_offsets[1..].iter().map(|end| begin + end));
        self.fallbacks += other.fallbacks;
    }

    /// Number of faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.face_offsets.len().saturating_sub(1)
    }

    /// The triangles of a face; none for a face that does not exist.
    #[must_use]
    pub fn face_triangles(&self, f: FaceId) -> &[[u32; 3]] {
        let range = self.face_offsets.get(f.index()).zip(self.face_offsets.get(f.index() + 1));
        range.map_or(&[], |(&from, &to)| &self.triangles[from as usize..to as usize])
    }

    /// The mesh of some faces; those with a negative sign are turned round, those with 0 left out. Its points are
    /// 3 × n (z = 0 for planar complexes), only the used ones, in the order of their indices.
    ///
    /// Time O(k log k) for k triangles.
    ///
    /// # Errors
    /// [`TriangulateError::NoSuchFace`] and [`TriangulateError::NoSuchVertex`] when faces or points do not belong to
    /// this triangulation, [`TriangulateError::Dimension`] when the points have not 2 or 3 coordinates.
    pub fn mesh_of_faces(
        &self,
        points: &Points,
        faces: impl IntoIterator<Item = (FaceId, i8)>,
    ) -> Result<TriangleMesh, TriangulateError> {
        let mut triangles = Vec::new();
        for (face, sign) in faces {
            if self.n_faces() <= face.index() {
                return Err(TriangulateError::NoSuchFace { face, faces: self.n_faces() });
            }
            self.push_signed(face, sign, &mut triangles);
        }
        compact(points, triangles)
    }

    /// The boundary of a 3-cell as a mesh, its triangles turned outward: column `c` of ∂3 has +1 where the normal
    /// of the face points out of the cell. (The exterior cell's mesh is turned out of the exterior, that is, into the
    /// solid.)
    ///
    /// # Errors
    /// [`TriangulateError::NoSuchCell`], [`TriangulateError::ComplexDimension`] when there are no 3-cells, and those
    /// of [`Self::mesh_of_faces`].
    pub fn cell_mesh(&self, complex: &ChainComplex, c: CellId) -> Result<TriangleMesh, TriangulateError> {
        let cells = columns(complex, 3)?;
        let column = cells.outer_view(c.index());
        let column = column.ok_or(TriangulateError::NoSuchCell { cell: c, cells: cells.cols() })?;
        self.mesh_of_faces(complex.points(), column.iter().map(|(f, &sign)| (FaceId(f as u32), sign)))
    }

    fn push_signed(&self, face: FaceId, sign: i8, triangles: &mut Vec<[u32; 3]>) {
        let own = self.face_triangles(face).iter();
        match sign.signum() {
            1 => triangles.extend(own),
            -1 => triangles.extend(own.map(|&[a, b, c]| [a, c, b])),
            _ => {}
        }
    }
}

/// Triangulates all faces of a complex of dimension 2 or 3 (or more: its 2-cells).
///
/// Time O(n log n) in the corners of the faces, shared by the threads of the current pool, with buffers shared by the faces of each.
///
/// # Errors
/// Those of [`FaceLoops::new`] and [`crate::triangulate_face`].
///
/// ```
/// use lar_core::{CellId, ChainComplex, cuboid_grid};
/// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
/// let faces = lar_triangle::triangulate(&bar)?;
/// assert_eq!((faces.n_faces(), faces.triangles.len(), faces.fallbacks), (11, 22, 0));
/// let cube = faces.cell_mesh(&bar, CellId(1))?;
/// assert_eq!((cube.points.len(), cube.triangles.len(), cube.signed_volume()), (8, 12, 1.0));
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
pub fn triangulate(complex: &ChainComplex) -> Result<Triangulation, TriangulateError> {
    Triangulation::new(complex.points(), &FaceLoops::new(complex)?)
}

/// The triangles of a 3D complex by 3-cell and by 2-cell, and the boundary edges by 2-cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellTriangles {
    /// Triangles by 2-cell.
    pub faces: Triangulation,
    /// Boundary loops by 2-cell; [`FaceLoops::face_edges`] gives the edges.
    pub loops: FaceLoops,
    triangles: Vec<[u32; 3]>,
    offsets: Vec<u32>,
}

impl CellTriangles {
    /// Number of 3-cells.
    #[must_use]
    pub fn n_cells(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The triangles around a 3-cell, turned outward; none for a cell that does not exist.
    #[must_use]
    pub fn cell(&self, c: CellId) -> &[[u32; 3]] {
        let range = self.offsets.get(c.index()).zip(self.offsets.get(c.index() + 1));
        range.map_or(&[], |(&from, &to)| &self.triangles[from as usize..to as usize])
    }
}

/// Triangles per 3-cell and per 2-cell of a 3D complex, and its boundary edges per 2-cell. All indices are those of
/// the complex.
///
/// Time O(n log n) in the corners of the faces, memory O(n).
///
/// # Errors
/// Those of [`triangulate`], and [`TriangulateError::ComplexDimension`] when there are no 3-cells.
///
/// ```
/// use lar_core::{CellId, ChainComplex, FaceId, cuboid_grid};
/// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
/// let all = lar_triangle::triangulate_cells(&bar)?;
/// assert_eq!(all.n_cells(), 2);
/// assert_eq!(all.cell(CellId(0)).len(), 12);
/// assert_eq!(all.faces.face_triangles(FaceId(0)).len(), 2);
/// assert_eq!(all.loops.face_edges(FaceId(0)).count(), 4);
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
#[doc(alias = "pols2tria")]
pub fn triangulate_cells(complex: &ChainComplex) -> Result<CellTriangles, TriangulateError> {
    let cells = columns(complex, 3)?;
    let loops = FaceLoops::new(complex)?;
    let faces = Triangulation::new(complex.points(), &loops)?;
    let cells = parallel::map_parts(cells.cols(), |part| {
        let (mut triangles, mut offsets) = (Vec::new(), Vec::with_capacity(part.len()));
        for column in part.filter_map(|c| cells.outer_view(c)) {
            column.iter().for_each(|(f, &sign)| faces.push_signed(FaceId(f as u32), sign, &mut triangles));
            offsets.push(triangles.len());
        }
        Ok((triangles, offsets))
    })?;
    let mut triangles = Vec::with_capacity(cells.iter().map(|(triangles, _)| triangles.len()).sum());
    let mut offsets = vec![0];
    for (of_part, ends) in cells {
        for end in ends {
            offsets.push(small(triangles.len() + end)?);
        }
        triangles.extend(of_part);
    }
    Ok(CellTriangles { faces, loops, triangles, offsets })
}

/// The mesh of some triangles with the points that they use.
fn compact(points: &Points, mut triangles: Vec<[u32; 3]>) -> Result<TriangleMesh, TriangulateError> {
    if !(2..=3).contains(&points.dim()) {
        return Err(TriangulateError::Dimension { found: points.dim(), expected: "2 or 3" });
    }
    let mut used = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    if let Some(&vertex) = used.last().filter(|&&v| points.len() <= v as usize) {
        return Err(TriangulateError::NoSuchVertex { vertex: vertex.into(), points: points.len() });
    }
    let mut coords = Vec::with_capacity(3 * used.len());
    for &v in &used {
        let p = points.point(v as usize);
        coords.extend([p[0], p[1], p.get(2).copied().unwrap_or(0.0)]);
    }
    for v in triangles.as_flattened_mut() {
        *v = used.partition_point(|u| u < v) as u32;
    }
    Ok(TriangleMesh { points: Points::from_columns(3, coords), triangles })
}
