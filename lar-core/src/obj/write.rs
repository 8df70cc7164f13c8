//! Writing OBJ: coordinates in the shortest form that reads back as the same `f64`.

use super::ObjError;
use crate::files::TextWriter;
use crate::{ChainComplex, FaceId, Points, TriangleMesh, VertexId, atomic_write};
use std::io::{self, Write};
use std::path::Path;

impl TriangleMesh {
    /// Writes the mesh as an OBJ file, whole or not at all. O(size).
    ///
    /// # Errors
    /// When a triangle names a vertex that does not exist, the points are not of two or three coordinates, or
    /// the file cannot be written.
    pub fn write_obj(&self, path: impl AsRef<Path>) -> Result<(), ObjError> {
        self.check_writable()?;
        atomic_write(path, |out| self.write(out))?;
        Ok(())
    }

    /// The mesh as the text of an OBJ file. O(size).
    ///
    /// # Errors
    /// As [`write_obj`](Self::write_obj).
    ///
    /// ```
    /// use lar_core::{Points, TriangleMesh};
    /// let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0.1, 1e-9, 0.]]);
    /// let mesh = TriangleMesh { points, triangles: vec![[0, 1, 2]] };
    /// assert_eq!(mesh.to_obj()?, "v 0 0 0\nv 1 0 0\nv 0.1 1e-9 0\nf 1 2 3\n");
    /// # Ok::<(), lar_core::ObjError>(())
    /// ```
    pub fn to_obj(&self) -> Result<String, ObjError> {
        self.check_writable()?;
        Ok(text(|out| self.write(out)))
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut out = TextWriter::new(out);
        write_vertices(&mut out, &self.points)?;
        self.triangles.iter().try_for_each(|triangle| write_face(&mut out, triangle))?;
        out.finish()
    }

    fn check_writable(&self) -> Result<(), ObjError> {
        check_points(&self.points)?;
        let n_vertices = self.points.len();
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= n_vertices) {
                return Err(ObjError::Triangle { triangle, vertex, n_vertices });
            }
        }
        Ok(())
    }
}

impl ChainComplex {
    /// Writes the faces of the complex as polygons of an OBJ file, whole or not at all. O(size).
    ///
    /// # Errors
    /// When a face has holes, the complex has no 2-cells or breaks its laws, the points are not of two or three
    /// coordinates, or the file cannot be written.
    pub fn write_obj(&self, path: impl AsRef<Path>) -> Result<(), ObjError> {
        let faces = self.polygons()?;
        atomic_write(path, |out| write_polygons(out, self.points(), &faces))?;
        Ok(())
    }

    /// The faces of the complex as the text of an OBJ file. O(size).
    ///
    /// # Errors
    /// As [`write_obj`](Self::write_obj).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
    /// assert!(square.to_obj()?.ends_with("v 1 1 0\nf 1 3 4 2\n"));
    /// # Ok::<(), lar_core::ObjError>(())
    /// ```
    pub fn to_obj(&self) -> Result<String, ObjError> {
        let faces = self.polygons()?;
        Ok(text(|out| write_polygons(out, self.points(), &faces)))
    }

    fn polygons(&self) -> Result<Vec<Vec<u32>>, ObjError> {
        let (dim, violations) = (self.dim(), self.validate().len());
        if dim < 2 || violations > 0 {
            return Err(ObjError::NotPolygonal { dim, violations });
        }
        check_points(self.points())?;
        let mut polygons = Vec::with_capacity(self.n_cells(2));
        for (f, face) in (0..self.n_cells(2)).zip((0..).map(FaceId)) {
            let mut loops = self.face_loops(f);
            match (loops.pop(), loops.len()) {
                (Some(polygon), 0) => polygons.push(polygon),
                (last, n) => {
                    return Err(ObjError::FaceWithHoles { face, loops: n + usize::from(last.is_some()) });
                }
            }
        }
        Ok(polygons)
    }
}

fn check_points(points: &Points) -> Result<(), ObjError> {
    let dim = points.dim();
    if dim != 2 && dim != 3 {
        return Err(ObjError::PointSize { dim });
    }
    points.non_finite().next().map_or(Ok(()), |(i, axis, value)| {
        let vertex = VertexId(u32::try_from(i).unwrap_or(u32::MAX));
        Err(ObjError::Coordinate { vertex, axis, value })
    })
}

fn text(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("writing to memory does not fail");
    String::from_utf8(bytes).expect("numbers and letters are UTF-8")
}

