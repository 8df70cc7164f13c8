//! Vertices by definition: different definitions of one point become one vertex, by exact equality.

use crate::grid_points::PointTable;
use crate::kernel::{Geometry, Vertex};
use crate::parallel;
use rustc_hash::FxHashMap;

/// Among so many vertices one is looked for without a table.
const FEW: usize = 24;

/// All vertices found so far.
#[derive(Debug, Default)]
pub(crate) struct Interner {
    pub vertices: Vec<Vertex>,
    /// How many of them, the first ones, are in the tables.
    n_entered: usize,
    /// Points of the input by their coordinates.
    grid_points: PointTable,
    /// First vertex with a position; the position is correctly rounded, so equal points have equal positions.
    first_at: FxHashMap<[u64; 3], u32>,
    /// Next vertex with the same position, or the vertex itself.
    next_at: Vec<u32>,
}

impl Interner {
    /// The points of the input, in their order. Grid points are looked up by their integer coordinates and need no
    /// other keys.
    pub(crate) fn new(geometry: &Geometry, grid_points: PointTable) -> Self {
        let n = geometry.n_points();
        let mut interner = Self {
            vertices: Vec::with_capacity(n + n / 8),
            next_at: Vec::with_capacity(n + n / 8),
            grid_points,
            ..Self::default()
        };
        if geometry.is_on_grid() {
            parallel::extend_light(&mut interner.vertices, n, |p| geometry.point_vertex(p as u32));
            interner.next_at.extend(0..n as u32);
            interner.n_entered = n;
            return interner;
        }
        for p in 0..n as u32 {
            interner.vertices.push(geometry.point_vertex(p));
            if geometry.grid_point(p).is_some() {
                interner.next_at.push(p);
                interner.n_entered += 1;
            } else {
                interner.enter();
            }
        }
        interner
    }

    /// Forgets all vertices that were pushed or interned, but keeps their memory.
    pub(crate) fn clear(&mut self) {
        self.vertices.clear();
        self.next_at.clear();
        self.first_at.clear();
        self.n_entered = 0;
    }

    /// Makes room for so many vertices more.
    pub(crate) fn reserve(&mut self, n: usize) {
        self.vertices.reserve(n);
        self.next_at.reserve(n);
        self.first_at.reserve(n);
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
        let at = vertex.at.map(|x| x as i64);
        if let Some(p) = self.grid_points.find(at, |p| geometry.nearest_grid_point(p))
            && geometry.coincide(&self.vertices[p as usize], vertex)
        {
            return Some(p);
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
