//! The driver and the result of a planar arrangement.

use crate::boxes::BoxTree;
use crate::error::ArrangementError;
use crate::grid::Grid;
use crate::kernel::{Int, rounded_quotient};
use crate::parallel;
use crate::planar::carriers::Carriers;
use crate::planar::chains::{Chains, VertexSource};
use crate::planar::crossings::{carrier_boxes, crossings};
use crate::planar::faces::{NO_EDGE, PlanarEmbedding, exact_crossing};
use crate::planar::input::Drawing;
use crate::planar::location::LocationIndex;
use crate::stats::{Stats, Watch};
use crate::subdivision::Subdivision;
use crate::union_find::UnionFind;
use crate::winding::Windings;
use lar_core::{Biconnected, Cells, ChainComplex, EdgeId, FaceId, Graph, Points, VertexId};
use std::num::NonZeroUsize;
use std::sync::OnceLock;

/// What becomes of edges with the same face on both sides: ends that lead nowhere, and bridges between parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dangling {
    /// They are left out, as in the paper.
    #[default]
    Drop,
    /// They are kept.
    Keep,
}

/// Options for a planar arrangement.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanarArranger {
    threads: Option<NonZeroUsize>,
    pub(super) dangling: Dangling,
    pub(super) keep_isolated: bool,
}

/// The partition of the plane that some segments generate.
///
/// ∂1's columns hold −1 at the smaller vertex and +1 at the larger. Column 0 of ∂2 is the exterior face; a face's
/// column holds the edges of its loops, which keep it on their left (outer loops counter-clockwise, holes
/// clockwise), so every row has one +1 and one −1, or is empty when the edge dangles.
#[derive(Debug)]
pub struct PlanarArrangement {
    pub(super) complex: ChainComplex,
    pub(super) loops: Cells,
    pub(super) face_loops: Vec<u32>,
    pub(super) n_components: usize,
    pub(super) carriers: Carriers,
    chains: Chains,
    /// What each vertex is.
    pub(super) sources: Vec<VertexSource>,
    pub(super) grid: Grid,
    pub(super) edge_at: Vec<u32>,
    /// The index for point location, built when it is first asked for.
    pub(super) index: OnceLock<LocationIndex>,
    /// Carrier of each edge: edges of one carrier lie on one line.
    pub(super) carrier_of: Vec<u32>,
    pub(super) regions: Vec<String>,
    pub(super) windings: Windings,
    pub(super) isolated: Vec<(VertexId, FaceId)>,
    stats: Stats,
}

/// The arrangement of a drawing with the default options: dangling edges and bridges are left out.
///
/// ```
/// use lar_arrangement::planar::{Drawing, planar_arrangement};
/// let hash = Drawing::from_segments(&[[0., 1., 3., 1.], [0., 2., 3., 2.], [1., 0., 1., 3.], [2., 0., 2., 3.]]);
/// let a = planar_arrangement(&hash)?;
/// assert_eq!((a.n_vertices(), a.n_edges(), a.n_faces()), (4, 4, 1));
/// # Ok::<(), lar_arrangement::ArrangementError>(())
/// ```
///
/// # Errors
/// Points that are not two-dimensional or not finite, segments between points that do not exist.
#[doc(alias = "minimal_2cycles")]
pub fn planar_arrangement(drawing: &Drawing) -> Result<PlanarArrangement, ArrangementError> {
    PlanarArranger::new().arrange(drawing)
}

