//! Hierarchies embedded into space of higher dimension.

use super::walk::node_path;
use super::{Node, Struct, StructError};
use crate::{AffineError, Model};
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

/// What has been embedded already, by address, so that shared parts stay shared.
#[derive(Default)]
struct Done {
    models: FxHashMap<*const Model, Arc<Model>>,
    structs: FxHashMap<*const Struct, Arc<Struct>>,
}

impl Struct {
    /// The same hierarchy in a space of `dim` coordinates: models get coordinates 0, matrices leave the new
    /// axes alone. Nodes of different dimensions up to `dim` may be mixed. What was shared stays shared.
    /// O(size).
    ///
    /// # Errors
    /// When a node is of higher dimension; its path is named.
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, t};
    /// let plan = Struct::new("plan").with(t(&[2., 0.])).with(cuboid_grid(&[1, 1]));
    /// let house = Struct::new("house").with(plan).with(t(&[0., 0., 3.])).with(cuboid_grid(&[1, 1, 1]));
    /// let placed = house.embedded(3)?.eval_struct()?;
    /// assert_eq!(placed[0].model.points().point(0), [2., 0., 0.]);
    /// # Ok::<(), lar_core::StructError>(())
    /// ```
    #[doc(alias = "embedStruct")]
    pub fn embedded(&self, dim: usize) -> Result<Self, StructError> {
        let mut done = Done::default();
        let mut stack = vec![(self, 0)];
        while let Some((container, next)) = stack.last_mut() {
            let pending = |node: &&Node| {
                node.as_struct().is_some_and(|nested| !done.structs.contains_key(&Arc::as_ptr(nested)))
            };
            let rest = &container.nodes[*next..];
            if let Some(i) = rest.iter().position(|node| pending(&node)) {
                *next += i;
                let nested = rest[i].as_struct().expect("pending nodes are containers");
                stack.push((nested, 0));
                continue;
            }
            let finished = match done.rebuilt(container, dim) {
                Ok(finished) => finished,
                Err((i, source)) => {
                    *next = i;
                    return Err(StructError::Transform { path: node_path(&stack), source });
                }
            };
            let key: *const Self = stack.pop().map_or(self, |(container, _)| container);
            if stack.is_empty() {
                return Ok(finished);
            }
            done.structs.insert(key, Arc::new(finished));
        }
        Ok(self.clone())
    }
}

impl Done {
    /// The container with its entries embedded, nested containers having been done; or the first entry that
    /// cannot be.
    fn rebuilt(&mut self, from: &Struct, dim: usize) -> Result<Struct, (usize, AffineError)> {
        let mut nodes = Vec::with_capacity(from.nodes.len());
        for (i, node) in from.nodes.iter().enumerate() {
            nodes.push(self.embedded(node, dim).map_err(|source| (i, source))?);
        }
        Ok(Struct { name: from.name.clone(), category: from.category.clone(), nodes })
    }

    fn embedded(&mut self, node: &Node, dim: usize) -> Result<Node, AffineError> {
        Ok(match node {
            Node::Transform(map) => Node::Transform(map.embedded(dim)?),
            Node::Struct(nested) => Node::Struct(Arc::clone(&self.structs[&Arc::as_ptr(nested)])),
            Node::Model(name, model) => {
                let embedded = match self.models.entry(Arc::as_ptr(model)) {
                    Entry::Occupied(done) => Arc::clone(done.get()),
                    Entry::Vacant(place) => Arc::clone(place.insert(Arc::new(model.embedded(dim)?))),
                };
                Node::Model(name.clone(), embedded)
            }
        })
    }
}
