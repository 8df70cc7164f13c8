//! Solids of one 3-cell: its faces are the patches of the surface and flat polygons.

use super::surfaces::on_torus;
use super::{MapError, inner, polar, positive, turn};
use crate::{Cells, Model, Points};
use std::f64::consts::{PI, TAU};

/// A solid cylinder about the z axis on z = 0 as a single 3-cell between two polygons. With less than a full
/// turn the polygons are segments of the circle, from angle 0 on, cut off by a chord. Default: radius 1,
/// height 3, full turn, 36 sides.
///
/// ```
/// use lar_core::mapper::Rod;
/// let rod = Rod::default().model()?;
/// assert_eq!(rod.f_vector(), [72, 108, 38, 1]);
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "rod")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rod {
    /// Positive.
    pub radius: f64,
    /// Positive.
    pub height: f64,
    /// Above 0, at most 2π.
    pub angle: f64,
    /// Divisions of the angle.
    pub shape: usize,
}

impl Default for Rod {
    fn default() -> Self {
        Self { radius: 1., height: 3., angle: TAU, shape: 36 }
    }
}

impl Rod {
    /// The 3-cell with all its faces: lower vertices first, then the upper ones. O(size of the model).
    ///
    /// # Errors
    /// When a parameter is out of range; a full turn needs three divisions, an arc two.
    pub fn model(&self) -> Result<Model, MapError> {
        let (radius, height) = (positive("radius", self.radius)?, positive("height", self.height)?);
        let angle = turn("angle", self.angle)?;
        let corners = check_around(0, self.shape, angle, 2)?;
        let mut solid = Solid::default();
        for z in [0., height] {
            for i in 0..corners {
                let [x, y] = polar(radius, angle * ratio(i, self.shape));
                solid.points.push([x, y, z]);
            }
        }
        let n = u32::try_from(corners).expect("checked by check_around");
        let (below, above): (Vec<u32>, Vec<u32>) = ((0..n).collect(), (n..2 * n).collect());
        solid.quads(&below, &above, true);
        solid.faces.push(&below);
        solid.faces.push(&above);
        Ok(solid.model())
    }
}

/// A round slab with a rounded rim, or a slice of it from angle 0 on with its tip on the z axis, as a single
/// 3-cell: the patches of a [`Crown`](super::Crown) between two flat polygons at z = ±r, and for a slice two
/// flat walls. Default: rim of radius 0.1 at distance 1, half a turn, 24 × 36.
///
/// ```
/// use lar_core::mapper::Pizza;
/// let half = Pizza::default().model()?;
/// assert_eq!((half.points().len(), half.cells(2).len()), (25 * 37 + 2, 24 * 36 + 4));
/// # Ok::<(), lar_core::mapper::MapError>(())
/// ```
#[doc(alias = "pizza")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pizza {
    /// Radius of the rim, positive and less than `ring`.
    pub r: f64,
    /// Distance of the rim's core from the axis.
    pub ring: f64,
    /// Above 0, at most 2π.
    pub angle: f64,
    /// Divisions around the rim and around the axis.
    pub shape: [usize; 2],
}

impl Default for Pizza {
    fn default() -> Self {
        Self { r: 0.1, ring: 1., angle: PI, shape: [24, 36] }
    }
}

impl Pizza {
    /// The 3-cell with all its faces: rim vertices from top to bottom, around the axis at each height, then
    /// for a slice the upper and the lower tip. O(size of the model).
    ///
    /// # Errors
    /// When a parameter is out of range; a full turn needs three divisions.
    pub fn model(&self) -> Result<Model, MapError> {
        let ring = positive("ring", self.ring)?;
        let (r, angle) = (inner("r", self.r, ring)?, turn("angle", self.angle)?);
        let [down, around] = self.shape;
        if down == 0 {
            return Err(MapError::Divisions { axis: 0, found: 0, least: 1 });
        }
        super::glued::check_size(&self.shape)?;
        let corners = check_around(1, around, angle, 1)?;
        let mut solid = Solid::default();
        let mut circles = Vec::new();
        for i in 0..=down {
            let first = solid.points.len();
            for j in 0..corners {
                solid.points.push(on_torus(ring, r, PI * (ratio(i, down) - 0.5), angle * ratio(j, around)));
            }
            circles.push((0_u32..).take(solid.points.len()).skip(first).collect::<Vec<u32>>());
        }
        let closed = corners == around;
        for w in circles.windows(2) {
            solid.quads(&w[0], &w[1], closed);
        }
        solid.caps_and_walls(&circles, r, closed);
        Ok(solid.model())
    }
}

/// A single 3-cell under construction.
#[derive(Default)]
struct Solid {
    points: Vec<[f64; 3]>,
    faces: Cells,
}

impl Solid {
    /// The quadrilaterals between two rows of vertices of one length.
    fn quads(&mut self, first: &[u32], second: &[u32], closed: bool) {
        let n = first.len();
        for i in 0..n - usize::from(!closed) {
            let j = (i + 1) % n;
            self.faces.push(&[first[i], first[j], second[j], second[i]]);
        }
    }

    /// The flat faces: top and bottom, and for a slice the walls to the axis.
    fn caps_and_walls(&mut self, circles: &[Vec<u32>], r: f64, closed: bool) {
        let (mut top, mut bottom) = (circles[0].clone(), circles[circles.len() - 1].clone());
        if !closed {
            let tip = u32::try_from(self.points.len()).expect("the size was checked");
            self.points.extend([[0., 0., r], [0., 0., -r]]);
            for end in [0, top.len() - 1] {
                let mut wall: Vec<u32> = circles.iter().map(|circle| circle[end]).collect();
                wall.extend([tip + 1, tip]);
                self.faces.push(&wall);
            }
            top.push(tip);
            bottom.push(tip + 1);
        }
        self.faces.push(&top);
        self.faces.push(&bottom);
    }

    /// The edges are the sides of the faces in first-seen order.
    fn model(self) -> Model {
        let n = self.points.len();
        let cells = vec![
            Cells::singletons(n),
            crate::from_model::sides(&self.faces),
            self.faces,
            Cells::uniform(n, (0..).take(n).collect()),
        ];
        Model::new(Points::from_xyz(&self.points), cells)
    }
}

/// The number of distinct directions: one more than the divisions of an arc.
fn check_around(axis: usize, found: usize, angle: f64, least: usize) -> Result<usize, MapError> {
    super::glued::check_size(&[found, 1])?;
    let (least, corners) = if angle == TAU { (3, found) } else { (least, found + 1) };
    if found < least { Err(MapError::Divisions { axis, found, least }) } else { Ok(corners) }
}

#[expect(clippy::cast_precision_loss, reason = "divisions stay below 2^32")]
fn ratio(i: usize, n: usize) -> f64 {
    i as f64 / n as f64
}
