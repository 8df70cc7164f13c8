//! Integrals over polygonal surfaces and triangle meshes, and over what they enclose.

use super::pieces::{Piece, fan, mean_vertex, push_face};
use super::{IntegrationError, MassProperties, bernstein, integral};
use crate::{FaceId, Points, Surface, TriangleMesh, VertexId};

impl TriangleMesh {
    /// ∫ x^a y^b z^c dS over the triangles, each counted positive; `degrees` = [a, b, c]. O(n·g³) for degree g.
    ///
    /// # Errors
    /// When the degree is above [`MAX_DEGREE`](crate::MAX_DEGREE), points are not of 3 coordinates, or a
    /// triangle names a vertex that does not exist.
    ///
    /// ```
    /// let ball = lar_core::icosphere(4);
    /// assert!((ball.surface_integral([2, 0, 0]).unwrap() - ball.area() / 3.).abs() < 0.02);
    /// ```
    #[doc(alias("II", "surface"))]
    pub fn surface_integral(&self, degrees: [u32; 3]) -> Result<f64, IntegrationError> {
        bernstein::check_degree(degrees)?;
        Ok(integral(&self.shell_pieces()?, degrees, &mut Vec::new()))
    }

    /// ∫ x^a y^b z^c dV over the inside of a closed mesh, negative where it faces inward. O(n·g⁴) for degree g.
    /// An open mesh is closed by cones from the mean of its vertices.
    ///
    /// # Errors
    /// As [`surface_integral`](Self::surface_integral).
    ///
    /// ```
    /// let ball = lar_core::icosphere(2);
    /// assert!((ball.volume_integral([0, 0, 0]).unwrap() - ball.signed_volume()).abs() < 1e-12);
    /// assert!(ball.volume_integral([1, 0, 2]).unwrap().abs() < 1e-12);
    /// ```
    #[doc(alias("III", "volume"))]
    pub fn volume_integral(&self, degrees: [u32; 3]) -> Result<f64, IntegrationError> {
        bernstein::check_degree(degrees)?;
        Ok(integral(&self.solid_pieces()?, degrees, &mut Vec::new()))
    }

    /// The mass properties of the triangles as a thin shell. O(n).
    ///
    /// # Errors
    /// When points are not of 3 coordinates, or a triangle names a vertex that does not exist.
    pub fn shell_mass_properties(&self) -> Result<MassProperties, IntegrationError> {
        Ok(MassProperties::of_pieces(&self.shell_pieces()?))
    }

    /// The mass properties of the inside of a closed mesh. O(n).
    ///
    /// # Errors
    /// As [`shell_mass_properties`](Self::shell_mass_properties).
    ///
    /// ```
    /// let body = lar_core::icosphere(4).solid_mass_properties().unwrap();
    /// let exact = 0.4 * body.mass(); // 2/5 m r² of a ball
    /// assert!((body.inertia_moments()[0] / exact - 1.).abs() < 0.01);
    /// ```
    #[doc(alias("centroid", "firstMoment", "secondMoment", "inertiaProduct", "inertiaMoment"))]
    pub fn solid_mass_properties(&self) -> Result<MassProperties, IntegrationError> {
        Ok(MassProperties::of_pieces(&self.solid_pieces()?))
    }

    fn shell_pieces(&self) -> Result<Vec<Piece>, IntegrationError> {
        self.check_vertices()?;
        Ok(self.triangles.iter().flat_map(|t| fan(&self.points, t)).map(Piece::triangle).collect())
    }

    fn solid_pieces(&self) -> Result<Vec<Piece>, IntegrationError> {
        self.check_vertices()?;
        let apex = mean_vertex(&self.points, self.triangles.iter().flatten().copied());
        let triangles = self.triangles.iter().flat_map(|t| fan(&self.points, t));
        Ok(triangles.map(|triangle| Piece::cone(1., triangle, apex)).collect())
    }

    fn check_vertices(&self) -> Result<(), IntegrationError> {
        check_loops(&self.points, (0..).zip(self.triangles.iter().map(|t| &t[..])))
    }
}

