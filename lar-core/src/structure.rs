//! Hierarchies: containers of models, transformations and other containers.
//!
//! A [`Struct`] is the scene description of PHIGS: inside one container, each matrix acts on everything to
//! its right, and a nested container starts from the matrix current where it stands and leaves it unchanged.
//! Models are held by `Arc`, so a thousand instances share one geometry until they are evaluated.
//!
//! Nothing here recurses: containers may be nested as deep as memory allows.

mod embed;
mod nested;
mod walk;

pub use walk::Visit;

use crate::{Affine, AffineError, Cells, Model, ModelError, Points, Surface};
use std::sync::Arc;

/// A named container of models, transformations and containers.
///
/// ```
/// use lar_core::{Struct, cuboid_grid, r, t};
/// let cube = cuboid_grid(&[1, 1, 1]);
/// let scene = Struct::new("scene")
///     .with(("A", cube.clone()))
///     .with(t(&[0., 0., 0.5]))
///     .with(r([0., 0., 0.1]))
///     .with(("B", cube));
/// let placed = scene.eval_struct().unwrap();
/// assert_eq!(placed[1].path, "scene/B");
/// assert_eq!(placed[1].model.points().point(0), [0., 0., 0.5]);
/// ```
#[derive(Clone)]
pub struct Struct {
    name: String,
    category: String,
    nodes: Vec<Node>,
}

/// One entry of a [`Struct`]. Two entries are equal when their contents are, shared or not.
#[derive(Clone)]
#[non_exhaustive]
pub enum Node {
    /// Geometry; its name, or its position in the container, ends its path.
    Model(Option<String>, Arc<Model>),
    /// A map for everything to the right in the same container.
    Transform(Affine),
    /// A nested container.
    Struct(Arc<Struct>),
}

/// One occurrence of a model: shared geometry and the matrix that places it.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Names from the outermost container down to the model, joined by `/`.
    pub path: String,
    /// The geometry, in its own coordinates.
    pub model: Arc<Model>,
    /// The product of the matrices met on the way: world from local.
    pub world_from_local: Affine,
}

/// Lower and upper corner of a box, d coordinates each.
pub type Corners = (Vec<f64>, Vec<f64>);

/// A model in the coordinates of the outermost container.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedModel {
    /// Names from the outermost container down to the model, joined by `/`.
    pub path: String,
    /// The model in world coordinates.
    pub model: Model,
}

impl PlacedModel {
    /// The last part of the path.
    #[must_use]
    pub fn name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or(&self.path)
    }

    /// The surface of the model, named by its path.
    ///
    /// # Errors
    /// As [`Model::to_surface`].
    pub fn to_surface(&self) -> Result<Surface, ModelError> {
        self.model.to_surface(&self.path)
    }
}

/// Why a hierarchy cannot be evaluated; each names the path of the node.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructError {
    /// A transformation, or its product with those before it, is singular, or has entries that are infinite
    /// or not numbers.
    #[error("{path}: {source}")]
    Transform {
        /// The node.
        path: String,
        /// What is wrong with its matrix.
        source: AffineError,
    },
    /// A node is of another space than those before it.
    #[error("{path}: of {found}-space among nodes of {expected}-space")]
    Dimension {
        /// The node.
        path: String,
        /// The dimension of the nodes before it.
        expected: usize,
        /// Its own dimension.
        found: usize,
    },
    /// The flattened model would have more vertices or cell entries than `u32` can number.
    #[error("{path}: more than 2^32 vertices or cell entries in all")]
    TooLarge {
        /// The node at which the limit is passed.
        path: String,
    },
}

