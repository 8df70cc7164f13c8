//! Grids with seams and collapsed sides, identified by index.

use super::{MapError, check_finite};
use crate::merge::{merged, renumbered};
use crate::multi_index::for_each_row_major;
use crate::topology::DisjointSets;
use crate::{Cells, Model, Points, cuboid_grid};

/// One of the two sides of a grid that end an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Where the axis has index 0.
    Low,
    /// Where the axis has its highest index.
    High,
}

/// A cuboidal grid of which some vertices are one: opposite sides glued to a seam, sides collapsed along an
/// axis.
///
/// Its image under a function of the parameters is a complex whose seams and poles are closed by
/// construction: the function is called once for each vertex of the glued grid, with the lowest of the
/// indices that are one.
///
/// ```
/// use lar_core::mapper::{GluedGrid, Side};
/// use std::f64::consts::TAU;
/// // A cone over a circle of 12 edges: the seam of the turn is glued, the top is one point.
/// let cone = GluedGrid::new(&[12, 1]).periodic(0).collapsed(1, Side::High, 0);
/// let roof = cone.triangles(|p| {
///     let radius = 1. - p[1];
///     [radius * (TAU * p[0]).cos(), radius * (TAU * p[0]).sin(), p[1]]
/// })?;
/// assert_eq!((roof.points().len(), roof.cells(2).len()), (13, 12));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GluedGrid {
    shape: Vec<usize>,
    periodic: Vec<usize>,
    collapses: Vec<Collapse>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Collapse {
    axis: usize,
    side: Side,
    along: usize,
}

impl GluedGrid {
    /// The grid of `shape[k]` divisions along axis k, nothing glued.
    #[must_use]
    pub fn new(shape: &[usize]) -> Self {
        Self { shape: shape.to_vec(), periodic: Vec::new(), collapses: Vec::new() }
    }

    /// The two sides that end `axis` glued to one; needs three divisions along it.
    #[must_use]
    pub fn periodic(mut self, axis: usize) -> Self {
        self.periodic.push(axis);
        self
    }

    /// The side that ends `axis` collapsed along axis `along`: vertices of that side that differ only in
    /// their index along `along` are one. Where both sides of an axis are collapsed it needs two divisions.
    #[must_use]
    pub fn collapsed(mut self, axis: usize, side: Side, along: usize) -> Self {
        self.collapses.push(Collapse { axis, side, along });
        self
    }

    fn periodic_if(self, condition: bool, axis: usize) -> Self {
        if condition { self.periodic(axis) } else { self }
    }

    /// [`periodic`](Self::periodic) for a full turn.
    pub(super) fn full_turn(self, axis: usize, angle: f64) -> Self {
        self.periodic_if(angle == std::f64::consts::TAU, axis)
    }

    /// Both sides of `axis` collapsed along `along` when `angle` is half a turn.
    pub(super) fn poles(self, axis: usize, along: usize, angle: f64) -> Self {
        if angle != std::f64::consts::PI {
            return self;
        }
        self.collapsed(axis, Side::Low, along).collapsed(axis, Side::High, along)
    }

    /// The image of the grid as a complex of cuboids with all its skeletons, in N-space. `f` takes the
    /// parameters of a vertex, index / divisions along each axis, from 0 to 1. Vertices are numbered in
    /// row-major order of their lowest index; cells that become equal are kept once, cells that lose
    /// dimension are dropped. O(n log n).
    ///
    /// # Errors
    /// When an axis has no or too few divisions or does not exist, `u32` cannot number the cells, or a value
    /// of `f` is not finite.
    ///
    /// ```
    /// use lar_core::mapper::GluedGrid;
    /// use std::f64::consts::TAU;
    /// let ring = GluedGrid::new(&[8, 1]).periodic(0);
    /// let ring = ring.cuboids(|p| [(1. + p[1]) * (TAU * p[0]).cos(), (1. + p[1]) * (TAU * p[0]).sin()])?;
    /// assert_eq!(ring.f_vector(), [16, 24, 8]);
    /// # Ok::<(), lar_core::mapper::MapError>(())
    /// ```
    pub fn cuboids<const N: usize>(&self, f: impl FnMut(&[f64]) -> [f64; N]) -> Result<Model, MapError> {
        self.check()?;
        let (new_from_old, points) = self.glued_points(f)?;
        let (_, cells) = cuboid_grid(&self.shape).into_parts();
        let cells: Vec<&Cells> = cells.iter().collect();
        Ok(Model::new(points, merged(&cells, &new_from_old)))
    }