impl PlanarArranger {
    /// The default options: all processors, dangling edges left out.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Limits the number of threads. Without the feature `rayon` there is one.
    #[must_use]
    pub fn threads(mut self, threads: NonZeroUsize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Keeps or drops edges with the same face on both sides.
    #[must_use]
    pub fn dangling(mut self, dangling: Dangling) -> Self {
        self.dangling = dangling;
        self
    }

    /// Makes vertices of points in which no segment with length ends (points of segments without length, or of no
    /// segment) and that lie on no edge of the result. They are left out by default. A point on an edge splits
    /// nothing, with or without a segment.
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, PlanarArranger};
    /// let dots = Drawing::from_segments(&[[0., 0., 0., 0.], [1., 2., 1., 2.], [1., 2., 1., 2.]]);
    /// let a = PlanarArranger::new().keep_isolated(true).arrange(&dots)?;
    /// assert_eq!((a.n_vertices(), a.n_components(), a.isolated_vertices().len()), (2, 2, 2));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[must_use]
    pub fn keep_isolated(mut self, keep: bool) -> Self {
        self.keep_isolated = keep;
        self
    }

    /// Computes the arrangement. O((n + k) log n) time and O(n + k) memory for n segments whose boxes meet in k
    /// pairs; pairs through one common point cost no memory.
    ///
    /// # Errors
    /// Points that are not two-dimensional or not finite, segments between points that do not exist; when the
    /// threads cannot be started.
    pub fn arrange(&self, drawing: &Drawing) -> Result<PlanarArrangement, ArrangementError> {
        parallel::with_threads(self.threads, || self.run(drawing))?
    }

    fn run(&self, drawing: &Drawing) -> Result<PlanarArrangement, ArrangementError> {
        let mut stats = Stats::default();
        let mut watch = Watch::start();
        let grid = fitted_grid(drawing)?;
        let snapped: Vec<[i64; 2]> = drawing
            .points
            .iter()
            .map(|p| {
                let [x, y, _] = grid.snap([p[0], p[1], 0.0]);
                [x, y]
            })
            .collect();
        let carriers = Carriers::new(drawing, &snapped);
        drop(snapped);
        watch.lap(&mut stats, "carriers");
        let tree = BoxTree::new(&carrier_boxes(&carriers));
        let found = crossings(&carriers, &tree);
        stats.pairs_tested = found.pairs_tested;
        stats.pairs_crossing = found.crossings.len() as u64;
        watch.lap(&mut stats, "crossings");
        let chains = Chains::new(&carriers, found);
        let positions = positions(&carriers, &chains);
        watch.lap(&mut stats, "chains");
        let mut edges = Edges::new(&chains);
        let mut subdivision = edges.subdivision(&carriers, &chains, &tree, &positions);
        if self.dangling == Dangling::Drop && edges.drop_dangling(&subdivision) {
            subdivision = edges.subdivision(&carriers, &chains, &tree, &positions);
        }
        watch.lap(&mut stats, "faces");
        stats.grid_step = grid.step();
        let positions = lengths(&grid, &carriers, &chains, positions);
        let mut out = assemble(&positions, edges, &subdivision, chains, carriers, grid);
        watch.lap(&mut stats, "complex");
        out.wind(drawing);
        watch.lap(&mut stats, "membership");
        if self.keep_isolated {
            out.add_isolated(|_| true);
        }
        out.stats = stats;
        Ok(out)
    }
}

fn fitted_grid(drawing: &Drawing) -> Result<Grid, ArrangementError> {
    if drawing.points.dim() != 2 {
        return Err(ArrangementError::PlanarDimension { dim: drawing.points.dim() });
    }
    let n_vertices = drawing.points.len();
    for (segment, ends) in drawing.segments.iter().enumerate() {
        if let Some(&vertex) = ends.iter().find(|&&p| p as usize >= n_vertices) {
            return Err(ArrangementError::NoSuchPoint { segment, vertex: vertex.into(), n_vertices });
        }
    }
    let (mut lo, mut hi) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (v, p) in drawing.points.iter().enumerate() {
        for k in 0..2 {
            if !p[k].is_finite() {
                return Err(ArrangementError::NotFinite {
                    solid: "drawing".to_owned(),
                    vertex: (v as u32).into(),
                    value: p[k],
                });
            }
            lo[k] = lo[k].min(p[k]);
            hi[k] = hi[k].max(p[k]);
        }
    }
    let corner = |c: [f64; 2]| if lo[0] <= hi[0] { [c[0], c[1], 0.0] } else { [0.0; 3] };
    Ok(Grid::fitted(corner(lo), corner(hi)))
}

