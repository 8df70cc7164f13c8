//! What a compiler would derive by recursion, done with a stack: dropping, comparing and printing nested
//! containers.

use super::{Node, Struct};
use std::fmt;
use std::sync::Arc;

impl Drop for Struct {
    /// Takes containers that nothing else holds apart level by level.
    fn drop(&mut self) {
        let mut nodes = std::mem::take(&mut self.nodes);
        while let Some(node) = nodes.pop() {
            if let Node::Struct(nested) = node
                && let Some(mut nested) = Arc::into_inner(nested)
            {
                nodes.append(&mut nested.nodes);
            }
        }
    }
}

impl PartialEq for Struct {
    fn eq(&self, other: &Self) -> bool {
        let mut pairs = vec![(self, other)];
        while let Some((a, b)) = pairs.pop() {
            if std::ptr::eq(a, b) {
                continue;
            }
            if (&a.name, &a.category, a.nodes.len()) != (&b.name, &b.category, b.nodes.len()) {
                return false;
            }
            for nodes in a.nodes.iter().zip(&b.nodes) {
                match nodes {
                    (Node::Struct(a), Node::Struct(b)) => pairs.push((a, b)),
                    (a, b) if !equal_leaves(a, b) => return false,
                    _ => {}
                }
            }
        }
        true
    }
}

fn equal_leaves(a: &Node, b: &Node) -> bool {
    match (a, b) {
        (Node::Model(name, a), Node::Model(other, b)) => name == other && (Arc::ptr_eq(a, b) || a == b),
        (Node::Transform(a), Node::Transform(b)) => a == b,
        _ => false,
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Struct(a), Self::Struct(b)) => a == b,
            (a, b) => equal_leaves(a, b),
        }
    }
}

impl fmt::Debug for Struct {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("Struct");
        shown.field("name", &self.name).field("category", &self.category).field("nodes", &self.nodes);
        shown.finish()
    }
}

impl fmt::Debug for Node {
    /// A nested container is shown by its name and size only.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Model(name, model) => {
                f.debug_struct("Model").field("name", name).field("f_vector", &model.f_vector()).finish()
            }
            Self::Transform(map) => f.debug_tuple("Transform").field(map).finish(),
            Self::Struct(nested) => {
                let (name, nodes) = (&nested.name, nested.nodes.len());
                f.debug_struct("Struct").field("name", name).field("nodes", &nodes).finish()
            }
        }
    }
}