impl Surface {
    /// ∫ x^a y^b z^c dS over the faces, each counted positive and without its holes; `degrees` = [a, b, c].
    /// O(n·g³) for degree g.
    ///
    /// # Errors
    /// When the degree is above [`MAX_DEGREE`](crate::MAX_DEGREE), points are not of 3 coordinates, or a face
    /// names a vertex that does not exist.
    ///
    /// ```
    /// let cube = lar_core::cuboid_grid(&[1, 1, 1]).to_surface("cube").unwrap();
    /// assert_eq!(cube.surface_integral([0, 0, 0]).unwrap(), 6.);
    /// ```
    #[doc(alias("II", "surface"))]
    pub fn surface_integral(&self, degrees: [u32; 3]) -> Result<f64, IntegrationError> {
        bernstein::check_degree(degrees)?;
        Ok(integral(&self.shell_pieces()?, degrees, &mut Vec::new()))
    }

    /// ∫ x^a y^b z^c dV over what the faces, each times its coefficient, enclose. O(n·g⁴) for degree g. An open
    /// surface is closed by cones from the mean of its vertices.
    ///
    /// # Errors
    /// As [`surface_integral`](Self::surface_integral).
    ///
    /// ```
    /// let bar = lar_core::cuboid_grid(&[2, 1, 1]).to_surface("bar").unwrap();
    /// assert!((bar.volume_integral([1, 1, 0]).unwrap() - 1.).abs() < 1e-15);
    /// ```
    #[doc(alias("III", "volume"))]
    pub fn volume_integral(&self, degrees: [u32; 3]) -> Result<f64, IntegrationError> {
        bernstein::check_degree(degrees)?;
        Ok(integral(&self.solid_pieces()?, degrees, &mut Vec::new()))
    }

    /// The mass properties of the faces as a thin shell. O(n).
    ///
    /// # Errors
    /// When points are not of 3 coordinates, or a face names a vertex that does not exist.
    pub fn shell_mass_properties(&self) -> Result<MassProperties, IntegrationError> {
        Ok(MassProperties::of_pieces(&self.shell_pieces()?))
    }

    /// The mass properties of what the faces, each times its coefficient, enclose. O(n).
    ///
    /// # Errors
    /// As [`shell_mass_properties`](Self::shell_mass_properties).
    ///
    /// ```
    /// let cube = lar_core::cuboid_grid(&[1, 1, 1]).to_surface("cube").unwrap();
    /// let body = cube.solid_mass_properties().unwrap();
    /// assert!(body.inertia_products().iter().all(|x| (x - 0.25).abs() < 1e-15));
    /// ```
    #[doc(alias("centroid", "firstMoment", "secondMoment", "inertiaProduct", "inertiaMoment"))]
    pub fn solid_mass_properties(&self) -> Result<MassProperties, IntegrationError> {
        Ok(MassProperties::of_pieces(&self.solid_pieces()?))
    }

    fn shell_pieces(&self) -> Result<Vec<Piece>, IntegrationError> {
        self.check_vertices()?;
        let mut pieces = Vec::new();
        for f in 0..self.n_faces() {
            push_face(&self.points, &self.face(f).collect::<Vec<_>>(), &mut pieces);
        }
        Ok(pieces)
    }

    fn solid_pieces(&self) -> Result<Vec<Piece>, IntegrationError> {
        self.check_vertices()?;
        let bounding = || (0..self.n_faces()).filter(|&f| self.coefficient(f) != 0);
        let apex = mean_vertex(&self.points, bounding().flat_map(|f| self.face(f)).flatten().copied());
        let mut pieces = Vec::new();
        for f in bounding() {
            let factor = f64::from(self.coefficient(f));
            let triangles = self.face(f).flat_map(|cycle| fan(&self.points, cycle));
            pieces.extend(triangles.map(|triangle| Piece::cone(factor, triangle, apex)));
        }
        Ok(pieces)
    }

    fn check_vertices(&self) -> Result<(), IntegrationError> {
        check_loops(&self.points, (0..self.n_faces()).flat_map(|f| self.face(f).map(move |l| (f, l))))
    }
}

/// Three coordinates a point, and only vertices that exist.
fn check_loops<'a>(
    points: &Points,
    loops: impl Iterator<Item = (usize, &'a [u32])>,
) -> Result<(), IntegrationError> {
    let (dim, n_vertices) = (points.dim(), points.len());
    if dim != 3 {
        return Err(IntegrationError::SpaceDimension { dim });
    }
    for (face, cycle) in loops {
        if let Some(&v) = cycle.iter().find(|&&v| v as usize >= n_vertices) {
            let face = FaceId(u32::try_from(face).unwrap_or(u32::MAX));
            return Err(IntegrationError::VertexOutOfRange { face, vertex: VertexId(v), n_vertices });
        }
    }
    Ok(())
}