fn write_polygons(out: &mut dyn Write, points: &Points, faces: &[Vec<u32>]) -> io::Result<()> {
    let mut out = TextWriter::new(out);
    write_vertices(&mut out, points)?;
    faces.iter().try_for_each(|face| write_face(&mut out, face))?;
    out.finish()
}

/// `v x y z`; plane points have z = 0.
pub(crate) fn write_vertices(out: &mut TextWriter<'_>, points: &Points) -> io::Result<()> {
    for point in points.iter() {
        out.push("v");
        for k in 0..3 {
            out.push(" ");
            out.number(point.get(k).copied().unwrap_or(0.));
        }
        out.end_line()?;
    }
    Ok(())
}

pub(crate) fn write_face(out: &mut TextWriter<'_>, vertices: &[u32]) -> io::Result<()> {
    out.push("f");
    for &v in vertices {
        out.push(" ");
        out.integer(u64::from(v) + 1);
    }
    out.end_line()
}

#[cfg(test)]
mod tests {
    use super::super::{ObjGrouping, parse_obj, read_obj};
    use super::*;
    use crate::{Surface, cuboid_grid, icosphere, r};
    use proptest::prelude::*;

    #[test]
    fn cube_as_polygons() {
        let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
        insta::assert_snapshot!(cube.to_obj().unwrap());
    }

    #[test]
    fn files() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("ball.obj");
        let ball = icosphere(2);
        ball.write_obj(&path).unwrap();
        let back = read_obj(&path, ObjGrouping::Whole).unwrap();
        assert_eq!(back, [Surface::from_triangles("ball", &ball)]);
        let error = ball.write_obj(dir.path().join("no/ball.obj")).unwrap_err().to_string();
        assert!(error.starts_with("cannot write") && error.contains("ball.obj"), "{error}");
    }

    #[track_caller]
    fn check_number(x: f64, expected: &str) {
        let mesh = TriangleMesh { points: Points::from_xyz(&[[x, 0., 0.]]), triangles: Vec::new() };
        assert_eq!(mesh.to_obj().unwrap(), format!("v {expected} 0 0\n"));
    }

    #[test]
    fn numbers_are_short() {
        check_number(-0., "-0");
        check_number(0.1 + 0.2, "0.30000000000000004");
        check_number(-1e15, "-1000000000000000");
        check_number(1e300, "1e300");
        check_number(5e-324, "5e-324");
        check_number(0.00001, "0.00001");
    }

    #[test]
    fn refusals() {
        let mut mesh = icosphere(0);
        mesh.triangles[3][1] = 99;
        assert_eq!(mesh.to_obj().unwrap_err().to_string(), "triangle 3 names vertex 99 of 12");
        mesh.points.coords_mut()[5] = f64::NAN;
        assert_eq!(mesh.to_obj().unwrap_err().to_string(), "coordinate 2 of vertex v1 is NaN");
        let line = ChainComplex::from_model(&cuboid_grid(&[3])).unwrap();
        let message = "a complex of dimension 1 with 0 violations of its laws cannot be written as OBJ";
        assert_eq!(line.to_obj().unwrap_err().to_string(), message);
        let flat = TriangleMesh { points: Points::new(4), triangles: Vec::new() };
        assert_eq!(
            flat.to_obj().unwrap_err().to_string(),
            "points of 4 coordinates cannot be written as OBJ"
        );
    }

    proptest! {
        #[test]
        fn coordinates_read_back_exactly(bits in prop::collection::vec(any::<u64>(), 9)) {
            let coords: Vec<f64> = bits.into_iter().map(f64::from_bits).collect();
            prop_assume!(coords.iter().all(|x| x.is_finite()));
            let mesh = TriangleMesh { points: Points::from_columns(3, coords), triangles: vec![[2, 0, 1]] };
            let back = parse_obj(&mesh.to_obj().unwrap(), "a.obj", ObjGrouping::Whole).unwrap();
            prop_assert_eq!(&back[0], &Surface::from_triangles("a", &mesh));
        }

        #[test]
        fn rotated_cubes_read_back(v in prop::array::uniform3(-3.0..3.0_f64)) {
            let cube = cuboid_grid(&[1, 1, 1]).transformed(&r(v)).unwrap();
            let text = ChainComplex::from_model(&cube).unwrap().to_obj().unwrap();
            let back = &parse_obj(&text, "a.obj", ObjGrouping::Whole).unwrap()[0];
            prop_assert_eq!(back.points.coords(), cube.points().coords());
            prop_assert_eq!(back.boundary_edges(), []);
        }
    }
}
