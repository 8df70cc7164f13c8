//! Simplicial complexes by extrusion: prisms over simplices cut into simplices, grids of simplices.
//!
//! A d-simplex (v0 … vd) lifted by one step spans a prism over its old vertices v and its new ones w. The
//! sequence v0 … vd w0 … wd read through a window of d + 2 vertices, one place further each time, gives as many
//! simplices as the base has vertices. They fill the prism without a vertex of their own and agree on the walls
//! between prisms, because each wall is cut by the same rule.
//!
//! Source: DiCarlo, Paoluzzi, Shapiro, CAD 46 (2014); Paoluzzi, Bernardini, Cattani, Ferrucci,
//! "Dimension-independent modeling with simplicial complexes", ACM TOG 12(1) (1993).

use crate::simplex_facets::simplex_facets;
use crate::{Cells, Model, ModelError, Points, VertexId};

/// Why simplices cannot be built from what was given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimplexError {
    /// A model to be extruded is malformed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A cell has not the number of vertices that its kind or the first cell calls for.
    #[error("cell {cell} has {found} vertices, not {expected}")]
    Size {
        /// Position of the cell.
        cell: usize,
        /// The number of its vertices.
        found: usize,
        /// The number needed.
        expected: usize,
    },
    /// A simplex names a vertex twice.
    #[error("cell {cell} names vertex {vertex} more than once")]
    RepeatedVertex {
        /// Position of the cell.
        cell: usize,
        /// The vertex.
        vertex: VertexId,
    },
    /// A cell names a vertex that does not exist.
    #[error("cell {cell} names vertex {vertex}, but there are {n_vertices} vertices")]
    VertexOutOfRange {
        /// Position of the cell.
        cell: usize,
        /// The vertex it names.
        vertex: VertexId,
        /// The number of vertices.
        n_vertices: usize,
    },
    /// A step of a pattern is zero, infinite or not a number, or the steps up to it add up to infinity.
    #[error("step {index} is {value}: steps are finite, not zero, and have a finite sum")]
    Step {
        /// Position in the pattern, from 0.
        index: usize,
        /// The step.
        value: f64,
    },
    /// The simplices have no coherent orientation: going round through shared facets turns one over.
    #[error("no coherent orientation: cells {} and {} disagree across a facet", .cells[0], .cells[1])]
    NotOrientable {
        /// Two simplices that share a facet and cannot agree across it.
        cells: [usize; 2],
    },
    /// `u32` cannot number the vertices and cell entries.
    #[error("{size} vertices or cell entries; fewer than 2^32 can be numbered")]
    TooLarge {
        /// The number of vertices or entries, saturated.
        size: u64,
    },
}

/// The complex of the given d-simplices with all their faces: `cells(d)` are the simplices as given,
/// `cells(p)` for 0 < p < d their p-faces in lexicographic order, `cells(0)` all points. O(n log n) in the
/// number of faces.
///
/// # Errors
/// When the simplices are not all of one size, name a vertex twice or one that does not exist, or `u32` cannot
/// number their faces.
///
/// ```
/// use lar_core::{Cells, Points, simplicial_complex};
/// let points = Points::from_columns(2, vec![0., 0., 1., 0., 0., 1., 1., 1.]);
/// let square = simplicial_complex(points, Cells::uniform(3, vec![0, 1, 2, 1, 2, 3]))?;
/// assert_eq!(square.f_vector(), [4, 5, 2]);
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
pub fn simplicial_complex(points: Points, simplices: Cells) -> Result<Model, SimplexError> {
    let n_vertices = points.len();
    for (cell, vertices) in simplices.iter().enumerate() {
        if let Some(&v) = vertices.iter().find(|&&v| v as usize >= n_vertices) {
            return Err(SimplexError::VertexOutOfRange { cell, vertex: VertexId(v), n_vertices });
        }
    }
    let size = simplex_size(&simplices)?;
    with_skeletons(points, simplices, size)
}

