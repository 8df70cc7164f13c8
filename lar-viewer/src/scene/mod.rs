//! Scenes: named drawables with colour, opacity and an explode group.
//!
//! A scene is draw data only. It knows neither models nor chain complexes; a drawable, and each of its triangles, segments
//! and dots, may carry the dimension and index of the cell that it shows, for whoever asks what is under the cursor.
//! Everything is validated when it is pushed, with the drawable's name in the error, so that drawing cannot meet NaN or a
//! dangling index.
//!
//! *Explosion*: a group is a centroid, and all drawables of a group move rigidly together, away from the scene's centre or
//! from the group around theirs ([`Explosion`]). Ungrouped drawables (axes, backgrounds) stay where they are. The centre
//! is the middle of the box around all grouped drawables.

mod appearance;
mod cell;
mod curves;
mod drawable;
mod explosion;
mod extents;
mod validate;

pub use appearance::Appearance;
pub use cell::CellRef;
pub use drawable::Drawable;
pub use explosion::{Explosion, LEVELS};

pub(crate) use curves::mean_curve_length;
pub(crate) use drawable::Shape;
pub(crate) use extents::Extents;
pub(crate) use validate::finite;

use crate::{Bounds, ViewerError};
use lar_core::Points;

/// Names a group of one scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GroupId(pub(crate) u32);

/// What moves together when a scene is exploded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Group {
    /// The point by which it moves.
    pub centroid: [f64; 3],
    /// The group that it moves with.
    pub parent: Option<GroupId>,
    /// Number of groups around it.
    pub level: usize,
}

/// Named drawables and the groups in which they explode.
///
/// ```
/// use lar_core::{Points, TriangleMesh};
/// use lar_viewer::{Drawable, Scene};
/// let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);
/// let mut scene = Scene::new();
/// let group = scene.push_group([0.3, 0.3, 0.0])?;
/// scene.push(Drawable::mesh("triangle", TriangleMesh { points, triangles: vec![[0, 1, 2]] }).group(group))?;
/// assert_eq!(scene.bounds([1.0; 3]).unwrap().max, [1.0, 1.0, 0.0]);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    drawables: Vec<Drawable>,
    groups: Vec<Group>,
}

impl Scene {
    /// A scene without drawables.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a group of drawables that explode together about this centroid.
    ///
    /// # Errors
    /// `Coordinate` when the centroid is not finite.
    ///
    /// # Panics
    /// When the scene has 2^32 groups.
    pub fn push_group(&mut self, centroid: [f64; 3]) -> Result<GroupId, ViewerError> {
        finite("group", "centroid", self.groups.len(), &centroid)?;
        let id = GroupId(u32::try_from(self.groups.len()).expect("memory ends before 2^32 groups"));
        self.groups.push(Group { centroid, parent: None, level: 0 });
        Ok(id)
    }

    /// Adds a group that moves with another and, by the factors of its own level, away from the other's centroid.
    ///
    /// ```
    /// let mut scene = lar_viewer::Scene::new();
    /// let solid = scene.push_group([0.0; 3])?;
    /// let cell = scene.push_subgroup(solid, [1.0, 0.0, 0.0])?;
    /// assert_eq!(scene.groups()[1].level, 1);
    /// # Ok::<(), lar_viewer::ViewerError>(())
    /// ```
    ///
    /// # Errors
    /// `Coordinate` when the centroid is not finite, `GroupOutOfRange` when there is no such parent, `GroupDepth` when
    /// there are [`LEVELS`] groups around it already.
    pub fn push_subgroup(&mut self, parent: GroupId, centroid: [f64; 3]) -> Result<GroupId, ViewerError> {
        let n_groups = self.groups.len();
        let Some(around) = self.groups.get(parent.0 as usize) else {
            return Err(ViewerError::GroupOutOfRange { drawable: "group".into(), group: parent.0, n_groups });
        };
        let level = around.level + 1;
        if LEVELS <= level {
            return Err(ViewerError::GroupDepth { group: n_groups, limit: LEVELS });
        }
        let id = self.push_group(centroid)?;
        self.groups[id.0 as usize] = Group { centroid, parent: Some(parent), level };
        Ok(id)
    }

    /// Adds a drawable. O(size of the drawable).
    ///
    /// # Errors
    /// `Coordinate`, `Attribute`, `PointOutOfRange`, `Dimension`, `ElementCells` or `GroupOutOfRange`, each with the
    /// drawable's name; the scene is then unchanged.
    pub fn push(&mut self, drawable: Drawable) -> Result<(), ViewerError> {
        drawable.validate()?;
        let n_groups = self.groups.len();
        if let Some(GroupId(group)) = drawable.group
            && group as usize >= n_groups
        {
            return Err(ViewerError::GroupOutOfRange { drawable: drawable.name, group, n_groups });
        }
        self.drawables.push(drawable);
        Ok(())
    }

    /// The groups alone.
    pub(crate) fn without_drawables(&self) -> Self {
        Self { drawables: Vec::new(), groups: self.groups.clone() }
    }

    /// The drawables in the order in which they were pushed.
    #[must_use]
    pub fn drawables(&self) -> &[Drawable] {
        &self.drawables
    }

    /// The groups in the order in which they were pushed.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// How each drawable looks when nothing else is asked for: what an interface starts from, changes, and hands to the
    /// renderer.
    #[must_use]
    pub fn appearances(&self) -> Vec<Appearance> {
        self.drawables.iter().map(Drawable::appearance).collect()
    }

