//! Faces as areas on the screen, in the light of pictures.

use super::Placed;
use super::tree::Triangle;
use crate::scene::Shape;
use crate::{CellRef, Projection, Rgb};
use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

/// Steps in a pixel to which corners are rounded, so that the sides of triangles cancel out.
const STEPS: f64 = 100.0;
/// Triangles that show no cells of their own are one face as long as their normals differ by no more than this.
const FLAT: f64 = 1e-9;

/// A filled face.
#[derive(Clone, Debug, PartialEq)]
pub struct InkArea {
    /// Its outlines, in pixels from the middle of the picture, y upwards; what is inside is found by parity.
    pub loops: Vec<Vec<[f64; 2]>>,
    /// Colour, in its light.
    pub color: Rgb,
    /// 0 invisible to 1 opaque.
    pub opacity: f64,
}

impl InkArea {
    pub(super) fn moved(&self, by: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let moved = |cycle: &Vec<[f64; 2]>| cycle.iter().map(|&p| by(p)).collect();
        Self { loops: self.loops.iter().map(moved).collect(), ..*self }
    }
}

/// A face on the screen.
pub(super) struct Face {
    pub(super) triangles: Vec<Triangle>,
    pub(super) area: InkArea,
}

/// The faces of a drawable: the triangles that show the same cell one after the other.
pub(super) fn faces(placed: &Placed<'_>) -> Vec<Face> {
    let Shape::Mesh { lit, .. } = placed.drawable.shape else { return Vec::new() };
    let elements: Vec<usize> = (0..placed.drawable.n_elements()).collect();
    let normal = |t: usize| normal(&placed.drawable.corners_of_element(t));
    let own = |t: usize| -> Option<&CellRef> { placed.drawable.element_cells.get(t) };
    let together = |s: &usize, t: &usize| match (own(*s), own(*t)) {
        (None, None) => normal(*s).zip(normal(*t)).is_some_and(|(m, n)| m.abs_diff_eq(n, FLAT)),
        (a, b) => a == b,
    };
    let face = |elements: &[usize]| {
        let triangles: Vec<Triangle> = elements.iter().flat_map(|&t| placed.seen_triangles(t)).collect();
        let loops = loops(&triangles);
        let (own, first) = (placed.drawable.appearance.color, *elements.first()?);
        let color = if lit { shaded(placed, own, first, normal(first)?) } else { own };
        let area = InkArea { loops, color, opacity: placed.opacity() };
        (!area.loops.is_empty()).then_some(Face { triangles, area })
    };
    elements.chunk_by(together).filter_map(face).collect()
}

fn normal(corners: &[[f64; 3]]) -> Option<DVec3> {
    let [a, b, c] = *corners else { return None };
    let [a, b, c] = [a, b, c].map(DVec3::from);
    (b - a).cross(c - a).try_normalize()
}

/// The light of `shaded` in `common.wgsl`, at the middle of a triangle.
fn shaded(placed: &Placed<'_>, color: Rgb, element: usize, normal: DVec3) -> Rgb {
    let camera = &placed.view.camera;
    let axes = camera.axes().map(DVec3::from);
    let in_view = |v: DVec3| Vec3::from_array(axes.map(|axis| axis.dot(v) as f32));
    let corners = placed.drawable.corners_of_element(element);
    let sum: DVec3 = corners.iter().map(|&c| DVec3::from(c)).sum();
    let middle = sum / corners.len() as f64 + DVec3::from(placed.moved);
    let eye = match camera.projection {
        Projection::Orthographic => Vec3::Z,
        Projection::Perspective => in_view(DVec3::from(camera.eye()) - middle).normalize_or(Vec3::Z),
    };
    let normal = in_view(normal);
    let facing = normal.dot(eye);
    let outward = if facing < 0.0 { -normal } else { normal };
    let key = outward.dot(Vec3::new(-0.42, 0.80, 0.43)).max(0.0);
    color.map(|c| c * (0.64 + 0.27 * facing.abs() + 0.27 * key).min(1.0))
}

/// The outlines of triangles that lie side by side: sides that two of them share in opposite directions cancel out.
fn loops(triangles: &[Triangle]) -> Vec<Vec<[f64; 2]>> {
    type Corner = [i64; 2];
    let mut sides: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
    for triangle in triangles {
        let corners = triangle.corners().map(|p| p.map(|c| (STEPS * c).round() as i64));
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            let back = sides.get_mut(&to).and_then(|ends| {
                let at = ends.iter().position(|end| *end == from)?;
                Some(ends.swap_remove(at))
            });
            if from != to && back.is_none() {
                sides.entry(from).or_default().push(to);
            }
        }
    }
    let mut loops = Vec::new();
    while let Some(first) = sides.first_entry() {
        let start = *first.key();
        if first.get().is_empty() {
            first.remove();
            continue;
        }
        let mut cycle = vec![start];
        let mut at = start;
        while let Some(next) = sides.get_mut(&at).and_then(Vec::pop).filter(|next| *next != start) {
            cycle.push(next);
            at = next;
        }
        loops.push(cycle.into_iter().map(|p| p.map(|c| c as f64 / STEPS)).collect());
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::project::Seen;

    #[test]
    fn sides_inside_of_a_face_cancel_out() {
        let seen = |[x, y]: [f64; 2]| Seen { x, y, q: 1.0 };
        let triangle = |corners: [[f64; 2]; 3]| Triangle::new(corners.map(seen), 0.0).unwrap();
        let square = [triangle([[0., 0.], [1., 0.], [1., 1.]]), triangle([[0., 0.], [0., 1.], [1., 1.]])];
        assert_eq!(loops(&square), [[[0., 0.], [1., 0.], [1., 1.], [0., 1.]]]);
        let apart = [square[0], triangle([[5., 0.], [6., 0.], [6., 1.]])];
        assert_eq!(loops(&apart).len(), 2);
        assert!(loops(&[]).is_empty());
    }
}
