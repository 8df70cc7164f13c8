//! Depth-first walks through a hierarchy, with paths and matrices.

use super::{Node, Struct, StructError};
use crate::Affine;
use std::sync::Arc;

/// One entry of a hierarchy as [`Struct::visit`] meets it.
#[derive(Clone, Copy, Debug)]
pub struct Visit<'a> {
    /// Names from the outermost container down to the entry, joined by `/`; an entry without a name is named
    /// by its position in its container.
    pub path: &'a str,
    /// The number of containers around it, at least 1.
    pub depth: usize,
    /// The container that it stands in.
    pub container: &'a Struct,
    /// The entry.
    pub node: &'a Node,
    /// The product of the matrices that act on it, for a transformation without its own; `None` for a
    /// container or transformation on which none acts.
    pub world_from_local: Option<&'a Affine>,
}

struct Frame<'a> {
    container: &'a Struct,
    /// The next entry.
    next: usize,
    /// The length of the container's own path.
    path_len: usize,
    current: Option<Affine>,
}

impl Struct {
    /// Calls `f` with each entry of the hierarchy, depth-first from left to right, a container before its
    /// contents. No geometry and no matrix of an untouched level is copied; the depth of nesting is not
    /// limited. O(entries · d³ + total length of the names).
    ///
    /// # Errors
    /// When a matrix is singular or not finite, or nodes are of different spaces; entries before it have been
    /// visited.
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, t};
    /// let arm = Struct::new("arm").with_category("tool").with(("hand", cuboid_grid(&[1, 1])));
    /// let mut paths = Vec::new();
    /// Struct::new("robot").with(t(&[1., 0.])).with(arm).visit(|v| paths.push(v.path.to_owned()))?;
    /// assert_eq!(paths, ["robot/0", "robot/arm", "robot/arm/hand"]);
    /// # Ok::<(), lar_core::StructError>(())
    /// ```
    pub fn visit(&self, mut f: impl FnMut(Visit<'_>)) -> Result<(), StructError> {
        let mut path = self.name.clone();
        let mut dim = None;
        let mut stack = vec![Frame { container: self, next: 0, path_len: path.len(), current: None }];
        while let Some(frame) = stack.last_mut() {
            path.truncate(frame.path_len);
            let Some(node) = frame.container.nodes.get(frame.next) else {
                stack.pop();
                continue;
            };
            push_name(&mut path, name(node), frame.next);
            frame.next += 1;
            let (depth, container) = (stack.len(), stack[stack.len() - 1].container);
            let current = &mut stack.last_mut().expect("a frame was just seen").current;
            if let Some(found) = node_dim(node) {
                same_space(&mut dim, &path, found)?;
            }
            let unmoved = match (node, &current) {
                (Node::Model(_, model), None) => Some(Affine::identity(model.points().dim())),
                _ => None,
            };
            let world_from_local = current.as_ref().or(unmoved.as_ref());
            f(Visit { path: &path, depth, container, node, world_from_local });
            match node {
                Node::Model(..) => {}
                Node::Transform(map) => *current = Some(advance(current.take(), map, &path)?),
                Node::Struct(nested) => {
                    let current = current.clone();
                    stack.push(Frame { container: nested, next: 0, path_len: path.len(), current });
                }
            }
        }
        Ok(())
    }
}

/// The path of an entry from the containers around it, outermost first, each with the position of the next.
pub(super) fn node_path(way: &[(&Struct, usize)]) -> String {
    let mut path = way.first().map_or_else(String::new, |(container, _)| container.name.clone());
    for (container, i) in way {
        push_name(&mut path, container.nodes.get(*i).and_then(name), *i);
    }
    path
}

fn name(node: &Node) -> Option<&str> {
    match node {
        Node::Model(name, _) => name.as_deref(),
        Node::Transform(_) => None,
        Node::Struct(nested) => Some(&nested.name),
    }
}

fn node_dim(node: &Node) -> Option<usize> {
    match node {
        Node::Model(_, model) => Some(model.points().dim()),
        Node::Transform(map) => Some(map.dim()),
        Node::Struct(_) => None,
    }
}

/// Appends `/name`, or `/i` for what has no name.
fn push_name(path: &mut String, name: Option<&str>, i: usize) {
    path.push('/');
    match name {
        Some(name) if !name.is_empty() => path.push_str(name),
        _ => path.push_str(&i.to_string()),
    }
}

fn same_space(dim: &mut Option<usize>, path: &str, found: usize) -> Result<(), StructError> {
    let expected = *dim.get_or_insert(found);
    if found == expected {
        Ok(())
    } else {
        Err(StructError::Dimension { path: path.to_owned(), expected, found })
    }
}

/// The current matrix after `map`: `map` acts first on what follows, then the matrices left of it.
fn advance(current: Option<Affine>, map: &Affine, path: &str) -> Result<Affine, StructError> {
    let product = || match current {
        Some(current) => current.compose(map),
        None => Ok(map.clone()),
    };
    let regular = |map: Affine| map.check_regular().map(|()| map);
    map.check_regular()
        .and_then(|()| product())
        .and_then(regular)
        .map_err(|source| StructError::Transform { path: path.to_owned(), source })
}

impl Node {
    /// The container, when the entry is one.
    pub(super) fn as_struct(&self) -> Option<&Arc<Struct>> {
        if let Self::Struct(nested) = self { Some(nested) } else { None }
    }
}