impl Struct {
    /// An empty container.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), category: String::new(), nodes: Vec::new() }
    }

    /// A container of the given entries.
    #[must_use]
    pub fn from_nodes(name: impl Into<String>, nodes: impl IntoIterator<Item = Node>) -> Self {
        Self { name: name.into(), category: String::new(), nodes: nodes.into_iter().collect() }
    }

    /// The container with one more entry at its right end: a model (alone or with a name), an [`Affine`] or a
    /// `Struct`.
    #[must_use]
    pub fn with(mut self, node: impl Into<Node>) -> Self {
        self.nodes.push(node.into());
        self
    }

    /// Appends an entry at the right end.
    pub fn push(&mut self, node: impl Into<Node>) {
        self.nodes.push(node.into());
    }

    /// The name of the container.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The container with a category: a word for what kind of part it is.
    ///
    /// ```
    /// use lar_core::Struct;
    /// assert_eq!(Struct::new("chair 1").with_category("chair").category(), "chair");
    /// assert_eq!(Struct::new("scene").category(), "");
    /// ```
    #[must_use]
    pub fn with_category(mut self, category: impl Into<String>) -> Self {
        self.category = category.into();
        self
    }

    /// The category of the container, empty when none was given.
    #[must_use]
    pub fn category(&self) -> &str {
        &self.category
    }

    /// The entries, left to right.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Every model of the hierarchy in depth-first order from left to right, with the matrix that places it.
    /// No geometry is copied. O(instances).
    ///
    /// # Errors
    /// When a matrix is singular or not finite, or nodes are of different spaces.
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, s, t};
    /// let cube = cuboid_grid(&[1, 1, 1]);
    /// let scene = Struct::new("scene").with(t(&[1., 0., 0.])).with(cube.clone()).with(s(&[2.; 3])).with(cube);
    /// let instances = scene.traversal().unwrap();
    /// assert_eq!(instances[0].world_from_local, t(&[1., 0., 0.]));
    /// ```
    pub fn traversal(&self) -> Result<Vec<Instance>, StructError> {
        let mut found = Vec::new();
        self.visit(|visit| {
            if let (Node::Model(_, model), Some(map)) = (visit.node, visit.world_from_local) {
                let (path, model) = (visit.path.to_owned(), Arc::clone(model));
                found.push(Instance { path, model, world_from_local: map.clone() });
            }
        })?;
        Ok(found)
    }

    /// Lower and upper corner of the box around all models in world coordinates, points of no cell included;
    /// `None` when there are no points. O(points).
    ///
    /// # Errors
    /// As [`traversal`](Self::traversal).
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, t};
    /// let scene = Struct::new("s").with(cuboid_grid(&[1, 1])).with(t(&[3., -2.])).with(cuboid_grid(&[1, 1]));
    /// assert_eq!(scene.bounds()?, Some((vec![0., -2.], vec![4., 1.])));
    /// # Ok::<(), lar_core::StructError>(())
    /// ```
    #[doc(alias = "box")]
    pub fn bounds(&self) -> Result<Option<Corners>, StructError> {
        let mut all: Option<Corners> = None;
        for instance in self.traversal()? {
            let moved = instance.world_from_local.apply(instance.model.points());
            let moved = moved.map_err(|source| StructError::Transform { path: instance.path, source })?;
            let Some((lo, hi)) = moved.bounds() else { continue };
            let (all_lo, all_hi) = all.get_or_insert_with(|| (lo.clone(), hi.clone()));
            for k in 0..lo.len() {
                all_lo[k] = all_lo[k].min(lo[k]);
                all_hi[k] = all_hi[k].max(hi[k]);
            }
        }
        Ok(all)
    }

    /// Every model of the hierarchy in world coordinates, in the order of [`traversal`](Self::traversal).
    /// O(size of the result).
    ///
    /// # Errors
    /// As [`traversal`](Self::traversal).
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, s, t};
    /// let cube = cuboid_grid(&[1, 1, 1]);
    /// let scene = Struct::new("scene").with(t(&[1., 0., 0.])).with(cube.clone()).with(s(&[2.; 3])).with(cube);
    /// let placed = scene.eval_struct().unwrap();
    /// assert_eq!(placed[1].model.points().point(7), [3., 2., 2.]);
    /// ```
    #[doc(alias = "evalStruct")]
    pub fn eval_struct(&self) -> Result<Vec<PlacedModel>, StructError> {
        let place = |instance: Instance| match instance.model.transformed(&instance.world_from_local) {
            Ok(model) => Ok(PlacedModel { path: instance.path, model }),
            Err(source) => Err(StructError::Transform { path: instance.path, source }),
        };
        self.traversal()?.into_iter().map(place).collect()
    }

    /// All models of the hierarchy as one: points and cells of each dimension one model after the other.
    /// Points that coincide are kept apart; [`Model::welded`] merges those that are exactly equal, an
    /// arrangement all that should be. O(size of the result).
    ///
    /// # Errors
    /// As [`traversal`](Self::traversal), and when `u32` cannot number the result.
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, s, t};
    /// let cube = cuboid_grid(&[1, 1, 1]);
    /// let scene = Struct::new("scene").with(t(&[1., 0., 0.])).with(cube.clone()).with(s(&[2.; 3])).with(cube);
    /// assert_eq!(scene.struct2lar().unwrap().f_vector(), [16, 24, 12, 2]);
    /// ```
    pub fn struct2lar(&self) -> Result<Model, StructError> {
        let placed = self.eval_struct()?;
        let dim = placed.first().map_or(0, |p| p.model.points().dim());
        let mut coords = Vec::new();
        let mut cells: Vec<Cells> = Vec::new();
        for PlacedModel { path, model } in placed {
            let first = coords.len().checked_div(dim).unwrap_or(0);
            let too_large = || StructError::TooLarge { path: path.clone() };
            let shift = u32::try_from(first).map_err(|_| too_large())?;
            u32::try_from(first + model.points().len()).map_err(|_| too_large())?;
            let (points, skeletons) = model.into_parts();
            coords.extend_from_slice(points.coords());
            cells.resize(cells.len().max(skeletons.len()), Cells::new());
            for (all, more) in cells.iter_mut().zip(&skeletons) {
                append(all, more, shift).ok_or_else(too_large)?;
            }
        }
        Ok(Model::new(Points::from_columns(dim, coords), cells))
    }
}

