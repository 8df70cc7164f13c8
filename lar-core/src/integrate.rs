//! Integrals of monomials x^a y^b z^c over cells, chains, surfaces and solids, and their mass properties.
//!
//! Every cell is a signed sum of simplices: an edge is one, a face the triangles that fan out from the first
//! vertex of each of its loops (hole loops turn the other way and so subtract), a solid the tetrahedra over
//! those triangles from the mean of its vertices. The integral of a monomial over a simplex is its measure times the
//! mean of the monomial's Bernstein coefficients, which are weighted means of products of vertex coordinates:
//! nothing alternates in sign, so high degrees lose no digits, and convex cells have positive simplices only.
//!
//! Source of the task: Cattani, Paoluzzi, "Boundary integration over linear polyhedra", CAD 22 (1990); the
//! binomial sums of that paper alternate and are not used.

mod bernstein;
mod mass;
mod pieces;
mod surfaces;

use crate::listing::first_few;
use crate::{Chain, ChainComplex, ChainError, FaceId, VertexId, Violation};
pub use bernstein::{MAX_DEGREE, triangle_moment};
pub use mass::{MassProperties, PrincipalAxes};
use pieces::{Piece, Pieces};

/// Why an integral cannot be taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegrationError {
    /// The degree a + b + c of the monomial is above [`MAX_DEGREE`].
    #[error("a monomial of degree {degree}; integrals are taken up to degree {MAX_DEGREE}")]
    Degree {
        /// The degree.
        degree: u64,
    },
    /// The points have more than three coordinates, or not three where a solid is integrated.
    #[error("points of {dim} coordinates; integrals are taken in 3-space and, over chains, below it")]
    SpaceDimension {
        /// Coordinates per point.
        dim: usize,
    },
    /// Cells of a dimension above 3 are not integrated over.
    #[error("cells of dimension {p}; integrals are taken over cells up to dimension 3")]
    CellDimension {
        /// Dimension of the cells.
        p: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are {n_vertices} vertices")]
    VertexOutOfRange {
        /// The face, or triangle.
        face: FaceId,
        /// The vertex.
        vertex: VertexId,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// The operators of the complex do not fit each other.
    #[error("not a chain complex: {}", first_few(.0))]
    NotComplex(Vec<Violation>),
    /// The chain is not of the complex.
    #[error(transparent)]
    Chain(#[from] ChainError),
}

impl ChainComplex {
    /// ∫ x^a y^b z^c over each p-cell, `degrees` = [a, b, c]: values at vertices for p = 0, line, surface and
    /// volume integrals for p = 1, 2, 3. Missing coordinates are 0.
    ///
    /// Edges count positive; so do faces in space, while in the plane a clockwise face counts negative, as the
    /// exterior cell does in plane and space. Holes are subtracted. Faces are taken to be flat; of others,
    /// their projection along the mean normal is measured. O(n·g^(p+1)) for n simplices and degree g.
    ///
    /// # Errors
    /// When the degree is above [`MAX_DEGREE`], p is above 3, points have more than 3 coordinates, or the
    /// operators do not fit each other.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
    /// let x_squared = bar.cell_integrals(3, [2, 0, 0]).unwrap();
    /// assert!((x_squared[0] - 1. / 3.).abs() < 1e-15 && (x_squared[1] - 7. / 3.).abs() < 1e-14);
    /// ```
    #[doc(alias("II", "III"))]
    pub fn cell_integrals(&self, p: usize, degrees: [u32; 3]) -> Result<Vec<f64>, IntegrationError> {
        bernstein::check_degree(degrees)?;
        let mut coefficients = Vec::new();
        self.per_cell(p, |pieces| integral(pieces, degrees, &mut coefficients))
    }

    /// ∫ x^a y^b z^c over a chain: the sum over its cells, each times its coefficient. Signs as in
    /// [`cell_integrals`](Self::cell_integrals). O(size of the chain's cells).
    ///
    /// # Errors
    /// As [`cell_integrals`](Self::cell_integrals), and when the chain is not of this complex.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
    /// let minus = square.chain(2, [(0, -1)]).unwrap();
    /// assert!((square.chain_integral(&minus, [1, 1, 0]).unwrap() + 0.25).abs() < 1e-15);
    /// ```
    pub fn chain_integral(&self, chain: &Chain, degrees: [u32; 3]) -> Result<f64, IntegrationError> {
        bernstein::check_degree(degrees)?;
        let mut coefficients = Vec::new();
        let parts = self.per_entry(chain, |pieces| integral(pieces, degrees, &mut coefficients))?;
        Ok(parts.into_iter().map(|(sign, part)| f64::from(sign) * part).sum())
    }

    /// The measure of each p-cell: 1 for vertices, lengths, areas, volumes. Signs as in
    /// [`cell_integrals`](Self::cell_integrals). O(size).
    ///
    /// # Errors
    /// As [`cell_integrals`](Self::cell_integrals).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap().with_exterior().unwrap();
    /// assert_eq!(square.cell_measures(1).unwrap(), [1., 1., 1., 1.]);
    /// assert_eq!(square.cell_measures(2).unwrap(), [-1., 1.]);
    /// ```
    #[doc(alias("surface", "volume"))]
    pub fn cell_measures(&self, p: usize) -> Result<Vec<f64>, IntegrationError> {
        self.per_cell(p, measure)
    }

    /// The area of each 2-chain: the sum of the areas of its faces, each times its coefficient; in the plane
    /// clockwise faces count negative. O(size of the faces named).
    ///
    /// # Errors
    /// When a chain is no 2-chain of this complex, and as [`cell_integrals`](Self::cell_integrals).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let grid = ChainComplex::from_model(&cuboid_grid(&[3, 1])).unwrap();
    /// let chains = [grid.chain(2, [(0, 1), (2, 1)]).unwrap(), grid.chain(2, [(1, -2)]).unwrap()];
    /// assert_eq!(grid.chain_areas(&chains).unwrap(), [2., -2.]);
    /// ```
    #[doc(alias = "chainAreas")]
    pub fn chain_areas(&self, chains: &[Chain]) -> Result<Vec<f64>, IntegrationError> {
        let area = |chain: &Chain| {
            chain.check_fits(2, self.n_cells(2))?;
            let parts = self.per_entry(chain, measure)?;
            Ok(parts.into_iter().map(|(sign, part)| f64::from(sign) * part).sum())
        };
        chains.iter().map(area).collect()
    }

    /// The mass properties of each p-cell at unit density per point, length, area or volume. O(size).
    ///
    /// # Errors
    /// As [`cell_integrals`](Self::cell_integrals).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
    /// let cells = bar.mass_properties(3).unwrap();
    /// assert_eq!(cells[1].centroid().unwrap(), [1.5, 0.5, 0.5]);
    /// ```
    #[doc(alias("centroid", "firstMoment", "secondMoment", "inertiaProduct", "inertiaMoment"))]
    pub fn mass_properties(&self, p: usize) -> Result<Vec<MassProperties>, IntegrationError> {
        self.per_cell(p, MassProperties::of_pieces)
    }

    /// The mass properties of a chain; each cell has its coefficient as density. O(size of the chain's cells).
    ///
    /// # Errors
    /// As [`chain_integral`](Self::chain_integral).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
    /// let whole = bar.chain_mass_properties(&bar.chain(3, [(0, 1), (1, 1)]).unwrap()).unwrap();
    /// assert_eq!((whole.mass(), whole.centroid()), (2., Some([1., 0.5, 0.5])));
    /// ```
    pub fn chain_mass_properties(&self, chain: &Chain) -> Result<MassProperties, IntegrationError> {
        let parts = self.per_entry(chain, MassProperties::of_pieces)?;
        Ok(parts.iter().map(|(sign, part)| part.times(f64::from(*sign))).sum())
    }

    fn per_cell<T>(&self, p: usize, f: impl FnMut(&[Piece]) -> T) -> Result<Vec<T>, IntegrationError> {
        self.per_named_cell(p, 0..self.n_cells(p), f)
    }

    fn per_entry<T>(
        &self,
        chain: &Chain,
        f: impl FnMut(&[Piece]) -> T,
    ) -> Result<Vec<(i32, T)>, IntegrationError> {
        chain.check_fits(chain.dim(), self.n_cells(chain.dim()))?;
        let cells = chain.entries().iter().map(|e| e.0 as usize);
        let values = self.per_named_cell(chain.dim(), cells, f)?;
        Ok(chain.entries().iter().map(|e| e.1).zip(values).collect())
    }

    fn per_named_cell<T>(
        &self,
        p: usize,
        cells: impl Iterator<Item = usize>,
        mut f: impl FnMut(&[Piece]) -> T,
    ) -> Result<Vec<T>, IntegrationError> {
        let mut pieces = Pieces::new(self, p)?;
        Ok(cells.map(|cell| f(pieces.of_cell(cell))).collect())
    }
}

fn measure(pieces: &[Piece]) -> f64 {
    pieces.iter().map(|piece| piece.measure).sum()
}

fn integral(pieces: &[Piece], degrees: [u32; 3], coefficients: &mut Vec<f64>) -> f64 {
    pieces.iter().map(|piece| piece.measure * bernstein::mean(piece.vertices(), degrees, coefficients)).sum()
}
