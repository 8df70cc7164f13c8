//! Solids: complexes of cuboids with all their skeletons.

use super::surfaces::{between, on_torus, spherical};
use super::{GluedGrid, MapError, Side, half_turn, inner, polar, positive, turn};
use crate::{Model, Points, cuboid_grid};
use std::f64::consts::{PI, TAU};

/// The cuboid from the corner `lowest` to the corner `highest` in a space of any dimension, one d-cell with
/// all its faces. Cells are vertex sets, so that coordinates of `highest` may as well be below those of
/// `lowest`.
///
/// # Errors
/// When the corners are of different spaces, or a coordinate or an extent is not finite, or an extent is 0.
///
/// ```
/// let plank = lar_core::mapper::cuboid(&[0., 0., 0.], &[4., 0.5, 0.1])?;
/// assert_eq!(plank.f_vector(), [8, 12, 6, 1]);
/// assert_eq!(plank.points().point(7), [4., 0.5, 0.1]);
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
pub fn cuboid(lowest: &[f64], highest: &[f64]) -> Result<Model, MapError> {
    let d = lowest.len();
    if d != highest.len() {
        return Err(MapError::Corners { lowest: d, highest: highest.len() });
    }
    let extents = lowest.iter().zip(highest).map(|(a, b)| b - a);
    if let Some(value) = extents.into_iter().find(|extent| *extent == 0. || !extent.is_finite()) {
        return Err(MapError::Parameter { name: "extent", value, range: "finite and not 0" });
    }
    super::glued::check_size(&vec![1; d])?;
    let (points, cells) = cuboid_grid(&vec![1; d]).into_parts();
    let corner =
        |p: &[f64]| -> Vec<f64> { (0..d).map(|k| if p[k] == 0. { lowest[k] } else { highest[k] }).collect() };
    let coords = points.iter().flat_map(corner).collect();
    Ok(Model::new(Points::from_columns(d, coords), cells))
}

/// A solid ball about the origin, or the part of it at latitudes and longitudes from −angle/2 to angle/2. The
/// centre and the points of the axis are one vertex each; cells beside them are wedges and pyramids. Default:
/// radius 1, whole, 18 × 36 × 4.
///
/// ```
/// use lar_core::mapper::Ball;
/// let ball = Ball { shape: [6, 12, 2], ..Ball::default() }.model()?;
/// assert_eq!(ball.points().len(), 1 + 2 * (5 * 12 + 2));
/// assert_eq!(ball.boundary_cells()?.len(), 6 * 12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "ball")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Positive.
    pub radius: f64,
    /// Extent in latitude, above 0, at most π.
    pub angle1: f64,
    /// Extent in longitude, above 0, at most 2π.
    pub angle2: f64,
    /// Divisions of latitude, of longitude and of the radius.
    pub shape: [usize; 3],
}

impl Default for Ball {
    fn default() -> Self {
        Self { radius: 1., angle1: PI, angle2: TAU, shape: [18, 36, 4] }
    }
}

impl Ball {
    /// The cuboids, with all skeletons. O(size of the model).
    ///
    /// # Errors
    /// When a parameter is out of range; from pole to pole there must be two divisions, around three.
    pub fn model(&self) -> Result<Model, MapError> {
        let radius = positive("radius", self.radius)?;
        let (angle1, angle2) = (half_turn("angle1", self.angle1)?, turn("angle2", self.angle2)?);
        let grid = GluedGrid::new(&self.shape).full_turn(1, angle2).poles(0, 1, angle1);
        let grid = grid.collapsed(2, Side::Low, 0).collapsed(2, Side::Low, 1);
        grid.cuboids(|p| spherical(radius * p[2], angle1 * (p[0] - 0.5), angle2 * (p[1] - 0.5)))
    }
}

/// The solid between two spheres about the origin, or the part of it at latitudes and longitudes from
/// −angle/2 to angle/2. Default: radii 1 and 2, whole, 24 × 36 × 3.
///
/// ```
/// use lar_core::mapper::HollowBall;
/// let shell = HollowBall::default().model()?;
/// assert_eq!(shell.cells(3).len(), 24 * 36 * 3);
/// assert_eq!(shell.boundary_cells()?.len(), 2 * 24 * 36);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "hollowBall")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HollowBall {
    /// Inner radius, positive.
    pub r: f64,
    /// Outer radius, above `r`.
    pub outer: f64,
    /// Extent in latitude, above 0, at most π.
    pub angle1: f64,
    /// Extent in longitude, above 0, at most 2π.
    pub angle2: f64,
    /// Divisions of latitude, of longitude and of the thickness.
    pub shape: [usize; 3],
}

