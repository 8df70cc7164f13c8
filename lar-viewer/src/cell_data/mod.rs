//! What is known of the cells on show: boundaries and coboundaries, measures, centroids, the solids they come from.
//!
//! All of it is asked of the chain complex once, so that walking from cell to cell is a look-up.

mod incidence;
mod inside;
mod place;
mod provenance;

pub use provenance::{FaceParent, Provenance};

use crate::scene::finite;
use crate::{CellRef, ViewerError};
use lar_core::{ChainComplex, Operator};

/// Length, area or volume of a cell, and its centre of mass where it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// Number of dimensions of the cell; 1 for a vertex, else its length, area or volume.
    pub size: f64,
    /// Centre of mass; `None` for a cell without size.
    pub centroid: Option<[f64; 3]>,
}

/// A chain complex with everything that a viewer tells of its cells.
///
/// ```
/// use lar_core::{ChainComplex, cuboid_grid};
/// use lar_viewer::{CellData, CellRef};
/// let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1]))?;
/// let data = CellData::new(bar)?;
/// let second = CellRef { dim: 3, index: 1 };
/// assert_eq!(data.boundary(second).unwrap().entries().len(), 6);
/// assert_eq!(data.measures(second).unwrap().centroid, Some([1.5, 0.5, 0.5]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CellData {
    complex: ChainComplex,
    /// ∂p+1 by rows: row i of `rows[p]` is the coboundary of p-cell i.
    rows: Vec<Operator>,
    measures: Vec<Vec<Measures>>,
    provenance: Provenance,
    has_exterior: bool,
    triangles: Vec<[u32; 3]>,
    /// Face f has the triangles `offsets[f]..offsets[f + 1]`.
    offsets: Vec<u32>,
}

impl CellData {
    /// What is to be known of a complex of dimension 3 at most. O(size).
    ///
    /// # Errors
    /// `Coordinate` with the vertex when a coordinate is NaN or too large to be drawn; `Complex` when the operators do
    /// not fit each other or the dimension is above 3.
    pub fn new(complex: ChainComplex) -> Result<Self, ViewerError> {
        for (index, point) in complex.points().iter().enumerate() {
            finite("complex", "vertex", index, point)?;
        }
        let measures = (0..=complex.dim()).map(|p| {
            let cells = complex.mass_properties(p)?.into_iter();
            Ok(cells.map(|m| Measures { size: m.mass().abs(), centroid: m.centroid() }).collect())
        });
        let measures = measures.collect::<Result<_, lar_core::IntegrationError>>()?;
        let rows = (1..=complex.dim()).map(|p| complex.boundary(p).to_csr()).collect();
        Ok(Self {
            complex,
            rows,
            measures,
            provenance: Provenance::default(),
            has_exterior: false,
            triangles: Vec::new(),
            offsets: Vec::new(),
        })
    }

    /// With cell 0 of the highest dimension as the exterior.
    #[must_use]
    pub fn with_exterior(self) -> Self {
        Self { has_exterior: true, ..self }
    }

    /// With triangles of the faces over the vertices of the complex: face f has `triangles[offsets[f]..offsets[f + 1]]`.
    /// O(triangles).
    ///
    /// # Errors
    /// `PointOutOfRange` when a triangle names a vertex that does not exist.
    pub fn with_triangles(self, triangles: Vec<[u32; 3]>, offsets: Vec<u32>) -> Result<Self, ViewerError> {
        let n_points = self.n_cells(0);
        let corners = triangles.iter().enumerate().flat_map(|(t, corners)| corners.map(|v| (t, v)));
        match corners.into_iter().find(|&(_, v)| n_points <= v as usize) {
            Some((triangle, point)) => {
                let drawable = "complex".to_owned();
                Err(ViewerError::PointOutOfRange { drawable, triangle, point, n_points })
            }
            None => Ok(Self { triangles, offsets, ..self }),
        }
    }

    /// All triangles, and where those of each face begin.
    pub(crate) fn all_triangles(&self) -> (&[[u32; 3]], &[u32]) {
        (&self.triangles, &self.offsets)
    }

    /// Where the cells come from.
    pub(crate) fn provenance(&self) -> &Provenance {
        &self.provenance
    }

    /// The triangles of a face; none when they are not known.
    #[must_use]
    pub fn triangles(&self, face: u32) -> &[[u32; 3]] {
        let ends = self.offsets.get(face as usize).zip(self.offsets.get(face as usize + 1));
        ends.and_then(|(&from, &to)| self.triangles.get(from as usize..to as usize)).unwrap_or_default()
    }

    /// The complex.
    #[must_use]
    pub fn complex(&self) -> &ChainComplex {
        &self.complex
    }

    /// Dimension of the highest cells.
    #[must_use]
    pub fn dim(&self) -> u8 {
        // Measures are refused above dimension 3.
        self.complex.dim() as u8
    }

    /// Number of cells of a dimension.
    #[must_use]
    pub fn n_cells(&self, dim: u8) -> usize {
        self.complex.n_cells(usize::from(dim))
    }

    /// Whether there is such a cell.
    #[must_use]
    pub fn contains(&self, cell: CellRef) -> bool {
        cell.dim <= self.dim() && (cell.index as usize) < self.n_cells(cell.dim)
    }

    /// Whether the cell is the exterior.
    #[must_use]
    pub fn is_exterior(&self, cell: CellRef) -> bool {
        self.has_exterior && cell.dim == self.dim() && cell.index == 0
    }

    /// Whether cell 0 of the highest dimension is the exterior.
    #[must_use]
    pub fn has_exterior(&self) -> bool {
        self.has_exterior
    }

    /// Measure and centroid of a cell; `None` when there is no such cell.
    #[must_use]
    pub fn measures(&self, cell: CellRef) -> Option<Measures> {
        self.measures.get(usize::from(cell.dim))?.get(cell.index as usize).copied()
    }

    /// The cell named by a text: `v3`, `e3`, `f3`, `c3`, in capitals or not, or a number alone for a cell of the
    /// dimension `default`.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// use lar_viewer::{CellData, CellRef};
    /// let data = CellData::new(ChainComplex::from_model(&cuboid_grid(&[2, 1]))?)?;
    /// assert_eq!(data.find("e6", 2), Ok(CellRef { dim: 1, index: 6 }));
    /// assert_eq!(data.find("2", 2), Err("there is no f2; there are 2 of that dimension".to_owned()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// What is wrong with the text, in words.
    pub fn find(&self, text: &str, default: u8) -> Result<CellRef, String> {
        let text = text.trim();
        let letter = text.chars().next().map(|c| c.to_ascii_lowercase());
        let dim = (0..).zip(['v', 'e', 'f', 'c']).find(|&(_, l)| Some(l) == letter).map(|(dim, _)| dim);
        let number = if dim.is_some() { text[1..].trim() } else { text };
        let Ok(index) = number.parse() else {
            return Err(format!("{text:?} names no cell; cells are v0, e0, f0, c0 and so on"));
        };
        let cell = CellRef { dim: dim.unwrap_or(default), index };
        let n = if cell.dim <= self.dim() { self.n_cells(cell.dim) } else { 0 };
        if self.contains(cell) {
            Ok(cell)
        } else {
            Err(format!("there is no {cell}; there are {n} of that dimension"))
        }
    }
}

#[cfg(test)]
mod tests;
