//! What a planar arrangement is made of: segments, with or without regions that they bound.

use lar_core::{Cells, Model, Points};

/// Segments in the plane, crossing at will. Those of a *region* bound it: its inside lies on their left, or is
/// found by parity.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    pub(crate) points: Points,
    pub(crate) segments: Vec<[u32; 2]>,
    /// Names of the regions.
    pub(crate) regions: Vec<String>,
    /// The segments that are not loose, ascending, each with its region.
    pub(crate) outlines: Vec<(u32, u32)>,
}

impl Drawing {
    /// No segments over some points (2 × n).
    #[must_use]
    pub fn new(points: Points) -> Self {
        Self { points, segments: Vec::new(), regions: Vec::new(), outlines: Vec::new() }
    }

    /// Segments by their coordinates x1, y1, x2, y2.
    ///
    /// ```
    /// let cross = lar_arrangement::planar::Drawing::from_segments(&[[0., 0., 2., 2.], [0., 2., 2., 0.]]);
    /// assert_eq!(cross.n_segments(), 2);
    /// ```
    #[must_use]
    pub fn from_segments(segments: &[[f64; 4]]) -> Self {
        let mut out = Self::new(Points::from_columns(2, segments.as_flattened().to_vec()));
        out.segments = (0..segments.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        out
    }

    /// The edges of a two-dimensional model.
    #[must_use]
    pub fn from_model(model: &Model) -> Self {
        let mut out = Self::new(model.points().clone());
        for edge in model.cells(1).iter() {
            if let &[a, b] = edge {
                out.push_segment([a, b]);
            }
        }
        out
    }

    /// Adds a point; returns its number. (A drawing whose points have not two coordinates is refused when it is
    /// arranged; until then missing ones are left out and further ones are zero.)
    pub fn push_point(&mut self, point: [f64; 2]) -> u32 {
        let number = self.points.len() as u32;
        let mut coordinates = point.to_vec();
        coordinates.resize(self.points.dim(), 0.0);
        self.points.push(&coordinates);
        number
    }

    /// Adds a segment between two of the points.
    pub fn push_segment(&mut self, ends: [u32; 2]) {
        self.segments.push(ends);
    }

    /// Adds a region by its loops, each a cyclic list of points; returns its number. O(points of the loops).
    pub fn push_region<'a>(
        &mut self,
        name: impl Into<String>,
        loops: impl IntoIterator<Item = &'a [u32]>,
    ) -> usize {
        let region = self.regions.len() as u32;
        self.regions.push(name.into());
        for cycle in loops {
            for (i, &p) in cycle.iter().enumerate() {
                self.push_outline(region, [p, cycle[(i + 1) % cycle.len()]]);
            }
        }
        region as usize
    }

    /// Adds a segment to the outline of a region. Whether segments added in this way close it is found when the
    /// drawing is arranged with [`Dangling::Keep`](super::Dangling::Keep); without their dangling edges outlines may
    /// look closed.
    ///
    /// # Panics
    /// When there is no such region.
    pub fn push_region_segment(&mut self, region: usize, ends: [u32; 2]) {
        assert!(region < self.regions.len(), "region {region} of {}", self.regions.len());
        self.push_outline(region as u32, ends);
    }

    fn push_outline(&mut self, region: u32, ends: [u32; 2]) {
        self.outlines.push((self.segments.len() as u32, region));
        self.segments.push(ends);
    }

    /// Adds a region whose loops are lists of coordinates.
    pub fn push_polygon(&mut self, name: impl Into<String>, loops: &[Vec<[f64; 2]>]) -> usize {
        let mut cells = Cells::new();
        for cycle in loops {
            cells.push(&cycle.iter().map(|&p| self.push_point(p)).collect::<Vec<_>>());
        }
        self.push_region(name, cells.iter())
    }

    /// Number of segments.
    #[must_use]
    pub fn n_segments(&self) -> usize {
        self.segments.len()
    }

    /// Number of regions.
    #[must_use]
    pub fn n_regions(&self) -> usize {
        self.regions.len()
    }
}