    /// The fixed point of the explosion: the middle of the box around all grouped drawables, or around everything
    /// when nothing is grouped; the origin in an empty scene.
    #[must_use]
    pub fn center(&self) -> [f64; 3] {
        Extents::new(self).center
    }

    /// The box around the scene exploded by these factors, 1 meaning in place; `None` when nothing is to be drawn.
    /// Takes time linear in the size of the scene.
    #[must_use]
    pub fn bounds(&self, explode: impl Into<Explosion>) -> Option<Bounds> {
        Extents::new(self).bounds(&explode.into())
    }

    /// How far a drawable moves in the exploded scene whose centre is `center`; it may be kept, as it costs a pass over
    /// the scene.
    #[must_use]
    pub fn displacement(&self, drawable: &Drawable, explosion: &Explosion, center: [f64; 3]) -> [f64; 3] {
        drawable.group.map_or([0.0; 3], |g| explosion.displacement(&self.centroid_chain(g), center))
    }

    /// The points of all drawables in the exploded scene.
    pub(crate) fn points(&self, explosion: Explosion) -> impl Iterator<Item = [f64; 3]> + '_ {
        let center = self.center();
        self.drawables.iter().flat_map(move |d| {
            let moved = self.displacement(d, &explosion, center);
            d.points_drawn().map(move |p| std::array::from_fn(|k| p[k] + moved[k]))
        })
    }

    /// The points of the drawables that are visible with these looks, in the exploded scene.
    #[cfg(feature = "window")]
    pub(crate) fn visible_points<'a>(
        &'a self,
        looks: &'a [Appearance],
        explosion: Explosion,
    ) -> impl Iterator<Item = [f64; 3]> + 'a {
        let center = self.center();
        let visible = self.drawables.iter().zip(looks).filter(|(_, look)| look.visible);
        visible.flat_map(move |(d, _)| {
            let moved = self.displacement(d, &explosion, center);
            d.points_drawn().map(move |p| std::array::from_fn(|k| p[k] + moved[k]))
        })
    }

    /// For each group its centroid after those of the groups around it, outermost first.
    pub(crate) fn centroid_chains(&self) -> Vec<Vec<[f64; 3]>> {
        (0..self.groups.len()).map(|g| self.centroid_chain(GroupId(g as u32))).collect()
    }

    fn centroid_chain(&self, group: GroupId) -> Vec<[f64; 3]> {
        self.around(group).into_iter().map(|g| self.groups[g.0 as usize].centroid).collect()
    }

    /// A group after those around it, outermost first.
    pub(crate) fn around(&self, group: GroupId) -> Vec<GroupId> {
        let parent = |g: &GroupId| self.groups[g.0 as usize].parent;
        let mut chain: Vec<_> = std::iter::successors(Some(group), parent).collect();
        chain.reverse();
        chain
    }
}

/// Point `i` of a set, with coordinates that it lacks 0.
pub(crate) fn point3(points: &Points, i: usize) -> [f64; 3] {
    match *points.point(i) {
        [x, y, z, ..] => [x, y, z],
        [x, y] => [x, y, 0.0],
        [x] => [x, 0.0, 0.0],
        [] => [0.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_bounds(scene: &Scene, explode: [f32; 3], min: [f64; 3], max: [f64; 3]) {
        assert_eq!(scene.bounds(explode), Some(Bounds { min, max }));
    }

    #[test]
    fn groups_move_from_the_centre_of_the_grouped_and_the_rest_stays() {
        let mut scene = Scene::new();
        for x in [-2.0, 2.0] {
            let group = scene.push_group([x, 0.0, 0.0]).unwrap();
            scene
                .push(Drawable::lines("end", [[[x - 1.0, 0., 0.], [x + 1.0, 0., 0.]]]).group(group))
                .unwrap();
        }
        check_bounds(&scene, [1.0; 3], [-3., 0., 0.], [3., 0., 0.]);
        check_bounds(&scene, [2.0, 5.0, 1.0], [-5., 0., 0.], [5., 0., 0.]);
        scene.push(Drawable::points("fixed", [[0., 0., 9.]])).unwrap();
        assert_eq!(scene.center(), [0.0; 3], "what is not grouped has no say");
        check_bounds(&scene, [2.0; 3], [-5., 0., 0.], [5., 0., 9.]);
    }

    #[test]
    fn an_empty_scene_has_no_bounds() {
        assert_eq!(Scene::new().bounds([1.0; 3]), None);
        assert_eq!(Scene::new().center(), [0.0; 3]);
    }

    #[test]
    fn nested_groups_end_at_the_last_level() {
        let mut scene = Scene::new();
        let mut group = scene.push_group([0.0; 3]).unwrap();
        for level in 1..LEVELS {
            group = scene.push_subgroup(group, [level as f64; 3]).unwrap();
        }
        let error = scene.push_subgroup(group, [0.0; 3]).unwrap_err().to_string();
        assert_eq!(error, "group 4 would be nested deeper than 4 levels");
        assert_eq!(scene.centroid_chain(group)[1..], [[1.0; 3], [2.0; 3], [3.0; 3]]);
        assert_eq!(scene.groups().len(), LEVELS);
        let error = scene.push_subgroup(GroupId(9), [0.0; 3]).unwrap_err();
        assert!(matches!(error, ViewerError::GroupOutOfRange { group: 9, .. }), "{error}");
    }
}
