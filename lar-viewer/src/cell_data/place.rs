//! Where cells lie.

use super::CellData;
use crate::CellRef;
use crate::scene::point3;

impl CellData {
    /// Where a vertex lies; `None` when there is no such vertex.
    #[must_use]
    pub fn position(&self, vertex: u32) -> Option<[f64; 3]> {
        let exists = (vertex as usize) < self.n_cells(0);
        exists.then(|| point3(self.complex.points(), vertex as usize))
    }

    /// The ends of an edge, tail first; `None` when there is no such edge or it has not one of each.
    #[must_use]
    pub fn segment(&self, edge: u32) -> Option<[[f64; 3]; 2]> {
        let exists = 1 <= self.dim() && (edge as usize) < self.n_cells(1);
        let [a, b] = exists.then(|| self.complex.edge_ends(edge as usize)).flatten()?;
        Some([self.position(a)?, self.position(b)?])
    }

    /// The centroid of a cell, or the mean of its vertices where it has none; the origin when there is no such cell.
    #[must_use]
    pub fn middle(&self, cell: CellRef) -> [f64; 3] {
        if let Some(centroid) = self.measures(cell).and_then(|m| m.centroid) {
            return centroid;
        }
        let vertices = self.closure([cell]).swap_remove(0);
        let n = vertices.len().max(1) as f64;
        let positions = vertices.iter().filter_map(|&v| self.position(v));
        positions.fold([0.0; 3], |sum, p| std::array::from_fn(|k| sum[k] + p[k] / n))
    }
}