impl Default for HollowBall {
    fn default() -> Self {
        Self { r: 1., outer: 2., angle1: PI, angle2: TAU, shape: [24, 36, 3] }
    }
}

impl HollowBall {
    /// The cuboids, with all skeletons. O(size of the model).
    ///
    /// # Errors
    /// When a parameter is out of range; from pole to pole there must be two divisions, around three.
    pub fn model(&self) -> Result<Model, MapError> {
        let outer = positive("outer", self.outer)?;
        let r = inner("r", self.r, outer)?;
        let (angle1, angle2) = (half_turn("angle1", self.angle1)?, turn("angle2", self.angle2)?);
        let grid = GluedGrid::new(&self.shape).full_turn(1, angle2).poles(0, 1, angle1);
        grid.cuboids(|p| spherical(between(r, outer, p[2]), angle1 * (p[0] - 0.5), angle2 * (p[1] - 0.5)))
    }
}

/// The solid between two cylinders about the z axis on z = 0, or a sector of it from angle 0 on. Default:
/// radii 1 and 2, height 6, full turn, 36 × 1 × 1.
///
/// ```
/// use lar_core::mapper::HollowCylinder;
/// let pipe = HollowCylinder::default().model()?;
/// assert_eq!(pipe.f_vector(), [144, 288, 180, 36]);
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "hollowCyl")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HollowCylinder {
    /// Inner radius, positive.
    pub r: f64,
    /// Outer radius, above `r`.
    pub outer: f64,
    /// Positive.
    pub height: f64,
    /// Above 0, at most 2π.
    pub angle: f64,
    /// Divisions of the angle, of the thickness and of the height.
    pub shape: [usize; 3],
}

impl Default for HollowCylinder {
    fn default() -> Self {
        Self { r: 1., outer: 2., height: 6., angle: TAU, shape: [36, 1, 1] }
    }
}

impl HollowCylinder {
    /// The cuboids, with all skeletons. O(size of the model).
    ///
    /// # Errors
    /// When a parameter is out of range; a full turn needs three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let (outer, height) = (positive("outer", self.outer)?, positive("height", self.height)?);
        let (r, angle) = (inner("r", self.r, outer)?, turn("angle", self.angle)?);
        GluedGrid::new(&self.shape).full_turn(0, angle).cuboids(|p| {
            let [x, y] = polar(between(r, outer, p[1]), angle * p[0]);
            [x, y, height * p[2]]
        })
    }
}

/// A solid torus about the z axis, its tube hollow: the solid between the tubes of radius `hole` and `r`, or
/// the part of it from angle 0 on. With `hole` 0 it is full, the core circle being one vertex a division.
/// Default: tube radius 1 at distance 2, hole 0.5, full turns, 24 × 36 × 4.
///
/// ```
/// use lar_core::mapper::Torus;
/// let hollow = Torus::default().model()?;
/// assert_eq!(hollow.boundary_cells()?.len(), 2 * 24 * 36);
/// let full = Torus { hole: 0., ..Torus::default() }.model()?;
/// assert_eq!(full.boundary_cells()?.len(), 24 * 36);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "torus")]
#[doc(alias = "hollowTorus")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Radius of the tube, positive and less than `ring`.
    pub r: f64,
    /// Distance of the tube's core from the axis.
    pub ring: f64,
    /// Radius of the hollow inside the tube, from 0 to less than `r`.
    pub hole: f64,
    /// Extent around the tube, above 0, at most 2π.
    pub angle1: f64,
    /// Extent around the axis, above 0, at most 2π.
    pub angle2: f64,
    /// Divisions around the tube, around the axis and of the thickness.
    pub shape: [usize; 3],
}

impl Default for Torus {
    fn default() -> Self {
        Self { r: 1., ring: 2., hole: 0.5, angle1: TAU, angle2: TAU, shape: [24, 36, 4] }
    }
}

impl Torus {
    /// The cuboids, with all skeletons. O(size of the model).
    ///
    /// # Errors
    /// When a parameter is out of range; full turns need three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let ring = positive("ring", self.ring)?;
        let r = inner("r", self.r, ring)?;
        let hole = if self.hole == 0. { 0. } else { inner("hole", self.hole, r)? };
        let (angle1, angle2) = (turn("angle1", self.angle1)?, turn("angle2", self.angle2)?);
        let mut grid = GluedGrid::new(&self.shape).full_turn(0, angle1).full_turn(1, angle2);
        if hole == 0. {
            grid = grid.collapsed(2, Side::Low, 0);
        }
        grid.cuboids(|p| on_torus(ring, between(hole, r, p[2]), angle1 * p[0], angle2 * p[1]))
    }
}
