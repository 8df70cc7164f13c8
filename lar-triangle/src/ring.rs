//! The ring of corners that ear clipping works on: one cyclic list, holes joined to the outer loop by bridges.
//!
//! ```text
//!    +--------------+        A bridge p–m is walked twice: its ends get copies p', m'.
//!    |   p+---+     |
//!    m---/|   |     |        … → m → p → (hole) → p' → m' → …
//!    |    +---+     |
//!    +--------------+        A hole that shares a point with the rest is spliced in there without a bridge.
//! ```
//!
//! Every bridge goes from the leftmost corner of a hole to a corner that it sees, found from the nearest edge to its
//! left (Eberly, "Triangulation by ear clipping"). The edges are indexed by horizontal slabs, O(n) entries in all,
//! so that a hole looks at few of them; in the worst case, when the edges are as tall as the face, at all of them.
//! Positions of the hits are rounded: a bridge that touches something by rounding costs a badly shaped triangle,
//! never a broken law.

use crate::flat::Flat;
use crate::predicates::{Xy, in_closed_triangle, orient};

const NONE: u32 = u32::MAX;

/// A cyclic list of nodes, each a corner of the face; corners at the ends of bridges have several nodes.
#[derive(Debug, Default)]
pub(crate) struct Ring {
    pub(crate) prev: Vec<u32>,
    pub(crate) next: Vec<u32>,
    /// Corner of each node; the first nodes are the corners themselves.
    pub(crate) corner: Vec<u32>,
    /// Next node with the same point, in a list that starts at the point's first corner.
    copy: Vec<u32>,
    loop_of: Vec<u32>,
    merged: Vec<bool>,
    /// Loops merged whose corners have not been looked at yet.
    fresh: Vec<u32>,
    slabs: Slabs,
}

impl Ring {
    /// Joins the loops of a face, whose points are identified, to one ring.
    pub(crate) fn join(&mut self, flat: &Flat) {
        self.reset(flat);
        if flat.n_loops() < 2 {
            return;
        }
        self.slabs.fill(flat);
        self.merge(0, flat);
        for hole in holes_from_left(flat) {
            if !self.merged[self.loop_of[hole as usize] as usize] {
                let to = self.visible(hole, flat);
                self.bridge(hole, to, flat);
                self.merge(self.loop_of[hole as usize], flat);
            }
        }
    }

    fn reset(&mut self, flat: &Flat) {
        let n = flat.ids.len();
        self.prev.clear();
        self.next.clear();
        self.loop_of.clear();
        self.prev.resize(n, 0);
        for (l, range) in (0u32..).zip(flat.loops()) {
            self.loop_of.extend(range.map(|_| l));
        }
        self.next.extend(flat.edges().map(|(_, to)| to));
        for (from, &to) in (0u32..).zip(&self.next) {
            self.prev[to as usize] = from;
        }
        self.corner.clear();
        self.corner.extend((0u32..).take(n));
        self.copy.clear();
        self.copy.resize(n, NONE);
        for i in (0..n as u32).filter(|&i| flat.twin[i as usize] != i) {
            self.add_copy(i, flat);
        }
        self.merged.clear();
        self.merged.resize(flat.n_loops(), false);
    }

    /// Enters a node into the list of nodes with its point.
    fn add_copy(&mut self, node: u32, flat: &Flat) {
        let first = flat.twin[self.corner[node as usize] as usize] as usize;
        self.copy[node as usize] = self.copy[first];
        self.copy[first] = node;
    }