/// Correctly rounded positions in grid steps.
fn positions(carriers: &Carriers, chains: &Chains) -> Vec<[f64; 2]> {
    let (n_chunks, range) = parallel::chunks(chains.vertices.len(), 4096);
    parallel::map(n_chunks, |chunk| {
        chains.vertices[range(chunk)]
            .iter()
            .map(|source| match *source {
                VertexSource::Point(p) => carriers.points[p as usize].map(|x| x as f64),
                VertexSource::Crossing([s, t]) => {
                    let (x, w) = exact_crossing(carriers, s, t);
                    x.map(|x| rounded_quotient(&x, &w.into()))
                }
            })
            .collect::<Vec<_>>()
    })
    .concat()
}

/// The edges that are kept, along their carriers.
struct Edges {
    ends: Vec<[u32; 2]>,
    carrier_of: Vec<u32>,
    /// Number of the edge that begins at each place of the chains.
    edge_at: Vec<u32>,
}

impl Edges {
    fn new(chains: &Chains) -> Self {
        let n_carriers = chains.offsets.len() - 1;
        let n = chains.chain.len() - n_carriers;
        let mut out = Self {
            ends: Vec::with_capacity(n),
            carrier_of: Vec::with_capacity(n),
            edge_at: Vec::with_capacity(chains.chain.len()),
        };
        for carrier in 0..n_carriers as u32 {
            for w in chains.along(carrier).windows(2) {
                out.edge_at.push(out.ends.len() as u32);
                out.ends.push([w[0], w[1]]);
                out.carrier_of.push(carrier);
            }
            out.edge_at.push(NO_EDGE);
        }
        out
    }

    fn subdivision(
        &self,
        carriers: &Carriers,
        chains: &Chains,
        tree: &BoxTree,
        positions: &[[f64; 2]],
    ) -> Subdivision {
        let embedding = PlanarEmbedding {
            carriers,
            chains,
            tree,
            carrier_of: &self.carrier_of,
            edge_at: &self.edge_at,
            positions,
        };
        Subdivision::new(positions.len(), &self.ends, &embedding)
    }

    /// Leaves out the edges with one face on both sides; false when there are none. What remains has no others:
    /// without them no two faces become one.
    fn drop_dangling(&mut self, subdivision: &Subdivision) -> bool {
        let keep: Vec<bool> = (0..self.ends.len() as u32)
            .map(|e| subdivision.face(2 * e) != subdivision.face(2 * e + 1))
            .collect();
        if keep.iter().all(|&k| k) {
            return false;
        }
        let mut new = 0;
        for at in &mut self.edge_at {
            if *at != NO_EDGE {
                *at = if keep[*at as usize] {
                    new += 1;
                    new - 1
                } else {
                    NO_EDGE
                };
            }
        }
        let mut kept = keep.iter();
        self.ends.retain(|_| *kept.next().expect("one flag an edge"));
        let mut kept = keep.iter();
        self.carrier_of.retain(|_| *kept.next().expect("one flag an edge"));
        true
    }
}

/// Positions in the drawing's unit of length: those in grid steps scaled exactly, or, far from the origin, rounded
/// from the exact ones again.
fn lengths(grid: &Grid, carriers: &Carriers, chains: &Chains, positions: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let offset = grid.offset();
    let moved = |v: usize| match chains.vertices[v] {
        VertexSource::Point(p) => {
            [0, 1].map(|k| (i128::from(carriers.points[p as usize][k]) + offset[k]) as f64)
        }
        VertexSource::Crossing([s, t]) => {
            let (x, w) = exact_crossing(carriers, s, t);
            [0, 1].map(|k| rounded_quotient(&(x[k] + Int::from(offset[k]) * Int::from(w)), &w.into()))
        }
    };
    let far = offset != [0; 3];
    positions
        .into_iter()
        .enumerate()
        .map(|(v, p)| if far { moved(v) } else { p }.map(|x| grid.length(x)))
        .collect()
}

