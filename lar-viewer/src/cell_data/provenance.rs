//! Where cells come from: input solids and their faces.

use super::CellData;
use crate::CellRef;

/// A face of an input surface that a face of the complex is a piece of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaceParent {
    /// Index among the solids.
    pub solid: u32,
    /// Face of that solid's surface.
    pub face: u32,
    /// +1 or −1: the same orientation or the opposite one.
    pub sign: i8,
}

/// Where the cells come from, as plain arrays: which input solids there are, what faces are pieces of, and which solids
/// contain which cells of the highest dimension.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Names of the solids.
    pub solids: Vec<String>,
    /// For each face the input faces that it is a piece of; empty when not known.
    pub parents_of_face: Vec<Vec<FaceParent>>,
    /// For each cell of the highest dimension the solids that it is inside of, in rising order; empty when not known.
    pub solids_of_cell: Vec<Vec<u32>>,
}

impl CellData {
    /// With this knowledge of where the cells come from. Solids that do not exist are left out.
    #[must_use]
    pub fn with_provenance(mut self, mut provenance: Provenance) -> Self {
        let n_solids = provenance.solids.len();
        let exists = |solid: u32| (solid as usize) < n_solids;
        provenance.parents_of_face.iter_mut().for_each(|parents| parents.retain(|p| exists(p.solid)));
        provenance.solids_of_cell.iter_mut().for_each(|solids| solids.retain(|&s| exists(s)));
        self.provenance = provenance;
        self
    }

    /// Names of the solids.
    #[must_use]
    pub fn solids(&self) -> &[String] {
        &self.provenance.solids
    }

    /// The input faces that a cell is a piece of; none when it is no face.
    #[must_use]
    pub fn parents(&self, cell: CellRef) -> &[FaceParent] {
        let found = self.provenance.parents_of_face.get(cell.index as usize);
        found.filter(|_| cell.dim == 2).map_or(&[], Vec::as_slice)
    }

    /// The solids that a cell of the highest dimension is inside of.
    #[must_use]
    pub fn solids_of(&self, cell: CellRef) -> &[u32] {
        let found = self.provenance.solids_of_cell.get(cell.index as usize);
        found.filter(|_| cell.dim == self.dim()).map_or(&[], Vec::as_slice)
    }

    /// The cells of the highest dimension inside a solid.
    #[must_use]
    pub fn cells_of_solid(&self, solid: u32) -> Vec<CellRef> {
        let inside = (0..).zip(&self.provenance.solids_of_cell).filter(|(_, solids)| solids.contains(&solid));
        inside.map(|(index, _)| CellRef { dim: self.dim(), index }).filter(|&c| self.contains(c)).collect()
    }
}
