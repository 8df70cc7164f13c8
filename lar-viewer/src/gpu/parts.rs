//! What the elements of a drawable have in common, as the shaders look it up: look, flags and group.

use super::frame::Placement;
use crate::scene::{Drawable, Shape};
use crate::{Appearance, GroupId, LEVELS, Rgb, Scene};
use bytemuck::{Pod, Zeroable};

/// Flag of a part whose mesh is lit; `LIT` in `common.wgsl`.
pub(crate) const LIT: u32 = 1;
/// Flag of a part that is cell edges; `CELL_EDGE` in `common.wgsl`.
pub(crate) const CELL_EDGE: u32 = 2;
/// Flag of a highlighted part; `HIGHLIGHTED` in `common.wgsl`.
pub(crate) const HIGHLIGHTED: u32 = 4;
/// Flag of a part that the clip plane cuts; `CLIPPED` in `common.wgsl`.
pub(crate) const CLIPPED: u32 = 8;
/// The group of what is in none; `NO_GROUP` in `common.wgsl`.
pub(crate) const NO_GROUP: u32 = u32::MAX;

/// Colour of what is highlighted, and how much of it is mixed with the part's own.
const HIGHLIGHT: (Rgb, f32) = ([1.0, 0.85, 0.0], 0.75);

/// An entry of the table of parts, two texels.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Part {
    /// Red, green, blue, opacity; opacity 0 is not drawn.
    pub(crate) color: [f32; 4],
    pub(crate) flags: u32,
    pub(crate) group: u32,
    padding: [u32; 2],
}

/// An entry of the table of groups, four texels: centroids relative to that of the group around, outermost first, each with
/// the bits of the number of the group at that level.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct GroupOffsets(pub(crate) [[f32; 4]; LEVELS]);

impl Part {
    /// The part of a drawable that looks like this.
    pub(crate) fn new(drawable: &Drawable, appearance: &Appearance) -> Self {
        let kind = match &drawable.shape {
            Shape::Mesh { lit: true, .. } => LIT,
            Shape::Lines { curve: Some(_), .. } => CELL_EDGE,
            Shape::Mesh { .. } | Shape::Lines { .. } | Shape::Points { .. } | Shape::Labels { .. } => 0,
        };
        let flag = |is_set: bool, flag| if is_set { flag } else { 0 };
        let flags = kind | flag(appearance.highlighted, HIGHLIGHTED) | flag(drawable.clipped, CLIPPED);
        let group = drawable.group.map_or(NO_GROUP, |g| g.0);
        Self { color: color(appearance), flags, group, padding: [0; 2] }
    }

    /// Whether it is drawn in the pass of layers, given what the view multiplies the opacity of its kind by.
    pub(crate) fn is_layer(&self, dimming: f32) -> bool {
        let dimming = if self.flags & HIGHLIGHTED == 0 { dimming } else { 1.0 };
        let alpha = self.color[3] * dimming;
        0.0 < alpha && alpha < 1.0
    }
}

fn color(appearance: &Appearance) -> [f32; 4] {
    let [r, g, b] = appearance.color;
    if !appearance.visible {
        return [r, g, b, 0.0];
    }
    if !appearance.highlighted {
        return [r, g, b, appearance.opacity];
    }
    let (highlight, share) = HIGHLIGHT;
    let mixed = |k: usize| share * highlight[k] + (1.0 - share) * appearance.color[k];
    [mixed(0), mixed(1), mixed(2), 1.0]
}

/// The table of a scene's groups; one entry at least.
pub(crate) fn group_offsets(scene: &Scene, placement: &Placement) -> Vec<GroupOffsets> {
    let offsets = |chain: Vec<GroupId>| {
        let mut offsets = [[0.0; 4]; LEVELS];
        let mut from = placement.center;
        for (offset, group) in offsets.iter_mut().zip(&chain) {
            let centroid = scene.groups()[group.0 as usize].centroid;
            let relative = std::array::from_fn(|k| placement.center[k] + (centroid[k] - from[k]));
            let [x, y, z] = placement.far_from_world(relative);
            (*offset, from) = ([x, y, z, 0.0], centroid);
        }
        let own = chain.last().map_or(0, |g| g.0);
        let around = (0..LEVELS).map(|level| chain.get(level).map_or(own, |g| g.0));
        offsets.iter_mut().zip(around).for_each(|(offset, group)| offset[3] = f32::from_bits(group));
        GroupOffsets(offsets)
    };
    let mut table: Vec<_> =
        (0..scene.groups().len()).map(|g| offsets(scene.around(GroupId(g as u32)))).collect();
    if table.is_empty() {
        table.push(GroupOffsets([[0.0; 4]; LEVELS]));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn highlighted_is_opaque_and_hidden_is_not_drawn() {
        let dot = Drawable::points("dot", [[0.0; 3]]).opacity(0.4);
        let look = dot.appearance();
        let alpha = |look: Appearance| Part::new(&dot, &look).color[3];
        assert_eq!(alpha(look), 0.4);
        assert_eq!(alpha(Appearance { highlighted: true, ..look }), 1.0);
        assert_eq!(alpha(Appearance { highlighted: true, visible: false, ..look }), 0.0);
        let part = |look: Appearance| Part::new(&dot, &look);
        assert!(part(look).is_layer(1.0));
        assert!(!part(Appearance { highlighted: true, ..look }).is_layer(0.5));
        assert!(part(Appearance { opacity: 1.0, ..look }).is_layer(0.5));
    }

    #[test]
    fn groups_are_placed_relative_to_the_one_around() {
        let mut scene = Scene::new();
        let outer = scene.push_group([3.0, 0.0, 0.0]).unwrap();
        scene.push_subgroup(outer, [3.0, 4.0, 0.0]).unwrap();
        let placement = Placement { center: [1.0, 0.0, 0.0], unit: 2.0 };
        let table = group_offsets(&scene, &placement);
        let places = |g: usize| table[g].0.map(|[x, y, z, _]| [x, y, z]);
        let groups = |g: usize| table[g].0.map(|[.., group]| group.to_bits());
        assert_eq!(places(0)[0], [1.0, 0.0, 0.0]);
        assert_eq!(places(1), [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0; 3], [0.0; 3]]);
        assert_eq!((groups(0), groups(1)), ([0; 4], [0, 1, 1, 1]));
    }
}
