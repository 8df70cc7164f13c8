//! What can be written as a surface file: points and faces of one loop.

use super::error::MeshFileError;
use super::format::{MeshFormat, write_as};
use super::gltf;
use super::text::TextWriter;
use crate::obj::{write_face, write_vertices};
use crate::{Points, Surface, TriangleMesh, VertexId};
use std::io::{self, Write};
use std::path::Path;

/// Points and polygonal faces: [`TriangleMesh`] and [`Surface`].
pub trait PolygonMesh: sealed::Sealed {
    /// d × n, d = 2 or 3; plane points are written with z = 0.
    fn points(&self) -> &Points;

    /// Number of faces.
    fn n_faces(&self) -> usize;

    /// The outer loop of face `f`, empty when it has none; panics when `f` is not below `n_faces()`.
    fn polygon(&self, f: usize) -> &[u32];

    /// Number of loops of face `f`, and of vertices in all of them.
    fn face_size(&self, f: usize) -> (usize, usize);

    /// The mesh as the bytes of a file.
    ///
    /// # Errors
    /// As [`write_mesh`](crate::write_mesh), but for the writing.
    ///
    /// ```
    /// use lar_core::{MeshFormat, PolygonMesh, icosphere};
    /// let bytes = icosphere(0).to_bytes(MeshFormat::StlBinary)?;
    /// assert_eq!(bytes.len(), 84 + 20 * 50);
    /// # Ok::<(), lar_core::MeshFileError>(())
    /// ```
    fn to_bytes(&self, format: MeshFormat) -> Result<Vec<u8>, MeshFileError>
    where
        Self: Sized,
    {
        if matches!(format, MeshFormat::Gltf | MeshFormat::Glb) {
            return gltf::of_mesh(self, format, Path::new("mesh"));
        }
        check(self, format)?;
        let mut bytes = Vec::new();
        write_as(self, format, &mut bytes).expect("writing to memory does not fail");
        Ok(bytes)
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for crate::TriangleMesh {}
    impl Sealed for crate::Surface {}
}

impl PolygonMesh for TriangleMesh {
    fn points(&self) -> &Points {
        &self.points
    }
    fn n_faces(&self) -> usize {
        self.triangles.len()
    }
    fn polygon(&self, f: usize) -> &[u32] {
        &self.triangles[f]
    }
    fn face_size(&self, _: usize) -> (usize, usize) {
        (1, 3)
    }
}

impl PolygonMesh for Surface {
    fn points(&self) -> &Points {
        &self.points
    }
    fn n_faces(&self) -> usize {
        Self::n_faces(self)
    }
    fn polygon(&self, f: usize) -> &[u32] {
        self.face(f).next().unwrap_or_default()
    }
    fn face_size(&self, f: usize) -> (usize, usize) {
        (self.face(f).len(), self.face(f).map(<[u32]>::len).sum())
    }
}

/// Refuses what the format cannot hold, before a byte is written.
pub(crate) fn check(mesh: &impl PolygonMesh, format: MeshFormat) -> Result<(), MeshFileError> {
    check_points(
        mesh.points(),
        matches!(format, MeshFormat::StlBinary | MeshFormat::Gltf | MeshFormat::Glb),
    )?;
    let n_vertices = mesh.points().len();
    for face in 0..mesh.n_faces() {
        let (loops, vertices) = mesh.face_size(face);
        let triangles = format.is_triangular();
        if loops != 1 || vertices < 3 || triangles && vertices != 3 {
            return Err(MeshFileError::NotAPolygon { face, loops, vertices, triangles });
        }
        if let Some(&vertex) = mesh.polygon(face).iter().find(|&&v| v as usize >= n_vertices) {
            return Err(MeshFileError::VertexOutOfRange { face, vertex, n_vertices });
        }
    }
    let largest = n_vertices.max(mesh.n_faces());
    match u32::try_from(largest) {
        Ok(_) => Ok(()),
        Err(_) => Err(MeshFileError::TooLarge { bytes: largest as u64 }),
    }
}

fn check_points(points: &Points, single: bool) -> Result<(), MeshFileError> {
    let dim = points.dim();
    if dim != 2 && dim != 3 {
        return Err(MeshFileError::PointSize { dim });
    }
    let held = |x: f64| if single { (x as f32).is_finite() } else { x.is_finite() };
    match points.coords().iter().position(|&x| !held(x)) {
        None => Ok(()),
        Some(i) => {
            let vertex = VertexId(u32::try_from(i / dim).unwrap_or(u32::MAX));
            Err(MeshFileError::Coordinate { vertex, axis: i % dim, value: points.coords()[i] })
        }
    }
}

/// The polygons of a mesh, face after face.
pub(crate) fn polygons<M: PolygonMesh>(mesh: &M) -> impl Iterator<Item = &[u32]> {
    (0..mesh.n_faces()).map(|f| mesh.polygon(f))
}

pub(crate) fn write_obj(mesh: &impl PolygonMesh, out: &mut dyn Write) -> io::Result<()> {
    let mut out = TextWriter::new(out);
    write_vertices(&mut out, mesh.points())?;
    polygons(mesh).try_for_each(|polygon| write_face(&mut out, polygon))?;
    out.finish()
}

/// `x y z`, each in the shortest form that reads back exactly.
pub(crate) fn write_point(out: &mut TextWriter<'_>, [x, y, z]: [f64; 3]) -> io::Result<()> {
    out.number(x);
    for number in [y, z] {
        out.push(" ");
        out.number(number);
    }
    out.end_line()
}

/// `n v1 … vn`.
pub(crate) fn write_line(out: &mut TextWriter<'_>, polygon: &[u32]) -> io::Result<()> {
    out.integer(polygon.len() as u64);
    for &v in polygon {
        out.push(" ");
        out.integer(v.into());
    }
    out.end_line()
}
