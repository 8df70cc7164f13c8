//! Planar stage 3: the events of every carrier sorted exactly, equal ones unified → vertices and edges.
//!
//! Two definitions of one point always lie next to each other on some carrier, or are joined by a chain of such
//! neighbours: all carriers through the point cross each other there. So no search by position is needed.

use crate::counting::sorted_by_place;
use crate::parallel;
use crate::planar::along::{Along, KEY_ERROR, long_axis};
use crate::planar::carriers::Carriers;
use crate::planar::crossings::Crossings;
use crate::planar::events::Event;
use crate::planar::numbering::Numbering;
use crate::progress::{Cancelled, Course};
use std::ops::Range;

/// Vertices along carriers.
#[derive(Debug, Default)]
pub(crate) struct Chains {
    /// What each vertex is: a grid point, or a crossing of two carriers.
    pub vertices: Vec<Source>,
    /// Vertices of all carriers, from one end to the other.
    pub chain: Vec<u32>,
    /// Where each carrier begins in `chain`; its edges are the steps of its stretch.
    pub offsets: Vec<u32>,
    /// Vertex of each grid point that ends a segment with length, `u32::MAX` for others.
    pub vertex_of_point: Vec<u32>,
    /// Places in `chain` of the first and last vertex of each member of a carrier.
    pub stretches: Vec<[u32; 2]>,
}

/// A [`VertexSource`] in two numbers: the carriers of a crossing, or twice a grid point.
pub(crate) type Source = [u32; 2];

/// Where a vertex comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VertexSource {
    Point(u32),
    Crossing([u32; 2]),
}

impl From<Source> for VertexSource {
    fn from([a, b]: Source) -> Self {
        if a == b { Self::Point(a) } else { Self::Crossing([a, b]) }
    }
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
            let mut part = Part { first_carrier: first as u32, ..Part::default() };
            part.chain.reserve_exact(events.len() + 2 * n);
            for c in 0..n {
                let own = &mut events[offsets[c] as usize..offsets[c + 1] as usize];
                part.push(carriers, &crossings, (first + c) as u32, own);
            }
            part
        })?;
        drop(lots);
        let mut offsets = Vec::with_capacity(carriers.ends.len() + 1);
        offsets.push(0);
        for part in &parts {
            let base = offsets[part.first_carrier as usize];
            offsets.extend(part.ends.iter().map(|end| base + end));
        }
        let mut out = Self { offsets, ..Self::default() };
        Numbering::new(carriers, &crossings, parts).finish(&mut out);
        out.find_stretches(carriers);
        Ok(out)
    }

    /// Most members are whole carriers; the places of the others are looked up a carrier at a time, all in one pass.
    fn find_stretches(&mut self, carriers: &Carriers) {
        let whole = |c: u32| [self.offsets[c as usize], self.offsets[c as usize + 1] - 1];
        let members = &carriers.members;
        self.stretches = parallel::map_light(members.len(), |i| whole(members[i].carrier));
        if members.len() == carriers.ends.len() {
            return;
        }
        let is_part = |&i: &usize| members[i].ends != carriers.ends[members[i].carrier as usize];
        let mut parts: Vec<usize> = (0..members.len()).filter(is_part).collect();
        parts.sort_by_key(|&i| members[i].carrier);
        let mut place_of = vec![0; if parts.is_empty() { 0 } else { self.vertices.len() }];
        for same in parts.chunk_by(|&i, &j| members[i].carrier == members[j].carrier) {
            let carrier = members[same[0]].carrier;
            for (&v, place) in self.along(carrier).iter().zip(self.offsets[carrier as usize]..) {
                place_of[v as usize] = place;
            }
            for &i in same {
                self.stretches[i] =
                    members[i].ends.map(|p| place_of[self.vertex_of_point[p as usize] as usize]);
            }
        }
    }

    /// What a vertex is.
    pub(crate) fn source(&self, vertex: u32) -> VertexSource {
        self.vertices[vertex as usize].into()
    }

    /// Number of edges of all carriers.
    pub(crate) fn n_edges(&self) -> usize {
        self.chain.len() + 1 - self.offsets.len()
    }

    /// The edges along a carrier, numbered from one carrier to the next.
    pub(crate) fn edges_along(&self, carrier: u32) -> Range<u32> {
        self.offsets[carrier as usize] - carrier..self.offsets[carrier as usize + 1] - carrier - 1
    }

    /// The vertices along a carrier.
    pub(crate) fn along(&self, carrier: u32) -> &[u32] {
        &self.chain[self.offsets[carrier as usize] as usize..self.offsets[carrier as usize + 1] as usize]
    }
}

/// The chains of some carriers, with pairs of vertices that are one point.
#[derive(Default)]
pub(super) struct Part {
    pub first_carrier: u32,
    /// Crossings bear the mark `FIRST` on the first of their carriers.
    pub chain: Vec<u32>,
    /// Where each carrier's chain ends.
    pub ends: Vec<u32>,
    pub same: Vec<[u32; 2]>,
}

impl Part {
    /// The carriers with their chains.
    pub(super) fn chains(&self) -> impl Iterator<Item = (u32, &[u32])> + '_ {
        let begins = std::iter::once(&0).chain(&self.ends);
        let chains = begins.zip(&self.ends).map(|(&from, &to)| &self.chain[from as usize..to as usize]);
        (self.first_carrier..).zip(chains)
    }

    fn push(&mut self, carriers: &Carriers, crossings: &[[u32; 2]], carrier: u32, events: &mut [Event]) {
        let n_points = carriers.points.len() as u32;
        let along = |e: &Event| match e.id().checked_sub(n_points) {
            None => Along::point(carriers, carrier, e.id()),
            Some(i) => {
                let [s, t] = crossings[i as usize];
                Along::crossing(carriers, carrier, if s == carrier { t } else { s })
            }
        };
        events.sort_unstable_by(|a, b| a.key.total_cmp(&b.key).then_with(|| a.id().cmp(&b.id())));
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
                near.sort_by(|a, b| along(a).cmp(&along(b)).then(a.id().cmp(&b.id())));
            }
            self.chain.push(near[0].vertex);
            for w in near.windows(2) {
                let [a, b] = [&w[0], &w[1]];
                if a.id() != b.id() && along(a).cmp(&along(b)).is_eq() {
                    self.same.push([a.id(), b.id()]);
                } else if a.id() != b.id() {
                    self.chain.push(b.vertex);
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