    /// The nodes with the point of a corner that are in the ring.
    fn nodes_at(&self, corner: u32, flat: &Flat) -> impl Iterator<Item = u32> + '_ {
        std::iter::successors(Some(flat.twin[corner as usize]), |&i| {
            Some(self.copy[i as usize]).filter(|&i| i != NONE)
        })
        .filter(|&i| self.merged[self.loop_of[i as usize] as usize])
    }

    /// Marks a loop as part of the ring, and splices in all loops that share points with it, and so on.
    fn merge(&mut self, l: u32, flat: &Flat) {
        self.merged[l as usize] = true;
        self.fresh.push(l);
        while let Some(l) = self.fresh.pop() {
            for corner in flat.starts[l as usize]..flat.starts[l as usize + 1] {
                let mut node = flat.twin[corner as usize];
                while node != NONE {
                    let other = self.loop_of[node as usize];
                    if !self.merged[other as usize] {
                        self.splice(corner, node, flat);
                        self.merged[other as usize] = true;
                        self.fresh.push(other);
                    }
                    node = self.copy[node as usize];
                }
            }
        }
    }

    /// Joins the loop of `node` to the ring at the ring's node with the same point.
    fn splice(&mut self, corner: u32, node: u32, flat: &Flat) {
        let ahead = self.at(self.next[node as usize], flat);
        let ring = self.facing(corner, ahead, flat);
        let (after_ring, after_node) = (self.next[ring as usize], self.next[node as usize]);
        self.link(ring, after_node);
        self.link(node, after_ring);
    }

    /// Joins a hole to the ring by a bridge walked twice.
    fn bridge(&mut self, hole: u32, to: u32, flat: &Flat) {
        let [hole_copy, to_copy] = [hole, to].map(|node| {
            let copy = self.corner.len() as u32;
            self.corner.push(self.corner[node as usize]);
            self.loop_of.push(self.loop_of[node as usize]);
            self.copy.push(NONE);
            self.next.push(copy);
            self.prev.push(copy);
            self.add_copy(copy, flat);
            copy
        });
        self.link(self.prev[hole as usize], hole_copy);
        self.link(to_copy, self.next[to as usize]);
        self.link(to, hole);
        self.link(hole_copy, to_copy);
    }

    fn link(&mut self, from: u32, to: u32) {
        self.next[from as usize] = to;
        self.prev[to as usize] = from;
    }

    fn at(&self, node: u32, flat: &Flat) -> Xy {
        flat.xy[self.corner[node as usize] as usize]
    }

    /// The ring's node at a corner's point whose inner angle holds the direction to `p`; any of them when none does.
    fn facing(&self, corner: u32, p: Xy, flat: &Flat) -> u32 {
        let inner = |&node: &u32| {
            let [a, b, c] =
                [self.prev[node as usize], node, self.next[node as usize]].map(|i| self.at(i, flat));
            let (left_in, left_out) = (orient(a, b, p) > 0.0, orient(b, c, p) > 0.0);
            if orient(a, b, c) > 0.0 { left_in && left_out } else { left_in || left_out }
        };
        let found = self.nodes_at(corner, flat).find(inner);
        found.or_else(|| self.nodes_at(corner, flat).next()).unwrap_or(0)
    }

    /// A node of the ring that the leftmost corner of a hole sees to its left.
    fn visible(&self, hole: u32, flat: &Flat) -> u32 {
        let p = flat.xy[hole as usize];
        let in_ring = |i: u32| self.merged[self.loop_of[i as usize] as usize];
        let mut nearest: Option<(f64, u32)> = None;
        for &from in self.slabs.range(p[1], p[1]) {
            let to = self.slabs.ends[from as usize];
            let (s, t) = (flat.xy[from as usize], flat.xy[to as usize]);
            if !in_ring(from) || s[1] <= t[1] || s[1] < p[1] || p[1] < t[1] {
                continue;
            }
            let x = s[0] + (t[0] - s[0]) * ((s[1] - p[1]) / (s[1] - t[1]));
            if x <= p[0] && nearest.is_none_or(|(best, _)| best < x) {
                nearest = Some((x, if s[0] < t[0] { from } else { to }));
            }
        }
        let Some((x, end)) = nearest else { return self.facing(0, p, flat) };
        let end = self.flattest(hole, x, end, flat);
        self.facing(end, p, flat)
    }

    /// Of the corners in the triangle of p, the hit at `x` to its left, and `end`, the one nearest to the horizontal.
    fn flattest(&self, hole: u32, x: f64, end: u32, flat: &Flat) -> u32 {
        let (p, e) = (flat.xy[hole as usize], flat.xy[end as usize]);
        let slope = |v: Xy| ((v[1] - p[1]) / (p[0] - v[0])).abs();
        let below = e[1] < p[1];
        let triangle = if below { [p, [x, p[1]], e] } else { [p, e, [x, p[1]]] };
        let own = self.loop_of[hole as usize];
        let mut best = (slope(e), p[0] - e[0], end);
        for &i in self.slabs.range(p[1].min(e[1]), p[1].max(e[1])) {
            let v = flat.xy[i as usize];
            let l = self.loop_of[i as usize];
            // A triangle without height holds its whole line: what lies to the right is left out by itself.
            let inside = v[0] < p[0] && in_closed_triangle(triangle, v);
            if l == own || !self.merged[l as usize] || !inside {
                continue;
            }
            let here = (slope(v), p[0] - v[0], i);
            if here.0 < best.0 || (here.0 == best.0 && here.1 < best.1) {
                best = here;
            }
        }
        best.2
    }
}

