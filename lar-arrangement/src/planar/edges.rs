//! Planar stage 4a: the edges along carriers, and the cycles of half-edges round the faces that they bound.
//!
//! A *run* is a stretch of edges along one carrier with none left out. The half-edges that leave a vertex are those of
//! the runs that pass it: forwards ones by slope, then backwards ones by slope, as carriers point right or straight up.

use crate::counting::offsets;
use crate::parallel;
use crate::planar::carriers::Carriers;
use crate::planar::chains::Chains;
use crate::subdivision::Cycles;
use crate::union_find::UnionFind;
use std::ops::Range;

pub(crate) const NO_EDGE: u32 = u32::MAX;

/// Successive edges along a carrier, up to the first of the next run.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Run {
    pub carrier: u32,
    pub first_edge: u32,
}

/// Number of the edge that begins at each place of the chains.
#[derive(Debug)]
pub(crate) enum EdgeAt {
    /// All edges of the chains are kept.
    All,
    /// `NO_EDGE` where there is none.
    Some(Vec<u32>),
}

impl EdgeAt {
    /// The edge that begins at a place of a carrier's chain, which is not its last.
    pub(crate) fn edge(&self, carrier: u32, place: u32) -> Option<u32> {
        match self {
            Self::All => Some(place - carrier),
            Self::Some(edges) => Some(edges[place as usize]).filter(|&edge| edge != NO_EDGE),
        }
    }

    /// The same after edges have new numbers, or none.
    pub(crate) fn renumbered(&self, chains: &Chains, new: &[u32]) -> Self {
        let mut edges = vec![NO_EDGE; chains.chain.len()];
        for carrier in 0..chains.offsets.len() as u32 - 1 {
            for place in chains.offsets[carrier as usize]..chains.offsets[carrier as usize + 1] - 1 {
                let edge = self.edge(carrier, place);
                edges[place as usize] = edge.map_or(NO_EDGE, |edge| new[edge as usize]);
            }
        }
        Self::Some(edges)
    }
}

/// The edges that are kept, along their carriers. Half-edge 2e leads along the carrier, 2e + 1 back.
#[derive(Debug)]
pub(crate) struct Edges {
    pub ends: Vec<[u32; 2]>,
    pub runs: Vec<Run>,
    /// Run of each edge.
    pub run_of: Vec<u32>,
    pub edge_at: EdgeAt,
}

impl Edges {
    /// Those of all edges of the chains, numbered from one carrier to the next, that are to be kept. They are counted
    /// first, so that the edges of some carriers can be filled in on their own.
    pub(crate) fn new(chains: &Chains, keep: impl Fn(u32) -> bool + Sync + Send) -> Self {
        let n_carriers = chains.offsets.len() - 1;
        let (n_parts, carriers) = parallel::chunks(n_carriers, (n_carriers / 256).max(16));
        let counts = parallel::map(n_parts, |part| count(chains, carriers(part), &keep));
        let first_edge = offsets(counts.iter().map(|n| n[0]));
        let first_run = offsets(counts.iter().map(|n| n[1]));
        let (n, n_runs) = (first_edge[n_parts] as usize, first_run[n_parts] as usize);
        let (mut ends, mut run_of) = (vec![[0; 2]; n], vec![0; n]);
        let mut runs = vec![Run::default(); n_runs];
        let mut edge_at = vec![NO_EDGE; if n == chains.n_edges() { 0 } else { chains.chain.len() }];
        let n_edges = || counts.iter().map(|n| n[0] as usize);
        let place = |carrier: usize| (chains.offsets[carrier] as usize).min(edge_at.len());
        let n_places: Vec<usize> =
            (0..n_parts).map(|part| place(carriers(part).end) - place(carriers(part).start)).collect();
        let parts = parallel::cut(&mut ends, n_edges()).into_iter();
        let parts = parts.zip(parallel::cut(&mut runs, counts.iter().map(|n| n[1] as usize)));
        let parts = parts.zip(parallel::cut(&mut run_of, n_edges()));
        let parts = parts.zip(parallel::cut(&mut edge_at, n_places.into_iter()));
        parallel::each(parts.enumerate().collect(), |(i, (((ends, runs), run_of), edge_at))| {
            let (first_edge, first_run) = (first_edge[i], first_run[i]);
            let mut part = Part { ends, runs, run_of, first_edge, first_run, n_edges: 0, n_runs: 0 };
            part.fill(chains, carriers(i), &keep, edge_at);
        });
        let edge_at = if n == chains.n_edges() { EdgeAt::All } else { EdgeAt::Some(edge_at) };
        Self { ends, runs, run_of, edge_at }
    }

