//! Surfaces: oriented triangles, two to a cell of the parameter grid.

use super::curves::turns;
use super::{GluedGrid, MapError, Side, finite, half_turn, inner, polar, positive, turn};
use crate::Model;
use std::f64::consts::{PI, TAU};

/// A disk about the origin of the plane, or a sector of it from angle 0 on, counter-clockwise triangles. The
/// centre is one vertex. Default: radius 1, full turn, 36 × 2.
///
/// ```
/// use lar_core::mapper::Disk;
/// let disk = Disk::default().model()?;
/// assert_eq!((disk.points().len(), disk.cells(2).len()), (73, 36 + 72));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "disk")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// Positive.
    pub radius: f64,
    /// Above 0, at most 2π.
    pub angle: f64,
    /// Divisions of the angle and of the radius.
    pub shape: [usize; 2],
}

impl Default for Disk {
    fn default() -> Self {
        Self { radius: 1., angle: TAU, shape: [36, 2] }
    }
}

impl Disk {
    /// The triangles, in the plane.
    ///
    /// # Errors
    /// When a parameter is out of range; a full turn needs three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let (radius, angle) = (positive("radius", self.radius)?, turn("angle", self.angle)?);
        let [around, out] = self.shape;
        let grid = GluedGrid::new(&[out, around]).full_turn(1, angle).collapsed(0, Side::Low, 1);
        grid.triangles(|p| polar(radius * p[0], angle * p[1]))
    }
}

/// The part of the plane between two circles about the origin, or a sector of it from angle 0 on,
/// counter-clockwise triangles. Default: radii 1 and 2, full turn, 36 × 1.
///
/// ```
/// use lar_core::mapper::Ring;
/// let ring = Ring::default().model()?;
/// assert_eq!((ring.points().len(), ring.cells(2).len()), (72, 72));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "ring")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Inner radius, positive.
    pub r: f64,
    /// Outer radius, above `r`.
    pub outer: f64,
    /// Above 0, at most 2π.
    pub angle: f64,
    /// Divisions of the angle and of the radius.
    pub shape: [usize; 2],
}

impl Default for Ring {
    fn default() -> Self {
        Self { r: 1., outer: 2., angle: TAU, shape: [36, 1] }
    }
}

impl Ring {
    /// The triangles, in the plane.
    ///
    /// # Errors
    /// When a parameter is out of range; a full turn needs three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let (outer, angle) = (positive("outer", self.outer)?, turn("angle", self.angle)?);
        let r = inner("r", self.r, outer)?;
        let [around, out] = self.shape;
        let grid = GluedGrid::new(&[out, around]).full_turn(1, angle);
        grid.triangles(|p| polar(between(r, outer, p[0]), angle * p[1]))
    }
}

/// A helicoid about the z axis between two radii, rising from z = 0; normals point up. Default: radii 0.5 and
/// 1, rise 1 a turn, 2 turns of 36 × 2.
///
/// ```
/// use lar_core::mapper::Helicoid;
/// let stairs = Helicoid::default().model()?;
/// assert_eq!((stairs.points().len(), stairs.cells(2).len()), (73 * 3, 72 * 2 * 2));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "helicoid")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helicoid {
    /// Inner radius, positive.
    pub r: f64,
    /// Outer radius, above `r`.
    pub outer: f64,
    /// Rise along z in one turn; negative for a left-handed helicoid.
    pub pitch: f64,
    /// Number of turns.
    pub n_turns: usize,
    /// Divisions of each turn and of the radius.
    pub shape: [usize; 2],
}

impl Default for Helicoid {
    fn default() -> Self {
        Self { r: 0.5, outer: 1., pitch: 1., n_turns: 2, shape: [36, 2] }
    }
}

impl Helicoid {
    /// The triangles, in space.
    ///
    /// # Errors
    /// When a parameter is out of range.
    pub fn model(&self) -> Result<Model, MapError> {
        let (outer, pitch) = (positive("outer", self.outer)?, finite("pitch", self.pitch)?);
        let (r, turns) = (inner("r", self.r, outer)?, turns(self.n_turns));
        let [around, out] = self.shape;
        GluedGrid::new(&[out, self.n_turns.saturating_mul(around)]).triangles(|p| {
            let [x, y] = polar(between(r, outer, p[0]), TAU * (turns * p[1]));
            [x, y, pitch * turns * p[1]]
        })
    }
}

/// The side of a right circular cylinder about the z axis on z = 0, without its two ends; normals point out.
/// Default: radius 0.5, height 2, full turn, 36 × 1.
///
/// ```
/// use lar_core::mapper::Cylinder;
/// let tube = Cylinder::default().model()?;
/// assert_eq!((tube.points().len(), tube.cells(2).len()), (72, 72));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "cylinder")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Positive.
    pub radius: f64,
    /// Positive.
    pub height: f64,
    /// Above 0, at most 2π.
    pub angle: f64,
    /// Divisions of the angle and of the height.
    pub shape: [usize; 2],
}

impl Default for Cylinder {
    fn default() -> Self {
        Self { radius: 0.5, height: 2., angle: TAU, shape: [36, 1] }
    }
}

impl Cylinder {
    /// The triangles, in space.
    ///
    /// # Errors
    /// When a parameter is out of range; a full turn needs three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let (radius, height) = (positive("radius", self.radius)?, positive("height", self.height)?);
        let angle = turn("angle", self.angle)?;
        GluedGrid::new(&self.shape).full_turn(0, angle).triangles(|p| {
            let [x, y] = polar(radius, angle * p[0]);
            [x, y, height * p[1]]
        })
    }
}

