//! Cells: lists of indices of varying length in two flat arrays.

/// A list of cells, each a list of `u32` indices (of vertices, unless said otherwise), stored as one array of
/// offsets and one of indices.
///
/// ```
/// use lar_core::Cells;
/// let mut cells = Cells::new();
/// cells.push(&[0, 1, 2]);
/// cells.push(&[2, 1, 3, 4]);
/// assert_eq!(cells.len(), 2);
/// assert_eq!(&cells[1], [2, 1, 3, 4]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cells {
    offsets: Vec<u32>,
    indices: Vec<u32>,
}

impl Cells {
    /// No cells.
    #[must_use]
    pub fn new() -> Self {
        Self { offsets: vec![0], indices: Vec::new() }
    }

    /// No cells, with room for `cells` of them with `indices` entries in all.
    #[must_use]
    pub fn with_capacity(cells: usize, indices: usize) -> Self {
        let mut offsets = Vec::with_capacity(cells + 1);
        offsets.push(0);
        Self { offsets, indices: Vec::with_capacity(indices) }
    }

    /// Cells from the two flat arrays: cell `i` is `indices[offsets[i]..offsets[i + 1]]`. O(cells).
    ///
    /// # Panics
    /// When `offsets` does not rise from 0 to `indices.len()`.
    #[must_use]
    pub fn from_parts(offsets: Vec<u32>, indices: Vec<u32>) -> Self {
        // Without a branch for each: nearly always all are looked at.
        let rises =
            || offsets.iter().zip(&offsets[1..]).fold(0, |falls, (a, b)| falls | u32::from(a > b)) == 0;
        assert!(
            offsets.first() == Some(&0)
                && offsets.last().is_some_and(|&end| end as usize == indices.len())
                && rises(),
            "offsets must rise from 0 to {}",
            indices.len()
        );
        Self { offsets, indices }
    }

    /// Cells that all have `size` indices.
    ///
    /// # Panics
    /// When `indices.len()` is not a multiple of `size`, or `size` is 0.
    #[must_use]
    pub fn uniform(size: usize, indices: Vec<u32>) -> Self {
        assert!(indices.len().is_multiple_of(size), "{} indices do not make cells of {size}", indices.len());
        let offsets = (0..=indices.len()).step_by(size).map(offset).collect();
        Self { offsets, indices }
    }

    /// The cells {0}, {1}, …, {n − 1}: every vertex a 0-cell.
    ///
    /// # Panics
    /// When `n` does not fit `u32`.
    #[must_use]
    pub fn singletons(n: usize) -> Self {
        Self::uniform(1, (0..offset(n)).collect())
    }

    /// Number of cells.
    #[must_use]
    #[inline]
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// True when there are no cells.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The indices of cell `i`, or `None` when there is no such cell.
    #[must_use]
    #[inline]
    pub fn get(&self, i: usize) -> Option<&[u32]> {
        let end = *self.offsets.get(i + 1)?;
        Some(&self.indices[self.offsets[i] as usize..end as usize])
    }

    /// Appends a cell.
    ///
    /// # Panics
    /// When the cells would hold 2^32 indices or more.
    #[inline]
    pub fn push(&mut self, cell: &[u32]) {
        self.indices.extend_from_slice(cell);
        self.offsets.push(offset(self.indices.len()));
    }

    /// Appends all cells of another list. O(their size).
    ///
    /// ```
    /// use lar_core::Cells;
    /// let mut cells = Cells::uniform(2, vec![0, 1, 1, 2]);
    /// cells.append(&Cells::uniform(3, vec![0, 1, 2]));
    /// assert_eq!((cells.len(), &cells[2]), (3, &[0, 1, 2][..]));
    /// ```
    ///
    /// # Panics
    /// When the cells would hold 2^32 indices or more.
    pub fn append(&mut self, other: &Self) {
        let base = offset(self.indices.len());
        offset(self.indices.len() + other.indices.len());
        self.indices.extend_from_slice(&other.indices);
        self.offsets.extend(other.offsets[1..].iter().map(|end| base + end));
    }

    /// The cells one after the other.
    #[inline]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + DoubleEndedIterator + Clone + '_ {
        self.offsets.windows(2).map(|w| &self.indices[w[0] as usize..w[1] as usize])
    }

    /// The offsets: `len() + 1` numbers rising from 0.
    #[must_use]
    #[inline]
    pub fn offsets(&self) -> &[u32] {
        &self.offsets
    }

    /// Takes the two flat arrays out: offsets, indices.
    #[must_use]
    pub fn into_parts(self) -> (Vec<u32>, Vec<u32>) {
        (self.offsets, self.indices)
    }

    /// The indices of all cells, cell after cell.
    #[must_use]
    #[inline]
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }
}

#[inline]
fn offset(n: usize) -> u32 {
    u32::try_from(n).expect("cells hold fewer than 2^32 indices")
}

impl Default for Cells {
    fn default() -> Self {
        Self::new()
    }
}

impl std::ops::Index<usize> for Cells {
    type Output = [u32];

    #[inline]
    fn index(&self, i: usize) -> &[u32] {
        &self.indices[self.offsets[i] as usize..self.offsets[i + 1] as usize]
    }
}

impl<C: AsRef<[u32]>> FromIterator<C> for Cells {
    fn from_iter<I: IntoIterator<Item = C>>(cells: I) -> Self {
        let mut all = Self::new();
        for cell in cells {
            all.push(cell.as_ref());
        }
        all
    }
}