/// Appends cells with their vertices raised by `shift`; `None` when `u32` does not reach.
fn append(all: &mut Cells, more: &Cells, shift: u32) -> Option<()> {
    u32::try_from(all.indices().len() + more.indices().len()).ok()?;
    for cell in more.iter() {
        let shifted: Option<Vec<u32>> = cell.iter().map(|v| v.checked_add(shift)).collect();
        all.push(&shifted?);
    }
    Some(())
}

impl From<Affine> for Node {
    fn from(map: Affine) -> Self {
        Self::Transform(map)
    }
}

impl From<Struct> for Node {
    fn from(nested: Struct) -> Self {
        Self::Struct(Arc::new(nested))
    }
}

impl From<Arc<Struct>> for Node {
    fn from(nested: Arc<Struct>) -> Self {
        Self::Struct(nested)
    }
}

impl From<Model> for Node {
    fn from(model: Model) -> Self {
        Self::Model(None, Arc::new(model))
    }
}

impl From<Arc<Model>> for Node {
    fn from(model: Arc<Model>) -> Self {
        Self::Model(None, model)
    }
}

impl<N: Into<String>, M: Into<Arc<Model>>> From<(N, M)> for Node {
    fn from((name, model): (N, M)) -> Self {
        Self::Model(Some(name.into()), model.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cuboid_grid, r, s, t};
    use std::f64::consts::FRAC_PI_2;

    fn segment() -> Arc<Model> {
        Arc::new(cuboid_grid(&[1, 0]))
    }

    /// Path and the two rounded ends of each segment.
    #[track_caller]
    fn check(scene: &Struct, expected: &[(&str, [i64; 4])]) {
        let ends = |p: &PlacedModel| -> Vec<i64> {
            #[expect(clippy::cast_possible_truncation, reason = "small whole coordinates")]
            p.model.points().coords().iter().map(|x| x.round() as i64).collect()
        };
        let placed = scene.eval_struct().unwrap();
        let found: Vec<_> = placed.iter().map(|p| (p.path.as_str(), ends(p))).collect();
        let expected: Vec<_> = expected.iter().map(|(path, e)| (*path, e.to_vec())).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn matrices_act_on_everything_to_their_right() {
        let scene = Struct::new("s")
            .with(segment())
            .with(t(&[1., 0.]))
            .with(("b", segment()))
            .with(r(FRAC_PI_2))
            .with(segment())
            .with(t(&[1., 0.]))
            .with(segment());
        check(
            &scene,
            &[("s/0", [0, 0, 1, 0]), ("s/b", [1, 0, 2, 0]), ("s/4", [1, 0, 1, 1]), ("s/6", [1, 1, 1, 2])],
        );
    }

    #[test]
    fn nested_containers_keep_their_matrices_to_themselves() {
        let arm = Struct::new("arm").with(t(&[0., 5.])).with(segment());
        let scene = Struct::new("s")
            .with(t(&[10., 0.]))
            .with(arm.clone())
            .with(segment())
            .with(s(&[2., 2.]))
            .with(arm);
        check(&scene, &[("s/arm/1", [10, 5, 11, 5]), ("s/2", [10, 0, 11, 0]), ("s/arm/1", [10, 10, 12, 10])]);
    }

    #[test]
    fn instances_share_their_geometry() {
        let model = segment();
        let scene = Struct::from_nodes("s", (0..100).map(|_| Node::from(Arc::clone(&model))));
        assert!(scene.traversal().unwrap().iter().all(|i| Arc::ptr_eq(&i.model, &model)));
    }

    #[test]
    fn flattening_shifts_the_cells() {
        let scene = Struct::new("s").with(cuboid_grid(&[1, 1])).with(t(&[3., 0.])).with(segment());
        let flat = scene.struct2lar().unwrap();
        assert_eq!(flat.f_vector(), [6, 5, 1]);
        assert_eq!(&flat.cells(1)[4], [4, 5]);
        assert_eq!(flat.points().point(5), [4., 0.]);
        assert_eq!(flat.validate(), []);
        assert_eq!(Struct::new("empty").struct2lar().unwrap().f_vector(), [0_usize; 0]);
    }

    #[track_caller]
    fn refused(scene: &Struct, message: &str) {
        assert_eq!(scene.eval_struct().unwrap_err().to_string(), message);
    }

    #[test]
    fn refusals_name_the_node() {
        let inner = Struct::new("inner").with(segment()).with(s(&[1., 0.])).with(segment());
        refused(&Struct::new("s").with(segment()).with(inner), "s/inner/1: the matrix is singular");
        refused(
            &Struct::new("s").with(segment()).with(t(&[0., 0., 1.])).with(segment()),
            "s/1: of 3-space among nodes of 2-space",
        );
        refused(
            &Struct::new("s").with(t(&[0., 0., 1.])).with(("flat", segment())),
            "s/flat: of 2-space among nodes of 3-space",
        );
        refused(&Struct::new("s").with(t(&[f64::NAN, 0.])), "s/0: entry (0, 2) is NaN");
        let tiny = s(&[1e-200, 1e-200]);
        refused(&Struct::new("s").with(tiny.clone()).with(tiny), "s/1: the matrix is singular");
    }
}
