//! Planar stage 4c: faces from the cycles around them. Which component lies in which face is the only question that
//! needs coordinates.

use crate::boxes::{Aabb, BoxTree};
use crate::counting::sorted_numbers;
use crate::grid::BITS;
use crate::kernel::Int;
use crate::parallel;
use crate::planar::along::parameter;
use crate::planar::carriers::{Carriers, cross};
use crate::planar::chains::{Chains, VertexSource};
use crate::planar::edges::{Edges, Run};
use crate::progress::{Cancelled, Course};
use crate::subdivision::{Cycles, Subdivision};
use std::cmp::Ordering;

/// What locating components needs.
pub(crate) struct Embedding<'a> {
    pub carriers: &'a Carriers,
    pub chains: &'a Chains,
    /// Boxes of the carriers.
    pub tree: &'a BoxTree<2>,
    pub edges: &'a Edges,
    /// Rounded positions of the vertices in grid steps.
    pub positions: &'a [[f64; 2]],
}

impl Embedding<'_> {
    /// The faces, from the cycles and the component of each run. O(n), and one location for each component when
    /// there are several.
    pub(crate) fn subdivision(
        &self,
        cycles: Cycles,
        component_of: &[u32],
        course: &Course,
    ) -> Result<Subdivision, Cancelled> {
        let firsts = self.first_runs(component_of);
        let around = match firsts.len() {
            1 => vec![None],
            n => course.map(n, |i| self.locate(firsts[i]))?,
        };
        let sweep = self.swept(&firsts);
        let first_edge = |i: usize| self.edges.runs[firsts[sweep[i] as usize] as usize].first_edge;
        let outer = parallel::map_light(sweep.len(), |i| cycles.of[2 * first_edge(i) as usize]);
        let around = parallel::map_light(sweep.len(), |i| around[sweep[i] as usize]);
        Ok(Subdivision::nested(cycles, &outer, &around, <[Vec<u32>; 3]>::default()))
    }

    /// The order of some runs by `cmp_starts`: by narrow strips first.
    fn swept(&self, runs: &[u32]) -> Vec<u32> {
        const NUMBER: u32 = 31;
        let strip = |x: f64| ((x + 2f64.powi(BITS)) * 2f64.powi(31 - BITS)) as u32;
        let numbers =
            parallel::map_light(runs.len(), |i| u64::from(strip(self.start_x(runs[i]))) << NUMBER | i as u64);
        let run = |x: u64| runs[(x as u32 & (u32::MAX >> 1)) as usize];
        let settle = |sorted: &mut [u64]| {
            for same in sorted.chunk_by_mut(|a, b| a >> NUMBER == b >> NUMBER).filter(|same| same.len() > 1) {
                parallel::sort_distinct_by(same, |&a, &b| self.cmp_starts(run(a), run(b)));
            }
        };
        let sorted = sorted_numbers(&numbers, 32 + NUMBER, settle);
        parallel::map_light(sorted.len(), |i| sorted[i] as u32 & (u32::MAX >> 1))
    }

    /// The rounded x of the vertex that a run begins at.
    fn start_x(&self, run: u32) -> f64 {
        self.positions[self.edges.start(&self.edges.runs[run as usize]) as usize][0]
    }

    /// Of each component the run that leaves its first vertex last, counter-clockwise from the left. Carriers point
    /// right or straight up, so a run begins there and all runs there do.
    fn first_runs(&self, component_of: &[u32]) -> Vec<u32> {
        let n = component_of.iter().max().map_or(0, |&c| c as usize + 1);
        let mut firsts: Vec<Option<u32>> = vec![None; n];
        // Looked up by all threads before. Rounding does not change the order of what it leaves different.
        let x = parallel::map_light(component_of.len(), |run| self.start_x(run as u32) as f32);
        for (&c, run) in component_of.iter().zip(0..) {
            let best = &mut firsts[c as usize];
            if best.is_none_or(|b| x[run as usize] <= x[b as usize] && self.cmp_starts(run, b).is_lt()) {
                *best = Some(run);
            }
        }
        firsts.into_iter().flatten().collect()
    }

    /// By the vertices that two runs begin at, from left to right and upwards, then by slope, the steepest first.
    fn cmp_starts(&self, a: u32, b: u32) -> Ordering {
        let [r, s] = [a, b].map(|run| &self.edges.runs[run as usize]);
        let rank = |run: &Run| self.carriers.rank[run.carrier as usize];
        let (v, w) = (self.edges.start(r), self.edges.start(s));
        self.cmp(v, w, 0).then_with(|| self.cmp(v, w, 1)).then_with(|| rank(s).cmp(&rank(r)))
    }

    /// x and y times the denominator, and the denominator, which is positive: at most 126 and 84 bits.
    fn exact(&self, vertex: u32) -> ([Int<3>; 2], i128) {
        exact_vertex(self.carriers, self.chains.source(vertex))
    }

    fn cmp(&self, a: u32, b: u32, axis: usize) -> Ordering {
        let (x, y) = (self.positions[a as usize][axis], self.positions[b as usize][axis]);
        match x.total_cmp(&y) {
            _ if x == y && a != b => {
                let ((p, v), (q, w)) = (self.exact(a), self.exact(b));
                (p[axis].resize::<4>() * Int::from(w)).cmp(&(q[axis].resize::<4>() * Int::from(v)))
            }
            _ if a == b => Ordering::Equal,
            order => order,
        }
    }

    /// Where a carrier crosses the horizontal line through a vertex, and a bound on the error: y is off by 2^-13 and
    /// its difference by 2^-12, which the slope magnifies; the product and the sum add less than 2^-9. The bound
    /// covers another 2^-13 of the vertex's own rounding.
    fn crossing_x(&self, carrier: u32, y: f64) -> [f64; 2] {
        let [p, _] = self.carriers.at(carrier);
        let d = self.carriers.direction(carrier);
        let slope = d[0] as f64 / d[1] as f64;
        [p[0] as f64 + slope * (y - p[1] as f64), (slope.abs() + 4.0) / 1024.0]
    }

    /// Order of two carriers along the horizontal line an infinitesimal above a vertex.
    ///
    /// x = p + d (y − q) / e for a carrier through (p, q) with direction (d, e): with y = Y / W the numerator
    /// (p e − d q) W + d Y has 167 bits; times the other e 208 bits.
    fn cmp_on_line(&self, a: u32, b: u32, vertex: u32) -> Ordering {
        let (position, w) = self.exact(vertex);
        let side = |c: u32| {
            let [[p, q], _] = self.carriers.at(c);
            let [d, e] = self.carriers.direction(c);
            let constant = i128::from(p) * i128::from(e) - i128::from(d) * i128::from(q);
            let numerator =
                Int::<4>::from(constant) * Int::from(w) + Int::<4>::from(d) * position[1].resize();
            (numerator, e, [d, e])
        };
        let ((na, ea, da), (nb, eb, db)) = (side(a), side(b));
        let flip = (ea < 0) != (eb < 0);
        let order = (na * Int::from(eb)).cmp(&(nb * Int::from(ea)));
        let order = if flip { order.reverse() } else { order };
        order.then_with(|| {
            // d / e grows with y: a is to the right above when dₐ / eₐ > d_b / e_b.
            let order = cross(da, db).cmp(&0);
            if flip { order.reverse() } else { order }
        })
    }

    /// Whether the vertex is to the right of the carrier's line, strictly.
    fn is_right_of(&self, vertex: u32, carrier: u32, upwards: bool) -> bool {
        let side = side_of_carrier(self.carriers, carrier, self.exact(vertex));
        if upwards { side.is_lt() } else { side.is_gt() }
    }

    /// The edge of a carrier that crosses the horizontal line an infinitesimal above a vertex.
    fn edge_across(&self, carrier: u32, vertex: u32) -> Option<u32> {
        let chain = self.chains.along(carrier);
        let rising = self.carriers.direction(carrier)[1] > 0;
        let below = |v: &u32| self.cmp(*v, vertex, 1).is_le();
        let n = chain.partition_point(|v| below(v) == rising);
        self.edges.edge_at.edge(carrier, self.chains.offsets[carrier as usize] + n as u32 - 1)
    }

    /// For a run that begins at the first vertex of its component: the half-edge on whose left that lies, on the
    /// nearest carrier to the left. None of the component's own is there.
    fn locate(&self, run: u32) -> Option<u32> {
        let run = &self.edges.runs[run as usize];
        let (vertex, carrier) = (self.edges.start(run), run.carrier);
        let [x, y] = self.positions[vertex as usize];
        let mut nearest: Option<([f64; 2], u32)> = None;
        let mut try_carrier = |carrier: u32| {
            if let Some(at) = self.crossing_left_of(vertex, carrier) {
                let is_nearer = |([best, error], n): ([f64; 2], u32)| match at[0] - best {
                    gap if gap.abs() > at[1] + error => gap > 0.0,
                    _ => self.cmp_on_line(carrier, n, vertex).is_gt(),
                };
                if nearest.is_none_or(is_nearer) && self.edge_across(carrier, vertex).is_some() {
                    nearest = Some((at, carrier));
                }
            }
            // What ends further left cannot be nearer.
            nearest.map_or(f64::NEG_INFINITY, |([best, error], _)| best - error)
        };
        let beam = Aabb { lo: [f64::NEG_INFINITY, y - 1.0], hi: [x + 1.0, y + 1.0] };
        // Neighbours in number are neighbours in the plane, and give a first bound.
        let n = self.carriers.ends.len() as u32;
        let mut bound = f64::NEG_INFINITY;
        for near in carrier.saturating_sub(NEAR)..(carrier + NEAR).min(n) {
            if self.carriers.box_of(near).meets(&beam) {
                bound = try_carrier(near);
            }
        }
        self.tree.query_leftwards(&beam, bound, |carrier, _| try_carrier(carrier));
        let (_, carrier) = nearest?;
        let edge = self.edge_across(carrier, vertex)?;
        // The half-edge that leads down has the vertex on its left.
        let rising = self.carriers.direction(carrier)[1] > 0;
        Some(2 * edge + u32::from(rising))
    }

    /// Where a carrier crosses the horizontal line an infinitesimal above a vertex, if it does and the vertex is to
    /// the right of it.
    fn crossing_left_of(&self, vertex: u32, carrier: u32) -> Option<[f64; 2]> {
        let ends = self.carriers.ends[carrier as usize];
        let [x, y] = self.positions[vertex as usize];
        let [low, high] = [0, 1].map(|end| match self.carriers.at(carrier)[end][1] as f64 - y {
            0.0 => self.cmp(self.chains.vertex_of_point[ends[end] as usize], vertex, 1).is_le(),
            above => above < 0.0,
        });
        if low == high {
            return None;
        }
        let at = self.crossing_x(carrier, y);
        let is_right =
            if (x - at[0]).abs() > at[1] { x > at[0] } else { self.is_right_of(vertex, carrier, low) };
        is_right.then_some(at)
    }
}