fn assemble(
    positions: &[[f64; 2]],
    edges: Edges,
    subdivision: &Subdivision,
    chains: Chains,
    carriers: Carriers,
    grid: Grid,
) -> PlanarArrangement {
    let mut used = vec![false; positions.len()];
    edges.ends.as_flattened().iter().for_each(|&v| used[v as usize] = true);
    let mut new = vec![0u32; positions.len()];
    let (mut coords, mut sources) = (Vec::new(), Vec::new());
    for (v, position) in positions.iter().enumerate().filter(|(v, _)| used[*v]) {
        new[v] = (coords.len() / 2) as u32;
        coords.extend_from_slice(position);
        sources.push(chains.vertices[v]);
    }
    let points = Points::from_columns(2, coords);
    let ends: Vec<[u32; 2]> = edges.ends.iter().map(|e| e.map(|v| new[v as usize])).collect();
    let mut sets = UnionFind::new(points.len());
    ends.iter().for_each(|&[a, b]| {
        sets.union(a, b);
    });
    // From along the carrier to from the smaller vertex to the larger.
    let code = |h: u32| {
        let [a, b] = ends[(h / 2) as usize];
        if a < b { h } else { h ^ 1 }
    };
    let mut loops = Cells::with_capacity(subdivision.cycles.len(), subdivision.cycles.indices().len());
    let mut face_loops = vec![0];
    let mut columns = Cells::with_capacity(subdivision.n_faces(), subdivision.cycles.indices().len());
    let mut signs = Vec::with_capacity(subdivision.cycles.indices().len());
    let (mut one_loop, mut column, mut rows): (Vec<u32>, Vec<u32>, Vec<u32>) = Default::default();
    for cycles in &subdivision.cycles_of_face {
        column.clear();
        for &cycle in cycles {
            one_loop.clear();
            one_loop.extend(subdivision.cycles[cycle as usize].iter().map(|&h| code(h)));
            loops.push(&one_loop);
            column.extend_from_slice(&one_loop);
        }
        face_loops.push(loops.len() as u32);
        column.sort_unstable();
        rows.clear();
        for same in column.chunk_by(|a, b| a / 2 == b / 2) {
            if let [h] = same {
                rows.push(h / 2);
                signs.push(if h % 2 == 0 { 1 } else { -1 });
            }
        }
        columns.push(&rows);
    }
    let sorted: Vec<[u32; 2]> = ends.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    let boundaries = vec![
        crate::pipeline::boundary_1(points.len(), &sorted),
        ChainComplex::operator_from_columns(sorted.len(), columns, signs),
    ];
    PlanarArrangement {
        complex: ChainComplex::new(points, boundaries),
        loops,
        face_loops,
        n_components: sets.labels().1 as usize,
        carriers,
        chains,
        sources,
        grid,
        index: OnceLock::new(),
        edge_at: edges.edge_at,
        carrier_of: edges.carrier_of,
        regions: Vec::new(),
        windings: Windings::default(),
        isolated: Vec::new(),
        stats: Stats::default(),
    }
}

impl PlanarArrangement {
    /// Vertices and the operators ∂1, ∂2.
    #[must_use]
    pub fn complex(&self) -> &ChainComplex {
        &self.complex
    }

    /// Number of vertices.
    #[must_use]
    pub fn n_vertices(&self) -> usize {
        self.complex.n_cells(0)
    }

    /// Number of edges.
    #[must_use]
    pub fn n_edges(&self) -> usize {
        self.complex.n_cells(1)
    }