/// The complex of well-formed simplices of `size` vertices with all its skeletons.
fn with_skeletons(points: Points, simplices: Cells, size: usize) -> Result<Model, SimplexError> {
    let vertices = Cells::singletons(points.len());
    if size <= 1 {
        return Ok(Model::new(points, vec![vertices]));
    }
    let mut cells = vec![simplices];
    for _ in 2..size {
        cells.push(simplex_facets(&cells[cells.len() - 1])?);
    }
    cells.push(vertices);
    cells.reverse();
    Ok(Model::new(points, cells))
}

/// The number of vertices that all simplices have, 0 when there are none.
pub(crate) fn simplex_size(simplices: &Cells) -> Result<usize, SimplexError> {
    let Some(expected) = simplices.get(0).map(<[u32]>::len) else { return Ok(0) };
    let mut sorted = Vec::new();
    for (cell, vertices) in simplices.iter().enumerate() {
        let found = vertices.len();
        if found != expected {
            return Err(SimplexError::Size { cell, found, expected });
        }
        sorted.clear();
        sorted.extend_from_slice(vertices);
        sorted.sort_unstable();
        if let Some(w) = sorted.windows(2).find(|w| w[0] == w[1]) {
            return Err(SimplexError::RepeatedVertex { cell, vertex: VertexId(w[0]) });
        }
    }
    Ok(expected)
}

/// A simplicial d-complex in n-space extruded along a new last coordinate: a (d + 1)-complex in (n +
/// 1)-space.
///
/// The steps of `pattern` are heights of consecutive layers, from coordinate 0; a layer of negative step is
/// left empty. Vertex v of level k is v + k · |V|. The simplices come layer after layer, inside a layer prism
/// after prism in the order of the cells of `base`, d + 1 to a prism; `cells(p)` for p ≤ d are their faces,
/// `cells(0)` all points. O(n log n) in the number of faces of the result.
///
/// # Errors
/// When `base` is malformed or its highest cells are no simplices, a step is zero or not finite, or `u32`
/// cannot number the result.
///
/// ```
/// use lar_core::{extrude_simplicial, simplex};
/// let prism = extrude_simplicial(&simplex(2), &[1.])?;
/// assert_eq!(prism.cells(3).indices(), [0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5]);
/// let two_layers = extrude_simplicial(&simplex(2), &[1., -2., 0.5])?;
/// assert_eq!((two_layers.points().len(), two_layers.cells(3).len()), (12, 6));
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
#[doc(alias = "extrudeSimplicial")]
#[doc(alias = "larExtrude1")]
pub fn extrude_simplicial(base: &Model, pattern: &[f64]) -> Result<Model, SimplexError> {
    base.check_well_formed()?;
    let levels = levels(pattern)?;
    let simplices = base.cells(base.dim());
    let size = base.dim() + 1;
    if let Some((cell, found)) = simplices.iter().map(<[u32]>::len).enumerate().find(|c| c.1 != size) {
        return Err(SimplexError::Size { cell, found, expected: size });
    }
    let n_layers = pattern.iter().filter(|&&step| step > 0.).count();
    check_size(base.points().len() as u128 * levels.len() as u128)?;
    check_size((simplices.len() * n_layers) as u128 * (size * (size + 1)) as u128)?;
    let mut cells = Cells::with_capacity(
        simplices.len() * n_layers * size,
        simplices.len() * n_layers * size * (size + 1),
    );
    let n = u32::try_from(base.points().len()).expect("checked above");
    for (level, _) in (0_u32..).zip(pattern).filter(|layer| *layer.1 > 0.) {
        for simplex in simplices.iter() {
            push_prism(simplex, level * n, n, &mut cells);
        }
    }
    with_skeletons(stacked(base.points(), &levels), cells, size + 1)
}

/// 0 and the sums of the first steps, without their signs.
fn levels(pattern: &[f64]) -> Result<Vec<f64>, SimplexError> {
    let mut at = 0.;
    let mut levels = vec![at];
    for (index, &value) in pattern.iter().enumerate() {
        at += f64::abs(value);
        if value == 0. || !at.is_finite() {
            return Err(SimplexError::Step { index, value });
        }
        levels.push(at);
    }
    Ok(levels)
}