    /// The same without edges that have one cycle on both sides; `None` when there are none. They are those with
    /// one face on both sides, as other components do not join faces. What remains has no others: without them no
    /// two faces become one.
    pub(crate) fn without_dangling(&self, chains: &Chains, cycles: &Cycles) -> Option<Self> {
        let dangles = |sides: &[u32]| sides[0] == sides[1];
        let any = cycles.of.chunks_exact(2).any(dangles);
        any.then(|| Self::new(chains, |e| !dangles(&cycles.of[2 * e as usize..][..2])))
    }

    pub(crate) fn start(&self, run: &Run) -> u32 {
        self.ends[run.first_edge as usize][0]
    }

    /// The cycles of half-edges, and the connected component of each run.
    pub(crate) fn cycles(&self, carriers: &Carriers, n_vertices: usize) -> (Cycles, Vec<u32>) {
        let star = Star::new(self, carriers, n_vertices);
        let next = |e: usize| {
            let (run, [a, b]) = (self.run_of[e], self.ends[e]);
            [star.clockwise(self, b, run, false), star.clockwise(self, a, run, true)]
        };
        let next = parallel::map(self.ends.len(), next).into_flattened();
        let n_runs = self.runs.len();
        // Each on one thread; on a single one the star's memory is free before the cycles are made.
        let (components, cycles) = parallel::join(move || star.components(n_runs), || Cycles::new(next));
        (cycles, components)
    }

    /// Calls `visit` with the vertices that runs pass.
    fn each_pass(&self, mut visit: impl FnMut(u32, Pass)) {
        let mut before = None;
        for (edge, (&[a, b], &run)) in (0..).zip(self.ends.iter().zip(&self.run_of)) {
            let backwards = if before == Some(run) { BACKWARDS } else { 0 };
            visit(a, Pass { run, edge: edge | FORWARDS | backwards });
            if self.run_of.get(edge as usize + 1) != Some(&run) {
                visit(b, Pass { run, edge: (edge + 1) | BACKWARDS });
            }
            before = Some(run);
        }
    }
}

/// Number of the edges of some carriers that are to be kept, and of their runs.
fn count(chains: &Chains, carriers: Range<usize>, keep: impl Fn(u32) -> bool) -> [u32; 2] {
    let mut counts = [0; 2];
    for carrier in carriers {
        let mut continues = false;
        for edge in chains.edges_along(carrier as u32) {
            let keeps = keep(edge);
            counts[0] += u32::from(keeps);
            counts[1] += u32::from(keeps && !continues);
            continues = keeps;
        }
    }
    counts
}

/// The places of the edges of some carriers and of their runs.
struct Part<'a> {
    ends: &'a mut [[u32; 2]],
    runs: &'a mut [Run],
    run_of: &'a mut [u32],
    first_edge: u32,
    first_run: u32,
    /// How many there are yet.
    n_edges: usize,
    n_runs: usize,
}

impl Part<'_> {
    fn fill(
        &mut self,
        chains: &Chains,
        carriers: Range<usize>,
        keep: impl Fn(u32) -> bool,
        edge_at: &mut [u32],
    ) {
        let first_place = chains.offsets[carriers.start];
        for carrier in carriers.map(|carrier| carrier as u32) {
            let begin = (chains.offsets[carrier as usize] - first_place) as usize;
            let mut continues = false;
            for (place, (w, edge)) in
                (begin..).zip(chains.along(carrier).windows(2).zip(chains.edges_along(carrier)))
            {
                let keeps = keep(edge);
                if keeps {
                    let number = self.push(carrier, [w[0], w[1]], continues);
                    if let Some(at) = edge_at.get_mut(place) {
                        *at = number;
                    }
                }
                continues = keeps;
            }
        }
    }

    /// Adds an edge; returns its number.
    fn push(&mut self, carrier: u32, ends: [u32; 2], continues: bool) -> u32 {
        let edge = self.first_edge + self.n_edges as u32;
        if !continues {
            self.runs[self.n_runs] = Run { carrier, first_edge: edge };
            self.n_runs += 1;
        }
        self.ends[self.n_edges] = ends;
        self.run_of[self.n_edges] = self.first_run + self.n_runs as u32 - 1;
        self.n_edges += 1;
        edge
    }
}

