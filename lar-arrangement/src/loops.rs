//! The loops of faces while these are listed one by one, or by all threads in parts.

use crate::parallel;
use lar_core::Cells;

/// Some faces by their loops of half-edges.
#[derive(Debug)]
pub(crate) struct LoopsOfFaces {
    /// Half-edges of each loop.
    pub loops: Cells,
    /// The loops of face f are `face_loops[f]..face_loops[f + 1]`.
    pub face_loops: Vec<u32>,
}

impl LoopsOfFaces {
    /// No faces, with room for some.
    pub(crate) fn with_room(n_faces: usize, n_loops: usize, n_half_edges: usize) -> Self {
        let mut face_loops = Vec::with_capacity(n_faces + 1);
        face_loops.push(0);
        Self { loops: Cells::with_capacity(n_loops, n_half_edges), face_loops }
    }

    /// The next loop of the face at hand.
    pub(crate) fn push(&mut self, half_edges: &[u32]) {
        self.loops.push(half_edges);
    }

    /// A face whose loops are there.
    pub(crate) fn close(&mut self) {
        self.face_loops.push(self.loops.len() as u32);
    }

    /// Adds those of the next faces.
    pub(crate) fn append(&mut self, other: &Self) {
        let n_loops = self.loops.len() as u32;
        let Self { loops, face_loops } = self;
        let mut add_loops = || loops.append(&other.loops);
        let mut add_faces = || face_loops.extend(other.face_loops[1..].iter().map(|l| n_loops + l));
        if other.loops.indices().len() < parallel::LIGHT_CHUNK {
            add_loops();
            add_faces();
        } else {
            parallel::join(add_loops, add_faces);
        }
    }

    /// The faces of all parts, one after the other; best the first has room for the others.
    pub(crate) fn joined(parts: Vec<Self>) -> Self {
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_else(|| Self::with_room(0, 0, 0));
        parts.for_each(|part| all.append(&part));
        all
    }
}
