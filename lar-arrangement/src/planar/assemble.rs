//! Planar stage 5: the chain complex from edges and faces.

use crate::boxes::bits_of;
use crate::counting::offsets_of;
use crate::grid::Grid;
use crate::operators::boundary_1;
use crate::parallel;
use crate::planar::carriers::Carriers;
use crate::planar::chains::Chains;
use crate::planar::edges::Edges;
use crate::planar::positions::lengths;
use crate::planar::result::PlanarArrangement;
use crate::stats::Stats;
use crate::subdivision::Subdivision;
use crate::winding::Windings;
use lar_core::{Cells, ChainComplex, Points};
use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// `positions` are those of all vertices of the chains, in grid steps; vertices without edges are left out.
pub(crate) fn assemble(
    positions: Vec<[f64; 2]>,
    mut edges: Edges,
    subdivision: Subdivision,
    mut chains: Chains,
    carriers: Carriers,
    grid: Grid,
) -> PlanarArrangement {
    let n_components = subdivision.n_components;
    let (n_edges, n_vertices) = (edges.ends.len(), positions.len());
    let Faces { loops, face_loops, columns, signs } = Faces::new(&edges.ends, subdivision);
    let is_used = (n_edges < chains.n_edges()).then(|| edges.number_vertices(n_vertices));
    let Edges { mut ends, edge_at, runs, run_of: mut carrier_of } = edges;
    let n_used = is_used.as_ref().map_or(n_vertices, |is_used| is_used.iter().filter(|&&used| used).count());
    // To check an operator keeps one thread busy for long. What all can share comes last.
    let (boundary_2, (boundary_1, points)) = parallel::join(
        || ChainComplex::operator_from_columns(n_edges, columns, signs),
        || {
            parallel::each_chunk(&mut ends, |_, part| part.iter_mut().for_each(|ends| ends.sort_unstable()));
            let boundary_1 = boundary_1(n_used, ends);
            let mut positions = lengths(&grid, &carriers, &chains, positions);
            if let Some(is_used) = &is_used {
                retain(&mut positions, is_used);
            }
            parallel::each_chunk(&mut carrier_of, |_, part| {
                part.iter_mut().for_each(|run| *run = runs[*run as usize].carrier);
            });
            (boundary_1, Points::from_columns(2, positions.into_flattened()))
        },
    );
    let mut sources = std::mem::take(&mut chains.vertices);
    if let Some(is_used) = &is_used {
        retain(&mut sources, is_used);
    }
    PlanarArrangement {
        complex: ChainComplex::new(points, vec![boundary_1, boundary_2]),
        loops,
        face_loops,
        n_components,
        carriers,
        chains,
        sources,
        grid,
        index: OnceLock::new(),
        edge_at,
        carrier_of,
        regions: Vec::new(),
        windings: Windings::default(),
        isolated: Vec::new(),
        stats: Stats::default(),
    }
}

fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    items.retain(|_| *keep.next().expect("one flag an item"));
}

impl Edges {
    /// Numbers the vertices that have edges, in their order; returns which have.
    fn number_vertices(&mut self, n: usize) -> Vec<bool> {
        let mut is_used = vec![false; n];
        self.ends.as_flattened().iter().for_each(|&v| is_used[v as usize] = true);
        let mut n_used = 0;
        let new: Vec<u32> = is_used
            .iter()
            .map(|&used| {
                n_used += u32::from(used);
                n_used.wrapping_sub(1)
            })
            .collect();
        self.ends.as_flattened_mut().iter_mut().for_each(|v| *v = new[*v as usize]);
        is_used
    }
}

/// The loops of all faces and the columns of ∂2.
struct Faces {
    loops: Cells,
    face_loops: Vec<u32>,
    columns: Cells,
    signs: Vec<i8>,
}

/// So many faces are filled in at a time.
const CHUNK: usize = 4096;

