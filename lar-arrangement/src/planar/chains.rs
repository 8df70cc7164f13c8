//! Planar stage 3: the events of every carrier sorted exactly, equal ones unified → vertices and edges.
//!
//! Two definitions of one point always lie next to each other on some carrier, or are joined by a chain of such
//! neighbours: all carriers through the point cross each other there. So no search by position is needed.

use crate::parallel;
use crate::planar::carriers::Carriers;
use crate::planar::crossings::{Along, Crossings, Event, KEY_ERROR, long_axis};
use crate::union_find::UnionFind;

/// Vertices along carriers.
#[derive(Debug, Default)]
pub(crate) struct Chains {
    /// What each vertex is: a grid point, or a crossing of two carriers.
    pub vertices: Vec<VertexSource>,
    /// Vertices of all carriers, from one end to the other.
    pub chain: Vec<u32>,
    /// Where each carrier begins in `chain`; its edges are the steps of its stretch.
    pub offsets: Vec<u32>,
    /// Vertex of each grid point that ends a segment.
    pub vertex_of_point: Vec<u32>,
    /// Places in `chain` of the first and last vertex of each member of a carrier.
    pub stretches: Vec<[u32; 2]>,
}

/// Where a vertex comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VertexSource {
    Point(u32),
    Crossing([u32; 2]),
}

impl Chains {
    /// O(events log events).
    pub(crate) fn new(carriers: &Carriers, crossings: Crossings) -> Self {
        let n_points = carriers.points.len() as u32;
        let n = carriers.ends.len();
        let Crossings { crossings: sources, events, .. } = crossings;
        let (offsets, events) = by_carrier(n, &events);
        let sources = &sources;
        let (n_chunks, range) = parallel::chunks(n, 256);
        let parts = parallel::map(n_chunks, |chunk| {
            let mut part = Part::default();
            for c in range(chunk) {
                part.push(carriers, sources, c as u32, &events[offsets[c] as usize..offsets[c + 1] as usize]);
            }
            part
        });
        drop(events);
        let mut out = Self { offsets: vec![0], ..Self::default() };
        let mut same = Vec::new();
        for part in parts {
            let base = out.chain.len() as u32;
            out.offsets.extend(part.ends.iter().map(|end| base + end));
            out.chain.extend(part.chain);
            same.extend(part.same);
        }
        out.number(n_points, sources, &same);
        out.find_stretches(carriers);
        out
    }

    /// Most members are whole carriers; the places of the others are looked up a carrier at a time, all in one pass.
    fn find_stretches(&mut self, carriers: &Carriers) {
        let whole = |c: u32| [self.offsets[c as usize], self.offsets[c as usize + 1] - 1];
        self.stretches = carriers.members.iter().map(|m| whole(m.carrier)).collect();
        let is_part =
            |&i: &usize| carriers.members[i].ends != carriers.ends[carriers.members[i].carrier as usize];
        let mut parts: Vec<usize> = (0..carriers.members.len()).filter(is_part).collect();
        parts.sort_by_key(|&i| carriers.members[i].carrier);
        let mut place_of = vec![0; if parts.is_empty() { 0 } else { self.vertices.len() }];
        for same in parts.chunk_by(|&i, &j| carriers.members[i].carrier == carriers.members[j].carrier) {
            let carrier = carriers.members[same[0]].carrier;
            for (&v, place) in self.along(carrier).iter().zip(self.offsets[carrier as usize]..) {
                place_of[v as usize] = place;
            }
            for &i in same {
                self.stretches[i] =
                    carriers.members[i].ends.map(|p| place_of[self.vertex_of_point[p as usize] as usize]);
            }
        }
    }

