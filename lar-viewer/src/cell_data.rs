//! What is known of the cells on show: boundaries and coboundaries, measures, centroids, the solids they come from.
//!
//! All of it is asked of the chain complex once, so that walking from cell to cell is a look-up.

use crate::scene::{finite, point3};
use crate::{CellRef, ViewerError};
use lar_core::{Chain, ChainComplex, ChainError, Operator};

/// Length, area or volume of a cell, and its centre of mass where it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// Number of dimensions of the cell; 1 for a vertex, else its length, area or volume.
    pub size: f64,
    /// Centre of mass; `None` for a cell without size.
    pub centroid: Option<[f64; 3]>,
}

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

    /// With triangles of the faces over the vertices of the complex: face f has `triangles[offsets[f]..offsets[f + 1]]`.
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

    /// Measure and centroid of a cell; `None` when there is no such cell.
    #[must_use]
    pub fn measures(&self, cell: CellRef) -> Option<Measures> {
        self.measures.get(usize::from(cell.dim))?.get(cell.index as usize).copied()
    }

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

    /// The cells in no other cell's boundary: those of the highest dimension, and what hangs alone in space. Highest
    /// dimension first, then by number.
    #[must_use]
    pub fn units(&self) -> Vec<CellRef> {
        let dims = (0..=self.dim()).rev();
        let cells =
            dims.flat_map(|dim| (0..self.n_cells(dim) as u32).map(move |index| CellRef { dim, index }));
        cells.filter(|&c| self.above(c).is_empty()).collect()
    }

    /// The units that have a cell in their boundaries, or the cell itself when it is one.
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

    /// The cells of the next dimension with this one in their boundaries.
    fn above(&self, cell: CellRef) -> Vec<u32> {
        let row = self.rows.get(usize::from(cell.dim)).and_then(|rows| rows.outer_view(cell.index as usize));
        row.map_or_else(Vec::new, |row| row.indices().to_vec())
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
mod tests {
    use super::*;
    use lar_core::{Points, cuboid_grid};
    use proptest::prelude::*;

    fn grid() -> CellData {
        let grid = ChainComplex::from_model(&cuboid_grid(&[2, 2, 1])).unwrap();
        CellData::new(grid.with_exterior().unwrap()).unwrap().with_exterior()
    }

    fn cell(dim: u8, index: u32) -> CellRef {
        CellRef { dim, index }
    }

    #[test]
    fn measures_and_exterior() {
        let data = grid();
        let exterior = data.measures(cell(3, 0)).unwrap().size;
        assert!((exterior - 4.0).abs() < 1e-12, "the exterior, counted positive: {exterior}");
        let first = data.measures(cell(3, 1)).unwrap();
        assert!((first.size - 1.0).abs() < 1e-12, "{first:?}");
        assert!(first.centroid.unwrap().iter().all(|x| (x - 0.5).abs() < 1e-12), "{first:?}");
        assert_eq!(data.measures(cell(3, 5)), None);
        assert!(
            data.is_exterior(cell(3, 0)) && !data.is_exterior(cell(2, 0)) && !data.is_exterior(cell(3, 1))
        );
    }

    #[test]
    fn a_face_lies_between_two_cells_and_four_edges() {
        let data = grid();
        for f in 0..data.n_cells(2) as u32 {
            let up = data.coboundary(cell(2, f)).unwrap();
            let signs: Vec<i32> = up.entries().iter().map(|e| e.1).collect();
            assert_eq!((signs.len(), signs.iter().sum::<i32>()), (2, 0), "face {f}");
            assert_eq!(data.boundary(cell(2, f)).unwrap().entries().len(), 4);
        }
        assert!(data.coboundary(cell(3, 0)).unwrap().is_zero());
        assert!(data.boundary(cell(0, 0)).unwrap().is_zero());
        assert_eq!(data.boundary(cell(2, 99)), None);
    }

    proptest! {
        #[test]
        fn coboundaries_are_those_of_the_complex(terms in prop::collection::vec((0..33_u32, -3..4), 0..9), dim in 0..4_usize) {
            let data = grid();
            let n = data.complex().n_cells(dim) as u32;
            let chain = data.complex().chain(dim, terms.into_iter().map(|(c, x)| (c % n, x))).unwrap();
            let up = data.coboundary_of(&chain).unwrap();
            prop_assert_eq!(&up, &data.complex().coboundary_of(&chain).unwrap());
            prop_assert!(data.coboundary_of(&up).unwrap().is_zero());
        }
    }

    #[test]
    fn closures_hold_all_faces() {
        let closure = grid().closure([cell(3, 1)]);
        assert_eq!(closure.iter().map(Vec::len).collect::<Vec<_>>(), [8, 12, 6, 1]);
        let mixed = grid().closure([cell(1, 0), cell(0, 17), cell(3, 77)]);
        assert_eq!(mixed.iter().map(Vec::len).collect::<Vec<_>>(), [3, 1, 0, 0]);
    }

    #[test]
    fn units_are_cells_in_no_boundary() {
        let data = grid();
        assert_eq!(data.units(), (0..5).map(|i| cell(3, i)).collect::<Vec<_>>());
        assert_eq!(data.units_of(cell(3, 2)), [cell(3, 2)]);
        assert_eq!(
            data.units_of(cell(0, 0)),
            [cell(3, 0), cell(3, 1)],
            "a corner: the exterior and one cell"
        );
        assert_eq!(data.units_of(cell(0, 99)), []);
        assert_eq!((data.cells_above(cell(0, 0), 2).len(), data.cells_above(cell(2, 5), 2)), (3, vec![5]));
        // A triangle without ∂2: three lone edges.
        let edges = lar_core::Cells::uniform(2, vec![0, 1, 1, 2, 0, 2]);
        let d1 = ChainComplex::operator_from_columns(3, edges, vec![-1, 1, -1, 1, -1, 1]);
        let points = Points::from_xyz(&[[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
        let outline = CellData::new(ChainComplex::new(points, vec![d1])).unwrap();
        assert_eq!(outline.units(), [cell(1, 0), cell(1, 1), cell(1, 2)]);
        assert_eq!(outline.segment(1), Some([[3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]));
        assert_eq!(outline.middle(cell(1, 2)), [0.0, 2.0, 0.0]);
    }

    #[test]
    fn triangles_belong_to_faces() {
        let data = grid().with_triangles(vec![[0, 1, 2], [1, 2, 3], [4, 5, 6]], vec![0, 2, 3]).unwrap();
        assert_eq!(data.triangles(0), [[0, 1, 2], [1, 2, 3]]);
        assert_eq!(data.triangles(1), [[4, 5, 6]]);
        assert!(data.triangles(2).is_empty());
        let error = grid().with_triangles(vec![[0, 1, 18]], vec![0, 1]).unwrap_err().to_string();
        assert_eq!(error, "drawable \"complex\": triangle 0 names point 18, but there are 18 points");
    }

    #[test]
    fn provenance_without_dangling_solids() {
        let provenance = Provenance {
            solids: vec!["A".into()],
            parents_of_face: vec![vec![
                FaceParent { solid: 0, face: 3, sign: -1 },
                FaceParent { solid: 1, face: 0, sign: 1 },
            ]],
            solids_of_cell: vec![vec![], vec![0], vec![0, 1]],
        };
        let data = grid().with_provenance(provenance);
        assert_eq!(data.cells_of_solid(0), [cell(3, 1), cell(3, 2)]);
        assert_eq!(data.solids_of(cell(3, 2)), [0]);
        assert_eq!(data.parents(cell(2, 0)), [FaceParent { solid: 0, face: 3, sign: -1 }]);
        assert_eq!((data.parents(cell(3, 0)), data.solids_of(cell(2, 1))), (&[][..], &[][..]));
    }

    #[track_caller]
    fn check_find(text: &str, expected: Result<CellRef, &str>) {
        assert_eq!(grid().find(text, 3).map_err(|e| e.to_string()), expected.map_err(str::to_owned));
    }

    #[test]
    fn cells_by_name() {
        check_find("v17", Ok(cell(0, 17)));
        check_find(" F 3 ", Ok(cell(2, 3)));
        check_find("2", Ok(cell(3, 2)));
        check_find("c5", Err("there is no c5; there are 5 of that dimension"));
        check_find("", Err("\"\" names no cell; cells are v0, e0, f0, c0 and so on"));
        check_find("é1", Err("\"é1\" names no cell; cells are v0, e0, f0, c0 and so on"));
        check_find("f-1", Err("\"f-1\" names no cell; cells are v0, e0, f0, c0 and so on"));
    }

    #[test]
    fn vertices_that_are_not_numbers_are_named() {
        let points = Points::from_xyz(&[[0.0; 3], [0.0, f64::NAN, 0.0]]);
        let error = CellData::new(ChainComplex::new(points, vec![])).unwrap_err().to_string();
        assert_eq!(error, "drawable \"complex\": coordinate y of vertex 1 is NaN; it must lie within ±1e100");
        let edges = lar_core::Cells::uniform(2, vec![0, 5]);
        let open = ChainComplex::operator_from_columns(6, edges, vec![-1, 1]);
        let error = CellData::new(ChainComplex::new(Points::from_xyz(&[[0.0; 3]]), vec![open])).unwrap_err();
        assert!(error.to_string().starts_with("not a chain complex: "), "{error}");
    }
}
