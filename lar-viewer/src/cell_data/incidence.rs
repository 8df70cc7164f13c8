//! Which cells bound which: chains, closures, and the units that a complex is drawn in.

use super::CellData;
use crate::CellRef;
use lar_core::{Chain, ChainError};

impl CellData {
    /// The chain that is this cell alone; `None` when there is no such cell.
    #[must_use]
    pub fn chain(&self, cell: CellRef) -> Option<Chain> {
        self.complex.chain(usize::from(cell.dim), [(cell.index, 1)]).ok()
    }

    /// The boundary chain of a cell, empty for a vertex; `None` when there is no such cell.
    #[must_use]
    pub fn boundary(&self, cell: CellRef) -> Option<Chain> {
        self.complex.boundary_of(&self.chain(cell)?).ok()
    }

    /// The coboundary chain of a cell, empty in the highest dimension; `None` when there is no such cell. In
    /// proportion to the size of the answer.
    #[must_use]
    pub fn coboundary(&self, cell: CellRef) -> Option<Chain> {
        self.coboundary_of(&self.chain(cell)?).ok()
    }

    /// ∂ of a chain.
    ///
    /// # Errors
    /// When the chain is not of this complex or a coefficient overflows.
    pub fn boundary_of(&self, chain: &Chain) -> Result<Chain, ChainError> {
        self.complex.boundary_of(chain)
    }

    /// δ of a chain, in proportion to the size of the answer.
    ///
    /// # Errors
    /// When the chain is not of this complex or a coefficient overflows.
    pub fn coboundary_of(&self, chain: &Chain) -> Result<Chain, ChainError> {
        let above = chain.dim() + 1;
        let Some(rows) = self.rows.get(chain.dim()) else {
            return Chain::new(above, 0, []);
        };
        let terms = chain.entries().iter().flat_map(|&(cell, factor)| {
            let row = rows.outer_view(cell as usize);
            let row: Vec<(u32, i32)> = row
                .iter()
                .flat_map(|r| r.iter())
                .map(|(c, &sign)| (c as u32, factor * i32::from(sign)))
                .collect();
            row
        });
        Chain::new(above, self.complex.n_cells(above), terms)
    }

    /// The cells themselves and all cells of lower dimension in their boundaries, per dimension, in rising order.
    /// O(n log n) for n cells in it.
    #[must_use]
    pub fn closure(&self, cells: impl IntoIterator<Item = CellRef>) -> Vec<Vec<u32>> {
        let mut found: Vec<Vec<u32>> = vec![Vec::new(); usize::from(self.dim()) + 1];
        for cell in cells.into_iter().filter(|&c| self.contains(c)) {
            found[usize::from(cell.dim)].push(cell.index);
        }
        for p in (0..found.len()).rev() {
            found[p].sort_unstable();
            found[p].dedup();
            if 0 < p {
                let operator = self.complex.boundary(p);
                let columns = found[p].iter().filter_map(|&c| operator.outer_view(c as usize));
                let below: Vec<u32> = columns.flat_map(|column| column.indices().to_vec()).collect();
                found[p - 1].extend(below);
            }
        }
        found
    }

    /// The cells in no other cell's boundary: those of the highest dimension, and what hangs alone in space. Highest
    /// dimension first, then by number.
    #[must_use]
    pub fn units(&self) -> Vec<CellRef> {
        let dims = (0..=self.dim()).rev();
        let cells =
            dims.flat_map(|dim| (0..self.n_cells(dim) as u32).map(move |index| CellRef { dim, index }));
        cells.filter(|&c| self.is_unit(c)).collect()
    }

    /// Whether a cell is in no other cell's boundary. O(1).
    pub(crate) fn is_unit(&self, cell: CellRef) -> bool {
        let rows = self.rows.get(usize::from(cell.dim));
        rows.is_none_or(|rows| rows.outer_view(cell.index as usize).is_none_or(|row| row.nnz() == 0))
    }

    /// The units that have a cell in their boundaries, or the cell itself when it is one.
    /// O(n log n) for n cells above it.
    #[must_use]
    pub fn units_of(&self, cell: CellRef) -> Vec<CellRef> {
        let mut found = Vec::new();
        let mut level = vec![cell.index];
        for dim in cell.dim..=self.dim() {
            let mut next = Vec::new();
            for index in std::mem::take(&mut level) {
                let above = self.above(CellRef { dim, index });
                if above.is_empty() {
                    found.push(CellRef { dim, index });
                }
                next.extend(above);
            }
            next.sort_unstable();
            next.dedup();
            level = next;
        }
        found.retain(|&c| self.contains(c));
        found
    }

    /// The cells of dimension `dim` that have a cell in their boundaries, in rising order; the cell itself in its own.
    #[must_use]
    pub(crate) fn cells_above(&self, cell: CellRef, dim: u8) -> Vec<u32> {
        (cell.dim..dim).fold(vec![cell.index], |cells, dim| {
            let above = cells.into_iter().flat_map(|index| self.above(CellRef { dim, index }));
            let mut above: Vec<u32> = above.collect();
            above.sort_unstable();
            above.dedup();
            above
        })
    }

    /// The cells of the dimension below in the boundary of this one.
    pub(crate) fn below(&self, cell: CellRef) -> Vec<u32> {
        let column = match cell.dim {
            0 => None,
            dim if dim <= self.dim() => {
                self.complex.boundary(usize::from(dim)).outer_view(cell.index as usize)
            }
            _ => None,
        };
        column.map_or_else(Vec::new, |column| column.indices().to_vec())
    }

    /// The cells of the next dimension with this one in their boundaries.
    pub(crate) fn above(&self, cell: CellRef) -> Vec<u32> {
        let row = self.rows.get(usize::from(cell.dim)).and_then(|rows| rows.outer_view(cell.index as usize));
        row.map_or_else(Vec::new, |row| row.indices().to_vec())
    }
}
