//! The boundary of each face of a complex as closed loops of vertices, read off ∂1 and ∂2.
//!
//! `ChainComplex::face_loops` gives the loops of one face of a complex that is known to be valid. Here all faces are
//! read, into flat arrays and with the outer loop first, and a complex that is not valid is refused with the cell
//! that is wrong.

use crate::TriangulateError;
use crate::flat::newell;
use crate::parallel;
use lar_core::{Cells, ChainComplex, EdgeId, FaceId, Operator, VertexId};
use std::ops::Range;

/// The boundary loops of all faces. `loops[l]` lists the vertices of loop l in the direction of ∂2;
/// `face_offsets[f]..face_offsets[f + 1]` are the loops of face f, the one with the largest area first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaceLoops {
    loops: Cells,
    face_offsets: Vec<u32>,
}

impl FaceLoops {
    /// The loops of each face of a complex of dimension 2 or more.
    ///
    /// A boundary that visits a vertex several times is cut into loops there, so that no loop visits a vertex
    /// twice. Time and memory O(faces + edges of faces), but for sorting the edges of one face; by the threads of the current pool.
    ///
    /// # Errors
    /// [`TriangulateError::ComplexDimension`], [`TriangulateError::Shape`], [`TriangulateError::BadEdge`] and
    /// [`TriangulateError::OpenFace`], when the complex is not one.
    ///
    /// ```
    /// use lar_core::{ChainComplex, FaceId, cuboid_grid};
    /// let square = ChainComplex::from_model(&cuboid_grid(&[1, 1])).unwrap();
    /// let loops = lar_triangle::FaceLoops::new(&square)?;
    /// assert_eq!(loops.face(FaceId(0)).collect::<Vec<_>>(), [[0, 2, 3, 1]]);
    /// # Ok::<(), lar_triangle::TriangulateError>(())
    /// ```
    pub fn new(complex: &ChainComplex) -> Result<Self, TriangulateError> {
        let edges = edge_ends(complex)?;
        let faces = columns(complex, 2)?;
        let parts = parallel::map_parts(faces.cols(), |part| Self::of_part(complex, &edges, &faces, part))?;
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_default();
        parts.for_each(|part| all.append(&part));
        Ok(all)
    }

    fn of_part(
        complex: &ChainComplex,
        edges: &[(u32, u32)],
        faces: &Operator,
        part: Range<usize>,
    ) -> Result<Self, TriangulateError> {
        let n_arcs = faces.indptr().index(part.end) - faces.indptr().index(part.start);
        let mut all =
            Self { loops: Cells::with_capacity(part.len(), n_arcs as usize), face_offsets: vec![0] };
        let mut walk = Walk::default();
        for (f, column) in part.filter_map(|f| Some((FaceId(f as u32), faces.outer_view(f)?))) {
            walk.arcs.clear();
            for (e, &sign) in column.iter() {
                let (tail, head) = edges[e];
                // An edge with another coefficient than ±1 leaves the boundary open unless repeated so often.
                for _ in 0..sign.unsigned_abs() {
                    walk.arcs.push(if sign > 0 { (tail, head) } else { (head, tail) });
                }
            }
            walk.arcs.sort_unstable();
            if let Some(triangle) = walk.triangle() {
                all.loops.push(&triangle);
                all.face_offsets.push(all.loops.len() as u32);
                continue;
            }
            walk.check(f)?;
            walk.cut();
            walk.outer_first(complex);
            all.loops_of_face(&walk);
        }
        Ok(all)
    }

    /// Adds the faces of another, behind its own.
    fn append(&mut self, other: &Self) {
        let begin = self.loops.len() as u32;
        self.loops.append(&other.loops);
        self.face_offsets.extend(other.face_offsets[1..].iter().map(|end| begin + end));
    }

    fn loops_of_face(&mut self, walk: &Walk) {
        for range in &walk.found {
            self.loops.push(&walk.vertices[range.clone()]);
        }
        self.face_offsets.push(self.loops.len() as u32);
    }

    /// Number of faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.face_offsets.len().saturating_sub(1)
    }

    /// The loops of a face, the outer one first; none for a face that does not exist.
    pub fn face(&self, f: FaceId) -> impl ExactSizeIterator<Item = &[u32]> + Clone + '_ {
        let end = self.face_offsets.get(f.index() + 1);
        let range = end.map_or(0..0, |&end| self.face_offsets[f.index()]..end);
        range.map(|l| &self.loops[l as usize])
    }

    /// The directed boundary edges of a face, loop after loop.
    pub fn face_edges(&self, f: FaceId) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.face(f).flat_map(|cycle| {
            let next = cycle.iter().skip(1).chain(cycle.first());
            cycle.iter().zip(next).map(|(&from, &to)| [from, to])
        })
    }
}

/// Tail and head of each edge.
fn edge_ends(complex: &ChainComplex) -> Result<Vec<(u32, u32)>, TriangulateError> {
    if complex.dim() < 2 {
        return Err(TriangulateError::ComplexDimension { dim: complex.dim(), needed: 2 });
    }
    let columns = columns(complex, 1)?;
    let parts = parallel::map_parts(columns.cols(), |part| {
        let mut ends = Vec::with_capacity(part.len());
        for (e, column) in part.filter_map(|e| Some((EdgeId(e as u32), columns.outer_view(e)?))) {
            let ((&[tail, head], [-1, 1]) | (&[head, tail], [1, -1])) = (column.indices(), column.data())
            else {
                let entries = column.iter().map(|(i, &x)| (i as u32, x)).collect();
                return Err(TriangulateError::BadEdge { edge: e, entries });
            };
            ends.push((tail, head));
        }
        Ok(ends)
    })?;
    Ok(parts.concat())
}