/// A sphere about the origin, or the part of it at latitudes and longitudes from −angle/2 to angle/2; normals
/// point out. Each pole is one vertex. Default: radius 1, whole, 18 × 36.
///
/// ```
/// use lar_core::mapper::Sphere;
/// let sphere = Sphere::default().model()?.to_triangle_mesh()?;
/// assert!(sphere.is_closed() && sphere.signed_volume() > 4.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "sphere")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Positive.
    pub radius: f64,
    /// Extent in latitude, above 0, at most π.
    pub angle1: f64,
    /// Extent in longitude, above 0, at most 2π.
    pub angle2: f64,
    /// Divisions of latitude and of longitude.
    pub shape: [usize; 2],
}

impl Default for Sphere {
    fn default() -> Self {
        Self { radius: 1., angle1: PI, angle2: TAU, shape: [18, 36] }
    }
}

impl Sphere {
    /// The triangles, in space; the first axis runs from north to south.
    ///
    /// # Errors
    /// When a parameter is out of range; from pole to pole there must be two divisions, around three.
    pub fn model(&self) -> Result<Model, MapError> {
        let radius = positive("radius", self.radius)?;
        let (angle1, angle2) = (half_turn("angle1", self.angle1)?, turn("angle2", self.angle2)?);
        let grid = GluedGrid::new(&self.shape).full_turn(1, angle2).poles(0, 1, angle1);
        grid.triangles(|p| spherical(radius, angle1 * (0.5 - p[0]), angle2 * (p[1] - 0.5)))
    }
}

/// The surface of a torus about the z axis: closed, of genus 1; normals point out. Angles below a full turn
/// give the part of it from angle 0 on. Default: tube radius 1 at distance 2 from the axis, full turns, 24 ×
/// 36.
///
/// ```
/// use lar_core::mapper::Toroidal;
/// let torus = Toroidal::default().model()?;
/// assert_eq!((torus.points().len(), torus.cells(2).len()), (24 * 36, 2 * 24 * 36));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "toroidal")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Toroidal {
    /// Radius of the tube, positive and less than `ring`.
    pub r: f64,
    /// Distance of the tube's core from the axis.
    pub ring: f64,
    /// Extent around the tube, above 0, at most 2π.
    pub angle1: f64,
    /// Extent around the axis, above 0, at most 2π.
    pub angle2: f64,
    /// Divisions around the tube and around the axis.
    pub shape: [usize; 2],
}

impl Default for Toroidal {
    fn default() -> Self {
        Self { r: 1., ring: 2., angle1: TAU, angle2: TAU, shape: [24, 36] }
    }
}

impl Toroidal {
    /// The triangles, in space; the first axis runs around the tube, from the outer equator downwards.
    ///
    /// # Errors
    /// When a parameter is out of range; full turns need three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let ring = positive("ring", self.ring)?;
        let r = inner("r", self.r, ring)?;
        let (angle1, angle2) = (turn("angle1", self.angle1)?, turn("angle2", self.angle2)?);
        let grid = GluedGrid::new(&self.shape).full_turn(0, angle1).full_turn(1, angle2);
        grid.triangles(|p| on_torus(ring, r, angle1 * p[0], angle2 * p[1]))
    }
}

/// The outer half of the surface of a torus about the z axis: open, from the upper to the lower circle of the
/// tube; normals point out. Default: tube radius 1 at distance 2, full turn, 12 × 36.
///
/// ```
/// use lar_core::mapper::Crown;
/// let crown = Crown::default().model()?;
/// assert_eq!((crown.points().len(), crown.cells(2).len()), (13 * 36, 2 * 12 * 36));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "crown")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crown {
    /// Radius of the tube, positive and less than `ring`.
    pub r: f64,
    /// Distance of the tube's core from the axis.
    pub ring: f64,
    /// Extent around the axis, above 0, at most 2π.
    pub angle: f64,
    /// Divisions around the half tube and around the axis.
    pub shape: [usize; 2],
}

impl Default for Crown {
    fn default() -> Self {
        Self { r: 1., ring: 2., angle: TAU, shape: [12, 36] }
    }
}

impl Crown {
    /// The triangles, in space; the first axis runs downwards.
    ///
    /// # Errors
    /// When a parameter is out of range; a full turn needs three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let ring = positive("ring", self.ring)?;
        let (r, angle) = (inner("r", self.r, ring)?, turn("angle", self.angle)?);
        let grid = GluedGrid::new(&self.shape).full_turn(1, angle);
        grid.triangles(|p| on_torus(ring, r, PI * (p[0] - 0.5), angle * p[1]))
    }
}

/// From `a` to `b`, both ends exact.
pub(super) fn between(a: f64, b: f64, t: f64) -> f64 {
    a * (1. - t) + b * t
}

pub(super) fn spherical(radius: f64, latitude: f64, longitude: f64) -> [f64; 3] {
    let [out, z] = polar(radius, latitude);
    let [x, y] = polar(out, longitude);
    [x, y, z]
}

/// The point of the torus at angle `u` around the tube, downwards from the outer equator, and `v` around the
/// axis.
pub(super) fn on_torus(ring: f64, r: f64, u: f64, v: f64) -> [f64; 3] {
    let [out, down] = polar(r, u);
    let [x, y] = polar(ring + out, v);
    [x, y, -down]
}