impl Faces {
    /// The lengths of all loops and columns first, then all of them in their places.
    fn new(ends: &[[u32; 2]], subdivision: Subdivision) -> Self {
        let loops = Loops::new(ends, &subdivision);
        let columns = loops.columns(&subdivision);
        let large = loops.large_columns(&subdivision, &columns);
        let Subdivision { cycles, cycles_of_face, .. } = subdivision;
        drop(cycles.of);
        // In the memory of all cycles, which are no shorter than all columns.
        let n_faces = columns.len() - 1;
        let mut rows = cycles.list.into_parts().1;
        rows.truncate(columns[n_faces] as usize);
        rows.shrink_to_fit();
        let mut signs = parallel::zeros(rows.len());
        let (n_chunks, range) = parallel::chunks(n_faces, CHUNK);
        let n_rows = |chunk| (columns[range(chunk).end] - columns[range(chunk).start]) as usize;
        let parts = parallel::cut(&mut rows, (0..n_chunks).map(n_rows)).into_iter();
        let parts = parts.zip(parallel::cut(&mut signs, (0..n_chunks).map(n_rows)));
        parallel::each(parts.enumerate().collect(), |(chunk, (mut rows, mut signs))| {
            for face in range(chunk) {
                let size = (columns[face + 1] - columns[face]) as usize;
                let (rows, signs) = (take(&mut rows, size), take(&mut signs, size));
                match large.iter().find(|(large, _)| *large == face) {
                    Some((_, column)) => rows.copy_from_slice(column),
                    None => loops.fill_column(face, rows),
                }
                for (h, sign) in rows.iter_mut().zip(signs) {
                    *sign = if *h % 2 == 0 { 1 } else { -1 };
                    *h /= 2;
                }
            }
        });
        Self {
            loops: Cells::from_parts(loops.offsets, loops.half_edges),
            face_loops: cycles_of_face.into_parts().0,
            columns: Cells::from_parts(columns, rows),
            signs,
        }
    }
}

/// One bit for each edge: they stay in the processor's cache.
struct EdgeBits(Vec<u64>);

impl EdgeBits {
    fn new(n_edges: usize, bit: impl Fn(usize) -> bool + Sync + Send) -> Self {
        let word = |i: usize| {
            (64 * i..n_edges.min(64 * i + 64))
                .fold(0, |bits, edge| bits | u64::from(bit(edge)) << (edge % 64))
        };
        Self(parallel::map_light(n_edges.div_ceil(64), word))
    }

    fn of(&self, edge: u32) -> bool {
        self.0[edge as usize / 64] >> (edge % 64) & 1 != 0
    }
}

/// The half-edges of the loops of all faces.
struct Loops {
    offsets: Vec<u32>,
    /// From the smaller vertex of an edge to the larger, or back.
    half_edges: Vec<u32>,
    /// Where the loops of each face begin in `half_edges`.
    begins: Vec<u32>,
    /// The edges that lead along their carriers from the larger vertex to the smaller.
    turned: EdgeBits,
    /// The edges with one face on both sides: what is on both their sides is one cycle, as the edge joins what is on
    /// both its ends.
    dangling: EdgeBits,
}

impl Loops {
    fn new(ends: &[[u32; 2]], subdivision: &Subdivision) -> Self {
        let turned = EdgeBits::new(ends.len(), |edge| ends[edge][0] > ends[edge][1]);
        let cycle_of = &subdivision.cycles.of;
        let dangling = EdgeBits::new(ends.len(), |edge| cycle_of[2 * edge] == cycle_of[2 * edge + 1]);
        let cycles = subdivision.cycles_of_face.indices();
        let offsets = offsets_of(cycles.len(), |i| subdivision.cycle(cycles[i]).len() as u32);
        let mut half_edges = parallel::zeros(offsets[cycles.len()] as usize);
        let (n_chunks, range) = parallel::chunks(cycles.len(), CHUNK);
        let length = |chunk| (offsets[range(chunk).end] - offsets[range(chunk).start]) as usize;
        let parts = parallel::cut(&mut half_edges, (0..n_chunks).map(length));
        parallel::each(parts.into_iter().enumerate().collect(), |(chunk, part)| {
            let from = cycles[range(chunk)].iter().flat_map(|&cycle| subdivision.cycle(cycle));
            part.iter_mut().zip(from).for_each(|(to, &h)| *to = h ^ u32::from(turned.of(h / 2)));
        });
        let face_loops = subdivision.cycles_of_face.offsets();
        let begins = parallel::map_light(face_loops.len(), |face| offsets[face_loops[face] as usize]);
        Self { offsets, half_edges, begins, turned, dangling }
    }