    /// Number of bounded faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.complex.n_cells(2) - 1
    }

    /// Biconnected components of the edges, articulation points and bridges. Without dangling edges every component
    /// is a union of cycles, and there are no bridges. O(n log n).
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, planar_arrangement};
    /// let mut drawing = Drawing::new(lar_core::Points::new(2));
    /// drawing.push_polygon("A", &[vec![[0., 0.], [1., 0.], [1., 1.]]]);
    /// drawing.push_polygon("B", &[vec![[1., 1.], [2., 1.], [2., 2.]]]);
    /// let found = planar_arrangement(&drawing)?.biconnected_components();
    /// assert_eq!((found.components.len(), found.articulation_points.len()), (2, 1));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    #[doc(alias = "biconnectedComponent")]
    #[must_use]
    pub fn biconnected_components(&self) -> Biconnected {
        let graph = Graph::of_complex(&self.complex).expect("edges have two of the vertices as ends");
        graph.biconnected_components()
    }

    /// Number of connected components of the edges, and of isolated vertices.
    #[must_use]
    pub fn n_components(&self) -> usize {
        self.n_components
    }

    /// Number of loops of the bounded faces.
    #[must_use]
    pub fn n_loops(&self) -> usize {
        self.loops.len() - self.face_loops[1] as usize
    }

    /// The loops of a face as half-edges (2 · edge, + 1 from the larger vertex to the smaller).
    pub(super) fn loops_of(&self, face: FaceId) -> impl ExactSizeIterator<Item = &[u32]> + '_ {
        let range = self.face_loops[face.index()] as usize..self.face_loops[face.index() + 1] as usize;
        range.map(|l| &self.loops[l])
    }

    pub(super) fn half_edges(&self, face: FaceId) -> impl Iterator<Item = u32> + '_ {
        self.loops_of(face).flat_map(|cycle| cycle.iter().copied())
    }

    /// The loops of a face, its outer one first (the exterior face 0 has only holes), as vertices.
    pub fn face_vertices(&self, face: FaceId) -> impl ExactSizeIterator<Item = Vec<u32>> + '_ {
        let ends = self.complex.boundary(1).indices();
        self.loops_of(face).map(|cycle| cycle.iter().map(|&h| ends[h as usize]).collect())
    }

    /// Signed area of a face; that of the exterior is minus the sum of the others.
    #[must_use]
    pub fn area(&self, face: FaceId) -> f64 {
        let points = self.complex.points();
        let mut twice = 0.0;
        for cycle in self.face_vertices(face) {
            let o = points.point(cycle[0] as usize);
            for (i, &v) in cycle.iter().enumerate() {
                let (p, q) = (points.point(v as usize), points.point(cycle[(i + 1) % cycle.len()] as usize));
                twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
            }
        }
        twice / 2.0
    }

    /// The edges that an input segment became, in its direction, with the sign of that direction relative to the
    /// edge's; without those that were dropped. Segments without length have none.
    pub fn edges_of(&self, segment: usize) -> impl Iterator<Item = (EdgeId, i8)> + '_ {
        let at = self.carriers.members.binary_search_by_key(&(segment as u32), |m| m.input);
        at.ok().into_iter().flat_map(|i| self.stretch(i))
    }

    fn stretch(&self, member: usize) -> Vec<(EdgeId, i8)> {
        let [from, to] = self.chains.stretches[member].map(|place| place as usize);
        let chain = &self.chains.chain;
        let mut found: Vec<(EdgeId, i8)> = (from..to)
            .filter(|&i| self.edge_at[i] != NO_EDGE)
            .map(|i| (EdgeId(self.edge_at[i]), if chain[i] < chain[i + 1] { 1 } else { -1 }))
            .collect();
        if self.carriers.members[member].reversed {
            found.reverse();
            found.iter_mut().for_each(|(_, sign)| *sign = -*sign);
        }
        found
    }

    /// V − E + F − (1 + components) with the exterior face counted: 0 for every partition of the plane.
    #[must_use]
    pub fn euler(&self) -> i64 {
        self.n_vertices() as i64 - self.n_edges() as i64 + self.n_faces() as i64 - self.n_components as i64
    }

    /// Counts and times of the computation.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }
}