/// ∂p by columns.
pub(crate) fn columns(
    complex: &ChainComplex,
    p: usize,
) -> Result<std::borrow::Cow<'_, Operator>, TriangulateError> {
    if complex.dim() < p {
        return Err(TriangulateError::ComplexDimension { dim: complex.dim(), needed: p });
    }
    let (operator, cells) = (complex.boundary(p), complex.n_cells(p - 1));
    if operator.rows() != cells {
        return Err(TriangulateError::Shape { p, rows: operator.rows(), cells });
    }
    Ok(if operator.is_csc() {
        std::borrow::Cow::Borrowed(operator)
    } else {
        std::borrow::Cow::Owned(operator.to_csc())
    })
}

/// Buffers for walking the boundary of one face.
#[derive(Default)]
struct Walk {
    /// Directed edges, sorted by their tail.
    arcs: Vec<(u32, u32)>,
    heads: Vec<u32>,
    used: Vec<bool>,
    path: Vec<u32>,
    /// Where the path visits the tail of each run of arcs; indexed by the run's first arc.
    on_path: Vec<Option<usize>>,
    vertices: Vec<u32>,
    found: Vec<Range<usize>>,
    polygon: Vec<[f64; 3]>,
}

impl Walk {
    /// The loop of three arcs that make one.
    fn triangle(&self) -> Option<[u32; 3]> {
        let &[(a, to_a), (b, to_b), (c, to_c)] = &self.arcs[..] else { return None };
        match [to_a, to_b, to_c] {
            heads if heads == [b, c, a] => Some([a, b, c]),
            heads if heads == [c, a, b] => Some([a, c, b]),
            _ => None,
        }
        .filter(|_| a < b && b < c)
    }

    /// Checks that every vertex is entered as often as it is left.
    fn check(&mut self, face: FaceId) -> Result<(), TriangulateError> {
        self.heads.clear();
        self.heads.extend(self.arcs.iter().map(|a| a.1));
        self.heads.sort_unstable();
        let Some(at) = self.arcs.iter().zip(&self.heads).position(|(a, h)| a.0 != *h) else { return Ok(()) };
        let vertex = self.arcs[at].0.min(self.heads[at]);
        let entering = self.heads.iter().filter(|&&h| h == vertex).count();
        let leaving = self.arcs.iter().filter(|a| a.0 == vertex).count();
        Err(TriangulateError::OpenFace { face, vertex: VertexId(vertex), entering, leaving })
    }

    /// Cuts the arcs into loops without repeated vertices, into `vertices` and `found`.
    fn cut(&mut self) {
        self.vertices.clear();
        self.found.clear();
        self.used.clear();
        self.used.resize(self.arcs.len(), false);
        self.on_path.clear();
        self.on_path.resize(self.arcs.len(), None);
        for first in 0..self.arcs.len() {
            let mut next = (!self.used[first]).then_some(first);
            while let Some(arc) = next {
                next = self.step(arc);
            }
            debug_assert!(self.path.is_empty(), "a closed walk ends where it began");
        }
    }

    /// Walks one arc, cuts a loop off when its head is on the path, and finds the arc to go on with.
    fn step(&mut self, arc: usize) -> Option<usize> {
        self.used[arc] = true;
        let (tail, head) = self.arcs[arc];
        let run = self.run(tail);
        self.on_path[run] = Some(self.path.len());
        self.path.push(tail);
        let run = self.run(head);
        if let Some(start) = self.on_path[run] {
            for k in start..self.path.len() {
                let visited = self.run(self.path[k]);
                self.on_path[visited] = None;
            }
            let begin = self.vertices.len();
            self.vertices.extend(self.path.drain(start..));
            self.found.push(begin..self.vertices.len());
            if self.path.is_empty() {
                return None;
            }
        }
        (run..self.arcs.len()).take_while(|&k| self.arcs[k].0 == head).find(|&k| !self.used[k])
    }

    /// The first arc that leaves a vertex.
    fn run(&self, vertex: u32) -> usize {
        self.arcs.partition_point(|a| a.0 < vertex)
    }

    /// Brings the loop with the largest area to the front.
    fn outer_first(&mut self, complex: &ChainComplex) {
        if self.found.len() < 2 {
            return;
        }
        let mut best = (0, f64::NEG_INFINITY);
        for (l, range) in self.found.iter().enumerate() {
            self.polygon.clear();
            self.polygon.extend(self.vertices[range.clone()].iter().map(|&v| {
                let mut at = [0.0; 3];
                at.iter_mut().zip(complex.points().point(v as usize)).for_each(|(to, &x)| *to = x);
                at
            }));
            let size: f64 = newell(&self.polygon).iter().map(|x| x * x).sum();
            if best.1 < size {
                best = (l, size);
            }
        }
        self.found[..=best.0].rotate_right(1);
    }
}
