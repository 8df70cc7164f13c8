//! Planar stage 5: the chain complex from edges and faces.

use crate::grid::Grid;
use crate::parallel;
use crate::pipeline::boundary_1;
use crate::planar::carriers::Carriers;
use crate::planar::chains::Chains;
use crate::planar::edges::Edges;
use crate::planar::result::PlanarArrangement;
use crate::stats::Stats;
use crate::subdivision::Subdivision;
use crate::winding::Windings;
use lar_core::{Cells, ChainComplex, Points};
use std::sync::OnceLock;

/// `positions` are those of all vertices of the chains; vertices without edges are left out.
pub(crate) fn assemble(
    mut positions: Vec<[f64; 2]>,
    mut edges: Edges,
    subdivision: Subdivision,
    chains: Chains,
    carriers: Carriers,
    grid: Grid,
) -> PlanarArrangement {
    let mut sources = chains.vertices.clone();
    if edges.ends.len() < chains.n_edges() {
        let is_used = edges.number_vertices(positions.len());
        retain(&mut positions, &is_used);
        retain(&mut sources, &is_used);
    }
    let n_components = subdivision.n_components;
    let points = Points::from_columns(2, positions.into_flattened());
    let faces = Faces::new(&edges.ends, subdivision);
    let carrier_of = edges.carriers();
    let Edges { mut ends, edge_at, .. } = edges;
    ends.iter_mut().for_each(|ends| ends.sort_unstable());
    let boundaries = vec![
        boundary_1(points.len(), &ends),
        ChainComplex::operator_from_columns(ends.len(), faces.columns, faces.signs),
    ];
    PlanarArrangement {
        complex: ChainComplex::new(points, boundaries),
        loops: faces.loops,
        face_loops: faces.face_loops,
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

/// Loops and columns of ∂2 of some faces, one after the other.
#[derive(Default)]
struct Part {
    half_edges: Vec<u32>,
    loop_ends: Vec<u32>,
    face_ends: Vec<u32>,
    rows: Vec<u32>,
    column_ends: Vec<u32>,
    signs: Vec<i8>,
}

impl Part {
    /// Half-edges lead along the carrier or back; those of a loop lead from the smaller vertex to the larger or back.
    fn push_face(
        &mut self,
        ends: &[[u32; 2]],
        subdivision: &Subdivision,
        face: usize,
        column: &mut Vec<u32>,
    ) {
        let turned = |h: u32| {
            let [a, b] = ends[(h / 2) as usize];
            if a < b { h } else { h ^ 1 }
        };
        let begin = self.half_edges.len();
        for &cycle in &subdivision.cycles_of_face[face] {
            let cycle = &subdivision.cycles.list[cycle as usize];
            self.half_edges.extend(cycle.iter().map(|&h| turned(h)));
            self.loop_ends.push(self.half_edges.len() as u32);
        }
        self.face_ends.push(self.loop_ends.len() as u32);
        column.clear();
        column.extend_from_slice(&self.half_edges[begin..]);
        column.sort_unstable();
        for same in column.chunk_by(|a, b| a / 2 == b / 2) {
            // An edge that stands in the loops in both directions is no boundary.
            if let [h] = same {
                self.rows.push(h / 2);
                self.signs.push(if h % 2 == 0 { 1 } else { -1 });
            }
        }
        self.column_ends.push(self.rows.len() as u32);
    }
}

/// The loops of all faces and the columns of ∂2.
struct Faces {
    loops: Cells,
    face_loops: Vec<u32>,
    columns: Cells,
    signs: Vec<i8>,
}

impl Faces {
    fn new(ends: &[[u32; 2]], subdivision: Subdivision) -> Self {
        let (n_chunks, range) = parallel::chunks(subdivision.n_faces(), 4096);
        let mut parts = parallel::map(n_chunks, |chunk| {
            let (mut part, mut column) = (Part::default(), Vec::new());
            for face in range(chunk) {
                part.push_face(ends, &subdivision, face, &mut column);
            }
            part
        });
        drop(subdivision);
        let face_loops = ends_joined(parts.iter().map(|p| &p.face_ends[..]));
        let loops = ends_joined(parts.iter().map(|p| &p.loop_ends[..]));
        let columns = ends_joined(parts.iter().map(|p| &p.column_ends[..]));
        let mut joined = |field: fn(&mut Part) -> Vec<u32>| {
            parts.iter_mut().map(field).fold(Vec::new(), |mut all, part| {
                all.extend(part);
                all
            })
        };
        let half_edges = joined(|part| std::mem::take(&mut part.half_edges));
        let rows = joined(|part| std::mem::take(&mut part.rows));
        Self {
            loops: Cells::from_parts(loops, half_edges),
            face_loops,
            columns: Cells::from_parts(columns, rows),
            signs: parts.into_iter().flat_map(|part| part.signs).collect(),
        }
    }
}

/// Offsets from the ends of parts that begin at 0 each.
fn ends_joined<'a>(parts: impl Iterator<Item = &'a [u32]>) -> Vec<u32> {
    let mut out = vec![0];
    for ends in parts {
        let base = out[out.len() - 1];
        out.extend(ends.iter().map(|end| base + end));
    }
    out
}
