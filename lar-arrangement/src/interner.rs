//! Vertices by definition: different definitions of one point become one vertex, by exact equality.

use crate::grid_points::PointTable;
use crate::kernel::{Geometry, Vertex};
use crate::parallel;
use rustc_hash::FxHashMap;

/// All vertices found so far.
#[derive(Debug, Default)]
pub(crate) struct Interner {
    pub vertices: Vec<Vertex>,
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
            return interner;
        }
        for p in 0..n as u32 {
            let vertex = geometry.point_vertex(p);
            if geometry.grid_point(p).is_some() {
                interner.vertices.push(vertex);
                interner.next_at.push(p);
            } else {
                interner.push(vertex);
            }
        }
        interner
    }

    /// Adds a vertex that is known to differ from all others.
    pub(crate) fn push(&mut self, vertex: Vertex) -> u32 {
        let id = self.vertices.len() as u32;
        let first = *self.first_at.entry(key(&vertex)).or_insert(id);
        if first == id {
            self.next_at.push(id);
        } else {
            // Inserted right after the first of its chain.
            let second = self.next_at[first as usize];
            self.next_at.push(if second == first { id } else { second });
            self.next_at[first as usize] = id;
        }
        self.vertices.push(vertex);
        id
    }

    /// The number of the vertex, known or new.
    pub(crate) fn intern(&mut self, vertex: Vertex, geometry: &Geometry) -> u32 {
        let at = vertex.at.map(|x| x as i64);
        if let Some(p) = self.grid_points.find(at, |p| geometry.nearest_grid_point(p))
            && geometry.coincide(&self.vertices[p as usize], &vertex)
        {
            return p;
        }
        if let Some(&first) = self.first_at.get(&key(&vertex)) {
            let mut at = first;
            loop {
                if geometry.coincide(&self.vertices[at as usize], &vertex) {
                    return at;
                }
                let next = self.next_at[at as usize];
                if next == at {
                    break;
                }
                at = next;
            }
        }
        self.push(vertex)
    }
}

/// The position's bits; adding zero makes −0 and 0 one.
fn key(v: &Vertex) -> [u64; 3] {
    v.at.map(|x| (x + 0.0).to_bits())
}
