//! Curves, surfaces and solids as images of grids.
//!
//! Each shape is a struct of parameters with the usual defaults; `model()` builds it. Curves are complexes of
//! edges, surfaces are oriented triangles (cyclic faces of a [`Model`]), solids are complexes of cuboids with
//! all their skeletons. All go straight into [`Model::to_surface`], [`Model::to_triangle_mesh`] or
//! [`ChainComplex::from_model`](crate::ChainComplex::from_model); those in the plane after
//! [`Model::embedded`].
//!
//! Where a parametrisation meets itself (the seam of a full turn, the poles of a sphere, the axis of a ball),
//! the vertices of the *grid* are identified before any coordinate is computed, so closed shapes are closed
//! whatever the rounding, and no tolerance decides anything. A full turn is an angle of exactly
//! [`TAU`].
//!
//! For functions of one's own there are [`map`], which moves the vertices of a model and merges images that
//! are exactly equal, and [`GluedGrid`], which declares seams and poles as the shapes do.
//!
//! ```
//! use lar_core::mapper::{Ball, Sphere, Torus};
//! let sphere = Sphere { radius: 2., ..Sphere::default() }.model()?;
//! assert_eq!(sphere.cells(2).len(), 2 * 36 * 17);
//! assert!(sphere.to_triangle_mesh()?.is_closed());
//! assert_eq!(Ball::default().model()?.cells(3).len(), 18 * 36 * 4);
//! assert!(Torus::default().model()?.to_surface("torus")?.boundary_edges().is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod curves;
mod glued;
mod one_cell;
mod solids;
mod surfaces;

pub use curves::{Circle, Helix};
pub use glued::{GluedGrid, Side};
pub use one_cell::{Pizza, Rod};
pub use solids::{Ball, HollowBall, HollowCylinder, Torus, cuboid};
pub use surfaces::{Crown, Cylinder, Disk, Helicoid, Ring, Sphere, Toroidal};

use crate::{Model, ModelError, Points, VertexId};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Why a shape cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// A parameter is outside its range.
    #[error("{name} is {value}; it must be {range}")]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// A grid has too few divisions along an axis for its image to be a complex.
    #[error("{found} divisions along axis {axis}; at least {least} are needed")]
    Divisions {
        /// The axis, from 0.
        axis: usize,
        /// The divisions given.
        found: usize,
        /// The divisions needed.
        least: usize,
    },
    /// A grid has another number of axes than is needed.
    #[error("a grid of {found} axes where {expected} are needed")]
    Axes {
        /// The number of axes.
        found: usize,
        /// The number needed.
        expected: usize,
    },
    /// A seam or collapsed side names an axis that the grid does not have.
    #[error("axis {axis} of a grid of {axes} axes")]
    NoSuchAxis {
        /// The axis, from 0.
        axis: usize,
        /// The number of axes.
        axes: usize,
    },
    /// A side of a grid is collapsed along the axis that it ends.
    #[error("a side that ends axis {axis} has no extent along axis {axis} to be collapsed")]
    CollapsedAlongItself {
        /// The axis, from 0.
        axis: usize,
    },
    /// Two corners of a cuboid are of different spaces.
    #[error("corners of {lowest} and of {highest} coordinates")]
    Corners {
        /// Coordinates of the lowest corner.
        lowest: usize,
        /// Coordinates of the highest corner.
        highest: usize,
    },
    /// A function's value is infinite or not a number.
    #[error("coordinate {axis} of the image of vertex {vertex} is {value}")]
    NonFinite {
        /// The vertex of the grid or model.
        vertex: VertexId,
        /// Which coordinate, from 0.
        axis: usize,
        /// Its value.
        value: f64,
    },
    /// The grid would have more vertices or cell entries than `u32` can number.
    #[error("a grid of shape {0:?} has 2^32 vertices, cells or entries of cells or more")]
    TooLarge(Vec<usize>),
    /// The model to be mapped is malformed.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// The image of a model under a function of its points. Vertices with exactly equal images are merged, cells
/// that become equal are kept once, and cells that lose dimension are dropped, as in [`Model::welded`]. The
/// order and so the orientation of the vertices of each cell is kept. O(n log n).
///
/// # Errors
/// When the model is malformed or a value of `f` is not finite.
///
/// ```
/// use lar_core::{cuboid_grid, mapper::map};
/// let saddle = map(&cuboid_grid(&[8, 8]), |p| [p[0], p[1], (p[0] - 4.) * (p[1] - 4.) / 8.])?;
/// assert_eq!((saddle.points().dim(), saddle.f_vector()), (3, vec![81, 144, 64]));
/// let cone = map(&cuboid_grid(&[1, 1]), |p| [p[0] * p[1], p[1]])?;
/// assert_eq!(cone.f_vector(), [3, 3, 1]);
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "larMap")]
pub fn map<const N: usize>(model: &Model, f: impl FnMut(&[f64]) -> [f64; N]) -> Result<Model, MapError> {
    model.check_well_formed()?;
    let points = Points::from_columns(N, model.points().iter().flat_map(f).collect());
    check_finite(&points)?;
    let cells = (0..model.f_vector().len()).map(|p| model.cells(p).clone()).collect();
    Ok(Model::new(points, cells).welded()?)
}

fn check_finite(points: &Points) -> Result<(), MapError> {
    let Some((i, axis, value)) = points.non_finite().next() else { return Ok(()) };
    Err(MapError::NonFinite { vertex: VertexId(u32::try_from(i).unwrap_or(u32::MAX)), axis, value })
}

fn positive(name: &'static str, value: f64) -> Result<f64, MapError> {
    let range = "positive and finite";
    if value > 0. && value.is_finite() { Ok(value) } else { Err(MapError::Parameter { name, value, range }) }
}

fn finite(name: &'static str, value: f64) -> Result<f64, MapError> {
    if value.is_finite() { Ok(value) } else { Err(MapError::Parameter { name, value, range: "finite" }) }
}

/// An angle of at most a full turn.
fn turn(name: &'static str, value: f64) -> Result<f64, MapError> {
    let range = "above 0 and at most 2π";
    if value > 0. && value <= TAU { Ok(value) } else { Err(MapError::Parameter { name, value, range }) }
}

/// An angle of at most half a turn.
fn half_turn(name: &'static str, value: f64) -> Result<f64, MapError> {
    let range = "above 0 and at most π";
    if value > 0. && value <= PI { Ok(value) } else { Err(MapError::Parameter { name, value, range }) }
}

/// An inner radius.
fn inner(name: &'static str, value: f64, outer: f64) -> Result<f64, MapError> {
    let range = "positive and less than the outer radius";
    if value > 0. && value < outer { Ok(value) } else { Err(MapError::Parameter { name, value, range }) }
}

/// The point at angle `a` on the circle of radius `r`; exact on the axes.
fn polar(r: f64, a: f64) -> [f64; 2] {
    let quarters = a / FRAC_PI_2;
    if quarters.fract() != 0. {
        return [r * a.cos(), r * a.sin()];
    }
    match quarters.rem_euclid(4.) {
        0. => [r, 0.],
        1. => [0., r],
        2. => [-r, 0.],
        _ => [0., -r],
    }
}