    /// The image of a grid of two axes as oriented triangles in N-space, two a quadrilateral, those that lose
    /// a side dropped; `f` as in [`cuboids`](Self::cuboids). The triangles turn from the first axis to the
    /// second: their normals point along ∂f/∂u × ∂f/∂v. O(n).
    ///
    /// # Errors
    /// As [`cuboids`](Self::cuboids), and when there are not two axes.
    ///
    /// ```
    /// use lar_core::mapper::GluedGrid;
    /// let square = GluedGrid::new(&[1, 1]).triangles(|p| [p[0], p[1]])?;
    /// assert_eq!(square.cells(2).indices(), [0, 2, 1, 2, 3, 1]);
    /// # Ok::<(), lar_core::mapper::MapError>(())
    /// ```
    pub fn triangles<const N: usize>(&self, f: impl FnMut(&[f64]) -> [f64; N]) -> Result<Model, MapError> {
        let &[n_u, n_v] = &self.shape[..] else {
            return Err(MapError::Axes { found: self.shape.len(), expected: 2 });
        };
        self.check()?;
        let (new_from_old, points) = self.glued_points(f)?;
        let vertex = |u: usize, v: usize| new_from_old[u * (n_v + 1) + v];
        let mut triangles = Cells::with_capacity(2 * n_u * n_v, 6 * n_u * n_v);
        for_each_row_major(&[n_u, n_v], |at| {
            let (u, v) = (at[0], at[1]);
            let [a, b, c, d] = [vertex(u, v), vertex(u + 1, v), vertex(u, v + 1), vertex(u + 1, v + 1)];
            for [p, q, r] in [[a, b, c], [b, d, c]] {
                if p != q && q != r && r != p {
                    triangles.push(&[p, q, r]);
                }
            }
        });
        Ok(Model::from_faces(points, triangles))
    }

    /// The new number of each vertex of the grid in row-major order, and the images of the glued vertices.
    fn glued_points<const N: usize>(
        &self,
        mut f: impl FnMut(&[f64]) -> [f64; N],
    ) -> Result<(Vec<u32>, Points), MapError> {
        let counts: Vec<usize> = self.shape.iter().map(|n| n + 1).collect();
        let representative = self.representatives(&counts);
        let (new_from_old, _) = renumbered(&representative);
        let mut coords = Vec::new();
        let (mut old, mut parameters) = (0_u32, vec![0.; counts.len()]);
        for_each_row_major(&counts, |at| {
            if representative[old as usize] == old {
                for ((p, &x), &n) in parameters.iter_mut().zip(at).zip(&self.shape) {
                    #[expect(clippy::cast_precision_loss, reason = "grid indices stay below 2^32")]
                    let parameter = x as f64 / n as f64;
                    *p = parameter;
                }
                coords.extend(f(&parameters));
            }
            old += 1;
        });
        let points = Points::from_columns(N, coords);
        check_finite(&points)?;
        Ok((new_from_old, points))
    }

    /// Per vertex the lowest of those that are one with it.
    fn representatives(&self, counts: &[usize]) -> Vec<u32> {
        let n = counts.iter().product();
        let address = |at: &[usize]| at.iter().zip(counts).fold(0, |address, (x, n)| address * n + x);
        let mut sets = DisjointSets::new(n);
        let mut image = counts.to_vec();
        let mut here = 0;
        for_each_row_major(counts, |at| {
            let seams = self.periodic.iter().filter(|&&axis| at[axis] == self.shape[axis]).copied();
            let collapses = self.collapses.iter().filter(|c| at[c.axis] == self.end(c.axis, c.side));
            for axis in seams.chain(collapses.map(|c| c.along)) {
                image.copy_from_slice(at);
                image[axis] = 0;
                sets.join(here, address(&image));
            }
            here += 1;
        });
        (0..n).map(|i| u32::try_from(sets.find(i)).expect("the size was checked")).collect()
    }

    fn end(&self, axis: usize, side: Side) -> usize {
        if side == Side::Low { 0 } else { self.shape[axis] }
    }

    fn check(&self) -> Result<(), MapError> {
        let axes = self.shape.len();
        let collapsed = self.collapses.iter().flat_map(|c| [c.axis, c.along]);
        if let Some(axis) = self.periodic.iter().copied().chain(collapsed).find(|&axis| axis >= axes) {
            return Err(MapError::NoSuchAxis { axis, axes });
        }
        if let Some(c) = self.collapses.iter().find(|c| c.axis == c.along) {
            return Err(MapError::CollapsedAlongItself { axis: c.axis });
        }
        for (axis, &found) in self.shape.iter().enumerate() {
            let ends = |side| self.collapses.iter().any(|c| (c.axis, c.side) == (axis, side));
            let least = match () {
                () if self.periodic.contains(&axis) => 3,
                () if ends(Side::Low) && ends(Side::High) => 2,
                () => 1,
            };
            if found < least {
                return Err(MapError::Divisions { axis, found, least });
            }
        }
        check_size(&self.shape)
    }
}

/// That the cells of each dimension have fewer than 2^32 entries: those of dimension p have as many as the
/// coefficient of x^p in Π (n + 1 + 2 n x).
pub(super) fn check_size(shape: &[usize]) -> Result<(), MapError> {
    if shape.len() >= 32 {
        return Err(MapError::TooLarge(shape.to_vec()));
    }
    let mut entries = vec![1_u128];
    for &n in shape {
        let (points, intervals) = (n as u128 + 1, 2 * n as u128);
        entries.push(0);
        for p in (0..entries.len()).rev() {
            let below = if p == 0 { 0 } else { entries[p - 1].saturating_mul(intervals) };
            entries[p] = entries[p].saturating_mul(points).saturating_add(below);
        }
    }
    let fits = entries.iter().all(|&n| n <= u128::from(u32::MAX));
    if fits { Ok(()) } else { Err(MapError::TooLarge(shape.to_vec())) }
}
