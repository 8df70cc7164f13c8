//! Planar stage 4a: the edges along carriers, and the cycles of half-edges round the faces that they bound.
//!
//! A *run* is a stretch of edges along one carrier with none left out.

use crate::counting::offsets;
use crate::parallel;
use crate::planar::carriers::Carriers;
use crate::planar::chains::Chains;
use crate::planar::rotation::Rotation;
use crate::subdivision::Cycles;
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
        let mut runs = parallel::map_light(n_runs, |_| Run::default());
        let n_places = if n == chains.n_edges() { 0 } else { chains.chain.len() };
        let mut edge_at = parallel::map_light(n_places, |_| NO_EDGE);
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

    /// The edges of a run.
    pub(super) fn of_run(&self, run: u32) -> Range<usize> {
        let begin = |run: usize| self.runs.get(run).map_or(self.ends.len(), |run| run.first_edge as usize);
        begin(run as usize)..begin(run as usize + 1)
    }

    /// The cycles of half-edges, the connected component of each run, and what `beside` returns: work for other threads
    /// while one finds the cycles.
    pub(crate) fn cycles<R: Send>(
        &self,
        carriers: &Carriers,
        n_vertices: usize,
        beside: impl FnOnce() -> R + Send,
    ) -> (Cycles, Vec<u32>, R) {
        let mut rotation = Rotation::new(self, n_vertices);
        let next = rotation.next(self, carriers);
        // On a single thread the rotation's memory is free before the cycles are made.
        let rest = || (rotation.components(self.runs.len()), beside());
        let ((components, beside), cycles) =
            parallel::join(rest, || Cycles::new(next, <[Vec<u32>; 2]>::default()));
        (cycles, components, beside)
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
