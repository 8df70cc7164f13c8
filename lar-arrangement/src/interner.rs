//! Vertices of one group of facets: those that are one point become one vertex as they come.

use crate::kernel::{Geometry, Vertex};
use rustc_hash::FxHashMap;

/// Among so many vertices one is looked for without a table.
const FEW: usize = 24;

/// All vertices found so far.
#[derive(Debug, Default)]
pub(crate) struct Interner {
    pub vertices: Vec<Vertex>,
    /// How many of them, the first ones, are in the tables.
    n_entered: usize,
    /// First vertex with a position; the position is correctly rounded, so equal points have equal positions.
    first_at: FxHashMap<[u64; 3], u32>,
    /// Next vertex with the same position, or the vertex itself.
    next_at: Vec<u32>,
}

impl Interner {
    /// Forgets all vertices that were pushed or interned, but keeps their memory.
    pub(crate) fn clear(&mut self) {
        self.vertices.clear();
        self.next_at.clear();
        self.first_at.clear();
        self.n_entered = 0;
    }

    /// Adds a vertex that is known to differ from all others.
    pub(crate) fn push(&mut self, vertex: Vertex) -> u32 {
        self.vertices.push(vertex);
        self.vertices.len() as u32 - 1
    }

    /// Enters the first vertex that is not yet in the tables.
    fn enter(&mut self) {
        let id = self.n_entered as u32;
        self.n_entered += 1;
        let first = *self.first_at.entry(key(&self.vertices[id as usize])).or_insert(id);
        if first == id {
            self.next_at.push(id);
        } else {
            // Inserted right after the first of its chain.
            let second = self.next_at[first as usize];
            self.next_at.push(if second == first { id } else { second });
            self.next_at[first as usize] = id;
        }
    }

    /// The number of the vertex, known or new.
    pub(crate) fn intern(&mut self, vertex: Vertex, geometry: &Geometry) -> u32 {
        self.find(&vertex, geometry).unwrap_or_else(|| self.push(vertex))
    }

    fn find(&mut self, vertex: &Vertex, geometry: &Geometry) -> Option<u32> {
        if self.vertices.len() <= FEW {
            let found = self.vertices.iter().position(|known| geometry.coincide(known, vertex));
            return found.map(|id| id as u32);
        }
        while self.n_entered < self.vertices.len() {
            self.enter();
        }
        let mut at = *self.first_at.get(&key(vertex))?;
        loop {
            if geometry.coincide(&self.vertices[at as usize], vertex) {
                return Some(at);
            }
            let next = self.next_at[at as usize];
            if next == at {
                return None;
            }
            at = next;
        }
    }
}

/// The position's bits; adding zero makes −0 and 0 one.
fn key(v: &Vertex) -> [u64; 3] {
    v.at.map(|x| (x + 0.0).to_bits())
}