/// The simplices of the prism over `simplex` between the levels whose vertices are raised by `bottom` and by
/// `bottom + n`.
fn push_prism(simplex: &[u32], bottom: u32, n: u32, cells: &mut Cells) {
    let tube: Vec<u32> =
        [bottom, bottom + n].iter().flat_map(|&raise| simplex.iter().map(move |&v| v + raise)).collect();
    for window in tube.windows(simplex.len() + 1) {
        cells.push(window);
    }
}

/// The points once at each level, their new last coordinate.
fn stacked(points: &Points, levels: &[f64]) -> Points {
    let mut coords = Vec::with_capacity((points.dim() + 1) * points.len() * levels.len());
    for &z in levels {
        for p in points.iter() {
            coords.extend_from_slice(p);
            coords.push(z);
        }
    }
    Points::from_columns(points.dim() + 1, coords)
}

/// The grid of `shape[0] × … × shape[d − 1]` unit cubes, each cut into d! simplices, with all its skeletons.
///
/// Vertices are numbered with the *first* coordinate fastest, as extrusion gives them. Without axes there are
/// no cells; with an axis of length 0 there are vertices only. O(n log n) in the number of faces.
///
/// # Errors
/// When `u32` cannot number the vertices and cell entries.
///
/// ```
/// let square = lar_core::simplex_grid(&[1, 1])?;
/// assert_eq!(square.cells(2).indices(), [0, 1, 2, 1, 2, 3]);
/// let cube = lar_core::simplex_grid(&[1, 1, 1])?;
/// assert_eq!(cube.f_vector(), [8, 19, 18, 6]);
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
#[doc(alias = "simplexGrid")]
#[doc(alias = "larSimplexGrid1")]
pub fn simplex_grid(shape: &[usize]) -> Result<Model, SimplexError> {
    let (mut vertices, mut simplices) = (1_u128, 1_u128);
    for (d, &k) in (1_u128..).zip(shape) {
        vertices = vertices.saturating_mul(k as u128 + 1);
        simplices = simplices.saturating_mul(d * k as u128);
        check_size(vertices.max(simplices.saturating_mul(d + 1)))?;
    }
    let Some((&first, others)) = shape.split_first() else { return Ok(crate::cuboid_grid(&[])) };
    let line = crate::cuboid_grid(&[first]);
    let (mut points, mut simplices) = (line.points().clone(), line.cells(1).clone());
    for &steps in others {
        let n = u32::try_from(points.len()).expect("checked above");
        let mut cells = Cells::new();
        for (level, _) in (0_u32..).zip(0..steps) {
            for simplex in simplices.iter() {
                push_prism(simplex, level * n, n, &mut cells);
            }
        }
        points = stacked(&points, &levels(&vec![1.; steps])?);
        simplices = cells;
    }
    with_skeletons(points, simplices, shape.len() + 1)
}

/// Each quadrilateral, its vertices in grid order (v00, v01, v10, v11), cut into the triangles v00 v10 v01
/// and v01 v10 v11: counter-clockwise where the first axis turns counter-clockwise into the second. O(n).
///
/// # Errors
/// When a cell has not four vertices.
///
/// ```
/// use lar_core::{cuboid_grid, quads_to_triangles};
/// let triangles = quads_to_triangles(cuboid_grid(&[1, 1]).cells(2))?;
/// assert_eq!(triangles.indices(), [0, 2, 1, 1, 2, 3]);
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
#[doc(alias = "quads2triangles")]
pub fn quads_to_triangles(quads: &Cells) -> Result<Cells, SimplexError> {
    let mut triangles = Vec::with_capacity(6 * quads.len());
    for (cell, quad) in quads.iter().enumerate() {
        let &[v00, v01, v10, v11] = quad else {
            return Err(SimplexError::Size { cell, found: quad.len(), expected: 4 });
        };
        triangles.extend([v00, v10, v01, v01, v10, v11]);
    }
    check_size(triangles.len() as u128)?;
    Ok(Cells::uniform(3, triangles))
}

fn check_size(size: u128) -> Result<(), SimplexError> {
    let size = u64::try_from(size).unwrap_or(u64::MAX);
    if size <= u64::from(u32::MAX) { Ok(()) } else { Err(SimplexError::TooLarge { size }) }
}