    fn of_face(&self, face: usize) -> &[u32] {
        &self.half_edges[self.begins[face] as usize..self.begins[face + 1] as usize]
    }

    /// Where the columns of ∂2 begin: every edge of a face's loops is in its column once, but for those with the face on
    /// both sides.
    fn columns(&self, subdivision: &Subdivision) -> Vec<u32> {
        let length = |face: usize| AtomicU32::new(self.begins[face + 1] - self.begins[face]);
        let lengths = parallel::map_light(subdivision.n_faces(), length);
        let (n_chunks, range) = parallel::chunks(self.dangling.0.len(), 256);
        parallel::map(n_chunks, |chunk| {
            let edges = range(chunk).flat_map(|i| bits_of(self.dangling.0[i]).map(move |bit| 64 * i + bit));
            // Most come after one of the same face.
            let (mut last, mut n) = (0, 0);
            for edge in edges {
                let face = subdivision.face(2 * edge as u32);
                if face != last {
                    lengths[last as usize].fetch_sub(n, Relaxed);
                    (last, n) = (face, 0);
                }
                n += 2;
            }
            lengths[last as usize].fetch_sub(n, Relaxed);
        });
        offsets_of(lengths.len(), |face| lengths[face].load(Relaxed))
    }

    /// The columns of faces with a large part of all edges, as half-edges: all edges are looked through for them.
    fn large_columns(&self, subdivision: &Subdivision, columns: &[u32]) -> Vec<(usize, Vec<u32>)> {
        // An edge has two sides, so there are sixteen at most.
        const LARGE: u32 = 1 << 12;
        let n_edges = subdivision.cycles.of.len() as u32 / 2;
        let are_large =
            |faces: &Range<usize>| columns[faces.end] - columns[faces.start] > LARGE.max(n_edges / 8);
        let half_edge = |edge: u32, face: u32| {
            let [left, right] = [2 * edge, 2 * edge + 1].map(|h| subdivision.face(h) == face);
            (left != right).then(|| (2 * edge + u32::from(right)) ^ u32::from(self.turned.of(edge)))
        };
        let column = |face: usize| {
            let (n_chunks, range) = parallel::chunks(n_edges as usize, 1 << 14);
            let part = |i| range(i).filter_map(|edge| half_edge(edge as u32, face as u32)).collect();
            (face, parallel::concat(&parallel::map(n_chunks, part)))
        };
        // Most chunks of faces have no more edges together than one that is large.
        let (n_chunks, faces) = parallel::chunks(columns.len() - 1, 256);
        let faces = (0..n_chunks).map(faces).filter(are_large).flatten();
        faces.filter(|&face| are_large(&(face..face + 1))).map(column).collect()
    }

    /// The half-edges of a face that are no edge's both, ascending.
    fn fill_column(&self, face: usize, column: &mut [u32]) {
        let all = self.of_face(face);
        if column.len() == all.len() {
            column.copy_from_slice(all);
        } else {
            let proper = all.iter().filter(|h| !self.dangling.of(**h / 2));
            column.iter_mut().zip(proper).for_each(|(to, h)| *to = *h);
        }
        column.sort_unstable();
    }
}

/// Cuts off the beginning of a slice.
fn take<'a, T>(rest: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let (taken, after) = std::mem::take(rest).split_at_mut(length);
    *rest = after;
    taken
}