    /// Numbers the vertices that occur, points first, crossings in the order they were found.
    fn number(&mut self, n_points: u32, crossings: &[[u32; 2]], same: &[[u32; 2]]) {
        let n = n_points as usize + crossings.len();
        let mut used = vec![false; n];
        self.chain.iter().for_each(|&v| used[v as usize] = true);
        let mut new = vec![0; n];
        let mut sets = (!same.is_empty()).then(|| UnionFind::new(n));
        if let Some(sets) = &mut sets {
            for &[a, b] in same {
                sets.union(a, b);
                used[a as usize] = true;
                used[b as usize] = true;
            }
        }
        for v in (0..n).filter(|&v| used[v]) {
            // The representative is the smallest of its set, so it has its number already.
            let root = sets.as_mut().map_or(v as u32, |s| s.find(v as u32));
            if root == v as u32 {
                new[v] = self.vertices.len() as u32;
                self.vertices.push(match (v as u32).checked_sub(n_points) {
                    None => VertexSource::Point(v as u32),
                    Some(crossing) => VertexSource::Crossing(crossings[crossing as usize]),
                });
            } else {
                new[v] = new[root as usize];
            }
        }
        self.chain.iter_mut().for_each(|v| *v = new[*v as usize]);
        new.truncate(n_points as usize);
        self.vertex_of_point = new;
    }

    /// The vertices along a carrier.
    pub(crate) fn along(&self, carrier: u32) -> &[u32] {
        &self.chain[self.offsets[carrier as usize] as usize..self.offsets[carrier as usize + 1] as usize]
    }
}

/// Events by carrier: where each carrier's begin, and the events in that order.
fn by_carrier(n: usize, events: &[Event]) -> (Vec<u32>, Vec<Event>) {
    let mut offsets = vec![0u32; n + 1];
    for e in events {
        offsets[e.carrier as usize + 1] += 1;
    }
    for c in 0..n {
        offsets[c + 1] += offsets[c];
    }
    let mut fill = offsets.clone();
    let mut sorted = vec![Event { carrier: 0, vertex: 0, key: 0.0 }; events.len()];
    for e in events {
        let at = &mut fill[e.carrier as usize];
        sorted[*at as usize] = *e;
        *at += 1;
    }
    (offsets, sorted)
}

/// The chains of some carriers, with pairs of vertices that are one point.
#[derive(Default)]
struct Part {
    chain: Vec<u32>,
    ends: Vec<u32>,
    same: Vec<[u32; 2]>,
    buffer: Vec<Event>,
}

impl Part {
    fn push(&mut self, carriers: &Carriers, crossings: &[[u32; 2]], carrier: u32, events: &[Event]) {
        let n_points = carriers.points.len() as u32;
        let along = |v: u32| match v.checked_sub(n_points) {
            None => Along::point(carriers, carrier, v),
            Some(i) => {
                let [s, t] = crossings[i as usize];
                Along::crossing(carriers, carrier, if s == carrier { t } else { s })
            }
        };
        self.buffer.clear();
        self.buffer.extend_from_slice(events);
        let sorted = &mut self.buffer;
        sorted.sort_unstable_by(|a, b| a.key.total_cmp(&b.key).then_with(|| a.vertex.cmp(&b.vertex)));
        let ends = carriers.ends[carrier as usize];
        self.chain.push(ends[0]);
        let first = self.chain.len();
        // Keys that are too close to trust are put in order exactly, and equal points joined.
        let close = |a: &Event, b: &Event| b.key - a.key <= 2.0 * KEY_ERROR;
        let mut begin = 0;
        while begin < sorted.len() {
            let mut end = begin + 1;
            while end < sorted.len() && close(&sorted[end - 1], &sorted[end]) {
                end += 1;
            }
            let near = &mut sorted[begin..end];
            if near.len() > 1 {
                near.sort_by(|a, b| along(a.vertex).cmp(&along(b.vertex)).then(a.vertex.cmp(&b.vertex)));
            }
            self.chain.push(near[0].vertex);
            for w in near.windows(2) {
                let [a, b] = [w[0].vertex, w[1].vertex];
                if a != b && along(a).cmp(&along(b)).is_eq() {
                    self.same.push([a, b]);
                } else if a != b {
                    self.chain.push(b);
                }
            }
            begin = end;
        }
        let direction = carriers.direction(carrier);
        if direction[long_axis(direction)] < 0 {
            self.chain[first..].reverse();
        }
        self.chain.push(ends[1]);
        self.ends.push(self.chain.len() as u32);
    }
}
