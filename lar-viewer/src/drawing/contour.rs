//! Outlines of line drawings: the sides of triangles beyond which there is nothing more of what they belong to.

use super::tree::Tree;
use super::{InkLine, Placed, Seen, visible_pieces};
use crate::scene::Shape;
use crate::{Outline, Scene};
use std::collections::BTreeMap;

/// A point of the exploded scene, by the bits of its coordinates.
type Corner = [u64; 3];

/// A side, its ends in order, and on which of its sides on the screen there are triangles.
struct Side {
    ends: [Seen; 2],
    left: bool,
    right: bool,
}

/// The visible pieces of outlines: of each outlined thing the sides with triangles on one side only, as they lie on the
/// screen. O(n log n).
pub(super) fn ink(scene: &Scene, placed: &[Placed<'_>], outline: &Outline, tree: &Tree) -> Vec<InkLine> {
    let mut sides: BTreeMap<(Option<u32>, [Corner; 2]), Side> = BTreeMap::new();
    for placed in placed.iter().filter(|p| matches!(p.drawable.shape, Shape::Mesh { .. })) {
        let around = placed.drawable.group.map(|g| scene.around(g));
        let of_level = |level: usize| around.as_ref().and_then(|a| a.get(level).or(a.last())).map(|g| g.0);
        let thing = outline.of.level().and_then(of_level);
        for element in 0..placed.drawable.n_elements() {
            let polygon = placed.kept(&placed.drawable.corners_of_element(element));
            let seen: Vec<Seen> = polygon.iter().map(|&p| placed.projector.seen(p)).collect();
            let Some(counter_clockwise) = orientation(&seen) else { continue };
            for i in 0..polygon.len() {
                let j = (i + 1) % polygon.len();
                let key = [i, j].map(|k| polygon[k].map(f64::to_bits));
                let forward = key[0] < key[1];
                let (key, ends) =
                    if forward { (key, [seen[i], seen[j]]) } else { ([key[1], key[0]], [seen[j], seen[i]]) };
                let side = sides.entry((thing, key)).or_insert(Side { ends, left: false, right: false });
                // A polygon that is counter-clockwise lies to the left of its sides.
                let is_left = counter_clockwise == forward;
                (side.left, side.right) = (side.left || is_left, side.right || !is_left);
            }
        }
    }
    let width = placed.first().map_or(1.0, |p| f64::from(p.view.scale)) * f64::from(outline.width);
    let contour = sides.values().filter(|side| side.left != side.right);
    let pieces = contour.flat_map(|side| visible_pieces(tree, side.ends[0], side.ends[1]));
    pieces.map(|(ends, opacity)| InkLine { ends, width, color: outline.color, opacity }).collect()
}

/// Whether a polygon is counter-clockwise on the screen; `None` when it is seen edge-on.
fn orientation(polygon: &[Seen]) -> Option<bool> {
    let n = polygon.len();
    let twice = |i: usize| {
        let (a, b) = (polygon[i], polygon[(i + 1) % n]);
        a.x * b.y - a.y * b.x
    };
    let area: f64 = (0..n).map(twice).sum();
    (1e-9 < area.abs()).then_some(0.0 < area)
}