/// The leftmost corner of each hole (the lowest such), holes from left to right.
fn holes_from_left(flat: &Flat) -> Vec<u32> {
    let order = |&i: &u32, &j: &u32| {
        let (a, b) = (flat.xy[i as usize], flat.xy[j as usize]);
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(i.cmp(&j))
    };
    let mut holes: Vec<u32> = flat.loops().skip(1).filter_map(|range| range.min_by(order)).collect();
    holes.sort_unstable_by(order);
    holes
}

/// The loop edges by the horizontal slabs that they meet.
#[derive(Debug, Default)]
struct Slabs {
    low: f64,
    per_unit: f64,
    offsets: Vec<u32>,
    edges: Vec<u32>,
    /// End corner of the edge that starts at each corner.
    ends: Vec<u32>,
}

impl Slabs {
    fn fill(&mut self, flat: &Flat) {
        let n = flat.xy.len();
        let (low, high) = flat.xy.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p[1]), h.max(p[1])));
        self.ends.clear();
        self.ends.extend(flat.edges().map(|(_, to)| to));
        let rise: f64 =
            flat.edges().map(|(i, j)| (flat.xy[i as usize][1] - flat.xy[j as usize][1]).abs()).sum();
        // So many slabs that all edges together meet about 2n of them.
        let slabs = if rise > 0.0 {
            (2.0 * n as f64 * (high - low) / rise).clamp(1.0, n as f64).floor()
        } else {
            1.0
        };
        self.low = low;
        self.per_unit = if low < high { slabs / (high - low) } else { 0.0 };
        self.offsets.clear();
        self.offsets.resize(slabs as usize + 2, 0);
        self.each_entry(flat, |offsets, _, slab, _| offsets[slab + 2] += 1);
        for slab in 1..self.offsets.len() {
            self.offsets[slab] += self.offsets[slab - 1];
        }
        let total = self.offsets.last().map_or(0, |&t| t as usize);
        self.edges.clear();
        self.edges.resize(total, 0);
        self.each_entry(flat, |offsets, edges, slab, edge| {
            edges[offsets[slab + 1] as usize] = edge;
            offsets[slab + 1] += 1;
        });
    }

    fn each_entry(&mut self, flat: &Flat, mut entry: impl FnMut(&mut [u32], &mut [u32], usize, u32)) {
        for (from, to) in flat.edges() {
            let (a, b) = (self.slab(flat.xy[from as usize][1]), self.slab(flat.xy[to as usize][1]));
            for slab in a.min(b)..=a.max(b) {
                entry(&mut self.offsets, &mut self.edges, slab, from);
            }
        }
    }

    fn slab(&self, y: f64) -> usize {
        let last = self.offsets.len() - 2;
        (((y - self.low) * self.per_unit) as usize).min(last - 1)
    }

    /// The edges that meet the slabs between two heights.
    fn range(&self, low: f64, high: f64) -> &[u32] {
        let (a, b) = (self.slab(low), self.slab(high));
        &self.edges[self.offsets[a] as usize..self.offsets[b + 1] as usize]
    }
}
