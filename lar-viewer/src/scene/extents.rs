//! Boxes of a scene's drawables, for bounds of the exploded scene without reading its points again.

use super::drawable::Drawable;
use super::{Explosion, Scene};
use crate::Bounds;

/// The boxes of a scene's drawables and the centroids by which they move.
#[derive(Clone, Debug)]
pub(crate) struct Extents {
    /// The scene's centre.
    pub(crate) center: [f64; 3],
    /// Box of each drawable, `None` when it has no points, and the index of its group.
    boxes: Vec<Option<(Bounds, Option<usize>)>>,
    /// Centroids of each group and of those around it, outermost first.
    chains: Vec<Vec<[f64; 3]>>,
}

impl Extents {
    pub(crate) fn new(scene: &Scene) -> Self {
        Self::about(scene, None)
    }

    /// With this centre instead of the scene's own.
    pub(crate) fn about(scene: &Scene, center: Option<[f64; 3]>) -> Self {
        let placed = |d: &Drawable| Some((d.bounds()?, d.group.map(|g| g.0 as usize)));
        let boxes: Vec<_> = scene.drawables().iter().map(placed).collect();
        let around = |grouped: bool| {
            let chosen = boxes.iter().flatten().filter(|(_, g)| g.is_some() || !grouped);
            chosen.map(|(b, _)| *b).reduce(Bounds::union)
        };
        let own = || around(true).or_else(|| around(false)).map_or([0.0; 3], |b| b.center());
        let center = center.unwrap_or_else(own);
        Self { center, boxes, chains: scene.centroid_chains() }
    }

    /// The box around the exploded scene.
    pub(crate) fn bounds(&self, explosion: &Explosion) -> Option<Bounds> {
        let moved = self.chains.iter().map(|c| explosion.displacement(c, self.center)).collect::<Vec<_>>();
        let placed = |(b, group): &(Bounds, Option<usize>)| b.moved(group.map_or([0.0; 3], |g| moved[g]));
        self.boxes.iter().flatten().map(placed).reduce(Bounds::union)
    }
}