/// A run at a vertex.
#[derive(Clone, Copy, Debug, Default)]
struct Pass {
    run: u32,
    /// The edge that would leave the vertex forwards if the run went on; marked with the sides on which it does. There
    /// are fewer than 2^30 edges.
    edge: u32,
}

const FORWARDS: u32 = 1 << 31;
const BACKWARDS: u32 = 1 << 30;

impl Pass {
    /// The half-edge that leaves the vertex forwards or backwards along the run.
    fn leaves(&self, forwards: bool) -> Option<u32> {
        let edge = self.edge & (BACKWARDS - 1);
        if forwards {
            (self.edge & FORWARDS != 0).then_some(2 * edge)
        } else {
            (self.edge & BACKWARDS != 0).then(|| 2 * edge - 1)
        }
    }
}

/// The runs that pass each vertex, by slope.
struct Star<'a> {
    carriers: &'a Carriers,
    offsets: Vec<u32>,
    passes: Vec<Pass>,
}

/// So many runs at a vertex are searched one by one.
const FEW: usize = 8;

impl<'a> Star<'a> {
    fn new(edges: &Edges, carriers: &'a Carriers, n_vertices: usize) -> Self {
        let mut offsets = vec![0u32; n_vertices + 1];
        edges.each_pass(|v, _| offsets[v as usize] += 1);
        let mut end = 0;
        for offset in &mut offsets {
            end += *offset;
            *offset = end;
        }
        // Filled from the back, every offset ends where its passes begin.
        let mut passes = vec![Pass::default(); end as usize];
        edges.each_pass(|v, pass| {
            offsets[v as usize] -= 1;
            passes[offsets[v as usize] as usize] = pass;
        });
        let mut out = Self { carriers, offsets, passes: Vec::new() };
        let rank = |p: &Pass| out.rank(edges, p.run);
        parallel::each_stretch(&mut passes, &out.offsets, |at| match at {
            [a, b] if rank(b) < rank(a) => std::mem::swap(a, b),
            [_, _] => {}
            _ => at.sort_unstable_by_key(rank),
        });
        out.passes = passes;
        out
    }

    fn rank(&self, edges: &Edges, run: u32) -> u32 {
        self.carriers.rank[edges.runs[run as usize].carrier as usize]
    }

    fn at(&self, vertex: u32) -> &[Pass] {
        &self.passes[self.offsets[vertex as usize] as usize..self.offsets[vertex as usize + 1] as usize]
    }

    /// The half-edge that leaves a vertex first clockwise from that of a run, which leads forwards or backwards.
    fn clockwise(&self, edges: &Edges, vertex: u32, run: u32, forwards: bool) -> u32 {
        let passes = self.at(vertex);
        let last = |passes: &[Pass], forwards| passes.iter().rev().find_map(|p| p.leaves(forwards));
        if let [p, q] = passes {
            let other = if p.run == run { q.leaves(!forwards) } else { p.leaves(forwards) };
            if let Some(half_edge) = other {
                return half_edge;
            }
        }
        let own = match passes.len() {
            0..=FEW => passes.iter().position(|p| p.run == run),
            _ => passes.binary_search_by_key(&self.rank(edges, run), |p| self.rank(edges, p.run)).ok(),
        };
        let own = own.expect("a run passes the ends of its edges");
        last(&passes[..own], forwards)
            .or_else(|| last(passes, !forwards))
            .or_else(|| last(&passes[own..], forwards))
            .expect("the half-edge itself, if there is no other")
    }

    /// Component of each run.
    fn components(self, n_runs: usize) -> Vec<u32> {
        let mut sets = UnionFind::new(n_runs);
        for range in self.offsets.windows(2) {
            for w in self.passes[range[0] as usize..range[1] as usize].windows(2) {
                sets.union(w[0].run, w[1].run);
            }
        }
        sets.labels().0
    }
}