/// So many carriers before and after one are tried first.
const NEAR: u32 = 8;

/// d × (v − p): `Greater` when a vertex lies left of a carrier's direction, `Less` when right of it.
pub(crate) fn side_of_carrier(
    carriers: &Carriers,
    carrier: u32,
    (position, w): ([Int<3>; 2], i128),
) -> Ordering {
    let [p, _] = carriers.at(carrier);
    let d = carriers.direction(carrier);
    let offset: [Int<4>; 2] = [0, 1].map(|k| position[k].resize() - Int::from(p[k]) * Int::from(w));
    (Int::from(d[0]) * offset[1]).cmp(&(Int::from(d[1]) * offset[0]))
}

/// Coordinates times the denominator, and the denominator, which is positive: at most 126 and 84 bits.
pub(crate) fn exact_vertex(carriers: &Carriers, source: VertexSource) -> ([Int<3>; 2], i128) {
    match source {
        VertexSource::Point(p) => (carriers.points[p as usize].map(Int::from), 1),
        VertexSource::Crossing([s, t]) => exact_crossing(carriers, s, t),
    }
}

/// p + d · num / den of the first carrier.
pub(crate) fn exact_crossing(carriers: &Carriers, s: u32, t: u32) -> ([Int<3>; 2], i128) {
    let (num, den) = parameter(carriers, s, t);
    let ([p, _], d) = (carriers.at(s), carriers.direction(s));
    ([0, 1].map(|k| Int::from(p[k]) * Int::from(den) + Int::from(d[k]) * Int::from(num)), den)
}
