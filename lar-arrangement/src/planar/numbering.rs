//! Planar stage 3b: vertices numbered in the order in which they occur along the carriers.
//!
//! Where a vertex occurs first is known without a search: a crossing on the first of its carriers, a grid point on the
//! first one that holds it. Only the few vertices that are one point with others are looked up. So the numbers that
//! each part of the chains begins with are sums of counts, and the parts are numbered independently.

use crate::counting::offsets;
use crate::parallel;
use crate::planar::carriers::{Carriers, Member};
use crate::planar::chains::{Chains, Part, Source};
use crate::planar::events::FIRST;
use crate::union_find::UnionFind;
use std::sync::atomic::Ordering::Relaxed;

pub(super) struct Numbering<'a> {
    n_points: u32,
    crossings: &'a [[u32; 2]],
    parts: Vec<Part>,
    /// The first carrier that holds each grid point.
    first_carrier: Vec<u32>,
    joined: Joined,
    /// Of each part the places in it where a vertex occurs first that is one with others.
    firsts: Vec<Vec<u32>>,
}

/// Vertices that are one point with others, if there are any.
struct Joined {
    is_joined: Vec<bool>,
    sets: UnionFind,
}

impl Joined {
    fn new(n: usize, parts: &[Part]) -> Self {
        let same = || parts.iter().flat_map(|part| &part.same);
        if same().next().is_none() {
            return Self { is_joined: Vec::new(), sets: UnionFind::new(0) };
        }
        let mut out = Self { is_joined: vec![false; n], sets: UnionFind::new(n) };
        for &[a, b] in same() {
            out.sets.union(a, b);
            out.is_joined[a as usize] = true;
            out.is_joined[b as usize] = true;
        }
        out
    }

    fn contains(&self, v: u32) -> bool {
        !self.is_joined.is_empty() && self.is_joined[v as usize]
    }

    /// A grid point represents its set, as its number is smaller than that of any crossing.
    fn root(&self, v: u32) -> u32 {
        if self.contains(v) { self.sets.root(v) } else { v }
    }

    /// Of each part the places in it where a set occurs first.
    fn firsts(&self, parts: &[Part]) -> Vec<Vec<u32>> {
        if self.is_joined.is_empty() {
            return vec![Vec::new(); parts.len()];
        }
        let mut found = parallel::map(parts.len(), |i| {
            let places = (0..).zip(&parts[i].chain);
            places.filter(|(_, v)| self.contains(**v & !FIRST)).map(|(place, _)| place).collect::<Vec<u32>>()
        });
        let mut is_known = vec![false; self.is_joined.len()];
        for (places, part) in found.iter_mut().zip(parts) {
            let root = |place: u32| self.root(part.chain[place as usize] & !FIRST) as usize;
            places.retain(|&place| !std::mem::replace(&mut is_known[root(place)], true));
        }
        found
    }
}

/// Of each grid point the first carrier that it ends, or a member of it.
fn first_carriers(carriers: &Carriers) -> Vec<u32> {
    let mut out = vec![u32::MAX; carriers.points.len()];
    // By members, whose ends lie side by side in memory, and are ends of their carriers or inside them.
    for &Member { carrier, ends, .. } in &carriers.members {
        ends.iter().for_each(|&p| {
            let first = &mut out[p as usize];
            *first = carrier.min(*first);
        });
    }
    out
}

/// Grid points inside carriers, of which there are few in most drawings, with these.
fn touches(part: &Part, n_points: u32) -> Vec<(u32, u32)> {
    let mut found = Vec::new();
    for (carrier, chain) in part.chains() {
        let inside = chain[1..chain.len() - 1].iter().filter(|&&v| v & !FIRST < n_points);
        found.extend(inside.map(|&p| (p, carrier)));
    }
    found
}

impl<'a> Numbering<'a> {
    pub(super) fn new(carriers: &Carriers, crossings: &'a [[u32; 2]], parts: Vec<Part>) -> Self {
        let n_points = carriers.points.len() as u32;
        let joined = Joined::new(n_points as usize + crossings.len(), &parts);
        let firsts = joined.firsts(&parts);
        let (mut first_carrier, touches) = parallel::join(
            || first_carriers(carriers),
            || parallel::map(parts.len(), |i| touches(&parts[i], n_points)).into_iter().flatten(),
        );
        for (p, carrier) in touches {
            let first = &mut first_carrier[p as usize];
            *first = carrier.min(*first);
        }
        Self { n_points, crossings, parts, first_carrier, joined, firsts }
    }

    /// The vertices that occur first in a part, in their order.
    fn first_vertices(&self, part: usize) -> Vec<u32> {
        let mut found = Vec::with_capacity(self.parts[part].chain.len());
        let mut firsts = self.firsts[part].iter().peekable();
        let mut place = 0;
        for (carrier, chain) in self.parts[part].chains() {
            for &marked in chain {
                let v = marked & !FIRST;
                let is_first = if self.joined.contains(v) {
                    firsts.next_if(|&&first| first == place as u32).is_some()
                } else if v < self.n_points {
                    self.first_carrier[v as usize] == carrier
                } else {
                    marked & FIRST != 0
                };
                if is_first {
                    found.push(self.joined.root(v));
                }
                place += 1;
            }
        }
        found.shrink_to_fit();
        found
    }

    fn source(&self, v: u32) -> Source {
        v.checked_sub(self.n_points).map_or([v; 2], |crossing| self.crossings[crossing as usize])
    }

    /// Fills the chains, the vertices, and the vertices of the grid points.
    pub(super) fn finish(self, out: &mut Chains) {
        let firsts = parallel::map(self.parts.len(), |part| self.first_vertices(part));
        let begins = offsets(firsts.iter().map(|firsts| firsts.len() as u32));
        let n = self.n_points as usize + self.crossings.len();
        // One more than the number of each, so that 0 is none.
        let new = parallel::atomic_zeros(n);
        out.vertices = vec![[0; 2]; begins[firsts.len()] as usize];
        let stretches = parallel::cut(&mut out.vertices, firsts.iter().map(Vec::len));
        parallel::each(
            stretches.into_iter().zip(&firsts).zip(&begins).collect(),
            |((stretch, firsts), &begin)| {
                for ((source, &v), number) in stretch.iter_mut().zip(firsts).zip(begin..) {
                    new[v as usize].store(number + 1, Relaxed);
                    *source = self.source(v);
                }
            },
        );
        drop(firsts);
        let number = |v: u32| new[self.joined.root(v) as usize].load(Relaxed).wrapping_sub(1);
        out.chain = vec![0; self.parts.iter().map(|part| part.chain.len()).sum()];
        let chains = parallel::cut(&mut out.chain, self.parts.iter().map(|part| part.chain.len()));
        parallel::each(self.parts.iter().zip(chains).collect(), |(part, chain)| {
            chain.iter_mut().zip(&part.chain).for_each(|(to, &v)| *to = number(v & !FIRST));
        });
        out.vertex_of_point = parallel::map_light(self.n_points as usize, |p| number(p as u32));
    }
}
