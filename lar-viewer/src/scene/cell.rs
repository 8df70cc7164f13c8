//! Which cell a drawable, or one of its triangles, segments or dots, shows.

/// A cell that is shown: its dimension and its index among the cells of that dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CellRef {
    /// 0 vertex, 1 edge, 2 face, 3 solid cell.
    pub dim: u8,
    /// Index among the cells of this dimension.
    pub index: u32,
}

impl CellRef {
    /// The cell of this dimension and index.
    ///
    /// ```
    /// let face = lar_viewer::CellRef::new(2, 7);
    /// assert_eq!(face.to_string(), "f7");
    /// ```
    #[must_use]
    pub fn new(dim: u8, index: u32) -> Self {
        Self { dim, index }
    }
}

impl std::fmt::Display for CellRef {
    /// `v3`, `e3`, `f3`, `c3`, as the cells of chain complexes are named.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let letter = ['v', 'e', 'f', 'c'].get(usize::from(self.dim)).copied().unwrap_or('x');
        write!(f, "{letter}{}", self.index)
    }
}
