//! Planar stage 3: the events of every carrier sorted exactly, equal ones unified → vertices and edges.
//!
//! Two definitions of one point always lie next to each other on some carrier, or are joined by a chain of such
//! neighbours: all carriers through the point cross each other there. So no search by position is needed.

use crate::planar::along::{Along, KEY_ERROR, long_axis};
use crate::planar::carriers::Carriers;
use crate::planar::crossings::Crossings;
use crate::planar::events::{Event, sorted_by_place};
use crate::progress::{Cancelled, Course};
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
    /// Vertex of each grid point that ends a segment with length, `NO_VERTEX` for others.
    pub vertex_of_point: Vec<u32>,
    /// Places in `chain` of the first and last vertex of each member of a carrier.
    pub stretches: Vec<[u32; 2]>,
}

/// No vertex.
const NO_VERTEX: u32 = u32::MAX;

/// Where a vertex comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VertexSource {
    Point(u32),
    Crossing([u32; 2]),
}

impl Chains {
    /// O(events log events).
    pub(crate) fn new(carriers: &Carriers, found: Crossings, course: &Course) -> Result<Self, Cancelled> {
        let Crossings { crossings, ranges, lots, .. } = found;
        let parts = course.map(ranges.len(), |range| {
            let first = ranges.carriers(range).start;
            let n = ranges.carriers(range).len();
            let events: Vec<Event> = lots.iter().flat_map(|lot| lot.of_range(range)).collect();
            let (offsets, mut events) = sorted_by_place(n, &events, |e| e.carrier as usize - first);
            let mut part = Part::default();
            for c in 0..n {
                let own = &mut events[offsets[c] as usize..offsets[c + 1] as usize];
                part.push(carriers, &crossings, (first + c) as u32, own);
            }
            part
        })?;
        drop(lots);
        let mut out = Self { offsets: vec![0], ..Self::default() };
        out.chain.reserve(parts.iter().map(|part| part.chain.len()).sum());
        let mut same = Vec::new();
        for part in parts {
            let base = out.chain.len() as u32;
            out.offsets.extend(part.ends.iter().map(|end| base + end));
            out.chain.extend(part.chain);
            same.extend(part.same);
        }
        out.number(carriers.points.len() as u32, &crossings, &same);
        out.find_stretches(carriers);
        Ok(out)
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

    /// Numbers the vertices in the order in which they occur along the carriers.
    fn number(&mut self, n_points: u32, crossings: &[[u32; 2]], same: &[[u32; 2]]) {
        let n = n_points as usize + crossings.len();
        let mut sets = (!same.is_empty()).then(|| UnionFind::new(n));
        if let Some(sets) = &mut sets {
            for &[a, b] in same {
                sets.union(a, b);
            }
        }
        // A grid point represents its set, as its number is smaller than that of any crossing.
        let mut root = |v: u32| sets.as_mut().map_or(v, |s| s.find(v));
        let mut new = vec![NO_VERTEX; n];
        for v in &mut self.chain {
            let root = root(*v);
            let number = &mut new[root as usize];
            if *number == NO_VERTEX {
                *number = self.vertices.len() as u32;
                self.vertices.push(match root.checked_sub(n_points) {
                    None => VertexSource::Point(root),
                    Some(crossing) => VertexSource::Crossing(crossings[crossing as usize]),
                });
            }
            *v = *number;
        }
        self.vertex_of_point = (0..n_points).map(|p| new[root(p) as usize]).collect();
    }

    /// Number of edges of all carriers.
    pub(crate) fn n_edges(&self) -> usize {
        self.chain.len() + 1 - self.offsets.len()
    }

    /// The vertices along a carrier.
    pub(crate) fn along(&self, carrier: u32) -> &[u32] {
        &self.chain[self.offsets[carrier as usize] as usize..self.offsets[carrier as usize + 1] as usize]
    }
}

/// The chains of some carriers, with pairs of vertices that are one point.
#[derive(Default)]
struct Part {
    chain: Vec<u32>,
    ends: Vec<u32>,
    same: Vec<[u32; 2]>,
}

impl Part {
    fn push(&mut self, carriers: &Carriers, crossings: &[[u32; 2]], carrier: u32, events: &mut [Event]) {
        let n_points = carriers.points.len() as u32;
        let along = |v: u32| match v.checked_sub(n_points) {
            None => Along::point(carriers, carrier, v),
            Some(i) => {
                let [s, t] = crossings[i as usize];
                Along::crossing(carriers, carrier, if s == carrier { t } else { s })
            }
        };
        events.sort_unstable_by(|a, b| a.key.total_cmp(&b.key).then_with(|| a.vertex.cmp(&b.vertex)));
        let ends = carriers.ends[carrier as usize];
        self.chain.push(ends[0]);
        let first = self.chain.len();
        // Keys that are too close to trust are put in order exactly, and equal points joined.
        let close = |a: &Event, b: &Event| b.key - a.key <= 2.0 * KEY_ERROR;
        let mut begin = 0;
        while begin < events.len() {
            let mut end = begin + 1;
            while end < events.len() && close(&events[end - 1], &events[end]) {
                end += 1;
            }
            let near = &mut events[begin..end];
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
