//! Planar stage 2: where carriers meet. Each meeting becomes an *event* on the carriers it is inside of.
//!
//! Many carriers through one point would make a quadratic number of events. Once eight of them are seen to meet a
//! carrier in one point they are a *bundle*: their other pairs have no other point in common and are passed over.

use crate::boxes::{Aabb, BoxTree};
use crate::kernel::Int;
use crate::parallel;
use crate::planar::carriers::{Carriers, cross};
use std::cmp::Ordering;

/// A point inside a carrier: by its approximate coordinate along the carrier's longer axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Event {
    pub carrier: u32,
    /// A grid point, or (from the number of points on) a crossing.
    pub vertex: u32,
    /// Within `KEY_ERROR` of the exact coordinate.
    pub key: f64,
}

/// p + d · t with |p|, |d| ≤ 2^41, t a quotient of two rounded integers: relative error of t below 2^-51, so
/// 2^-10 for the product, and 2^-12 for its rounding and that of the sum.
pub(crate) const KEY_ERROR: f64 = 1.0 / 512.0;

/// Everything that lies inside carriers.
#[derive(Debug, Default)]
pub(crate) struct Crossings {
    /// The two carriers of each crossing.
    pub crossings: Vec<[u32; 2]>,
    pub events: Vec<Event>,
    pub pairs_tested: u64,
}

const BUNDLE: usize = 8;
const NO_BUNDLE: u32 = u32::MAX;

pub(crate) fn carrier_boxes(carriers: &Carriers) -> Vec<Aabb> {
    (0..carriers.ends.len() as u32)
        .map(|c| Aabb::around(carriers.at(c).map(|[x, y]| [x as f64, y as f64, 0.0])))
        .collect()
}

/// O(n log n + pairs of boxes that meet).
pub(crate) fn crossings(carriers: &Carriers, tree: &BoxTree) -> Crossings {
    let n_points = carriers.points.len() as u32;
    let mut out = Crossings::default();
    for &(carrier, p) in &carriers.stops {
        let key = carriers.points[p as usize][long_axis(carriers.direction(carrier))] as f64;
        out.events.push(Event { carrier, vertex: p, key });
    }
    let mut bundles = vec![NO_BUNDLE; carriers.ends.len()];
    let mut n_bundles = 0;
    let n_blocks = tree.n_blocks();
    let (mut done, mut step) = (0, 4);
    // Early rounds are short, so that bundles are known before most pairs are looked at.
    while done < n_blocks {
        let round = step.min(n_blocks - done);
        let (n_chunks, range) = parallel::chunks(round, 64);
        let parts = parallel::map(n_chunks, |chunk| {
            let mut found = Found::default();
            for block in range(chunk) {
                let first_event = found.events.len();
                tree.pairs_of_block(done + block, |i, j| {
                    found.pairs += 1;
                    let (a, b) = (bundles[i as usize], bundles[j as usize]);
                    if a == NO_BUNDLE || a != b {
                        found.meet(carriers, i, j);
                    }
                });
                if found.events.len() - first_event >= 2 * BUNDLE {
                    let pivot = tree.first_of_block(done + block);
                    found.bundles.extend(found.bundles_at(carriers, pivot, first_event));
                }
            }
            found
        });
        for part in parts {
            let base = n_points + out.crossings.len() as u32;
            for bundle in &part.bundles {
                for &carrier in bundle {
                    let mark = &mut bundles[carrier as usize];
                    *mark = if *mark == NO_BUNDLE { n_bundles } else { *mark };
                }
                n_bundles += 1;
            }
            let moved = |v: u32| if v & CROSSING == 0 { v } else { base + (v ^ CROSSING) };
            out.events.extend(part.events.iter().map(|e| Event { vertex: moved(e.vertex), ..*e }));
            out.crossings.extend(part.crossings);
            out.pairs_tested += part.pairs;
        }
        done += round;
        step *= 2;
    }
    out
}

/// Marks vertices that are crossings of the same chunk.
const CROSSING: u32 = 1 << 31;

#[derive(Default)]
struct Found {
    crossings: Vec<[u32; 2]>,
    events: Vec<Event>,
    /// Carriers through one point.
    bundles: Vec<Vec<u32>>,
    pairs: u64,
}

impl Found {
    fn meet(&mut self, carriers: &Carriers, s: u32, t: u32) {
        let ([p, q], [r, w]) = (carriers.at(s), carriers.at(t));
        let (ends_s, ends_t) = (carriers.ends[s as usize], carriers.ends[t as usize]);
        if ends_s.iter().any(|p| ends_t.contains(p)) {
            // Two carriers are not in one line, or do not touch: an end in common is all they have.
            return;
        }
        let (ds, dt) = (carriers.direction(s), carriers.direction(t));
        let from = |a: [i64; 2], b: [i64; 2]| [b[0] - a[0], b[1] - a[1]];
        let (to_r, to_w) = (cross(ds, from(p, r)), cross(ds, from(p, w)));
        if same_side(to_r, to_w) {
            return;
        }
        let (to_p, to_q) = (cross(dt, from(r, p)), cross(dt, from(r, q)));
        if same_side(to_p, to_q) {
            return;
        }
        if to_r != 0 && to_w != 0 && to_p != 0 && to_q != 0 {
            let vertex = CROSSING | self.crossings.len() as u32;
            self.crossings.push([s, t]);
            self.events.push(Event { carrier: s, vertex, key: key(p, ds, to_p, to_q) });
            self.events.push(Event { carrier: t, vertex, key: key(r, dt, to_r, to_w) });
            return;
        }
        self.touch(carriers, s, [to_p, to_q], carriers.ends[t as usize], [to_r, to_w]);
        self.touch(carriers, t, [to_r, to_w], carriers.ends[s as usize], [to_p, to_q]);
    }

    /// An end of another carrier lies inside this one when it is on its line and the ends of this one lie strictly
    /// on either side of the other.
    fn touch(&mut self, carriers: &Carriers, carrier: u32, sides: [i128; 2], ends: [u32; 2], on: [i128; 2]) {
        if sides[0].signum() * sides[1].signum() < 0 {
            for (vertex, _) in ends.into_iter().zip(on).filter(|(_, side)| *side == 0) {
                let key = carriers.points[vertex as usize][long_axis(carriers.direction(carrier))] as f64;
                self.events.push(Event { carrier, vertex, key });
            }
        }
    }

    /// Carriers that meet the pivot in one point become a bundle. `at_pivot` are the events found with the pivot as
    /// the first carrier of the pair, with the other carrier.
    fn bundles_at(&self, carriers: &Carriers, pivot: u32, first_event: usize) -> Vec<Vec<u32>> {
        let mut met: Vec<(Event, u32)> = Vec::new();
        for e in self.events[first_event..].iter().filter(|e| e.carrier == pivot && e.vertex & CROSSING != 0)
        {
            let [s, t] = self.crossings[(e.vertex ^ CROSSING) as usize];
            met.push((*e, if s == pivot { t } else { s }));
        }
        if met.len() < BUNDLE {
            return Vec::new();
        }
        met.sort_by(|a, b| a.0.key.total_cmp(&b.0.key));
        let along = |other: u32| Along::crossing(carriers, pivot, other);
        met.chunk_by(|a, b| b.0.key - a.0.key <= 2.0 * KEY_ERROR && along(a.1).cmp(&along(b.1)).is_eq())
            .filter(|same| same.len() >= BUNDLE)
            .map(|same| same.iter().map(|(_, other)| *other).chain([pivot]).collect())
            .collect()
    }
}

fn same_side(a: i128, b: i128) -> bool {
    (a > 0 && b > 0) || (a < 0 && b < 0)
}

pub(crate) fn long_axis(direction: [i64; 2]) -> usize {
    usize::from(direction[1].abs() > direction[0].abs())
}

/// Approximate coordinate of the point where a carrier's sides to another one's line change from a to b.
fn key(start: [i64; 2], direction: [i64; 2], a: i128, b: i128) -> f64 {
    let axis = long_axis(direction);
    let t = a as f64 / (a - b) as f64;
    start[axis] as f64 + direction[axis] as f64 * t
}

/// The exact place of a point along a carrier: a + d · num / den with den > 0, all along the carrier's longer axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along {
    start: i64,
    direction: i64,
    num: i128,
    den: i128,
}

impl Along {
    /// A grid point on the carrier.
    pub(crate) fn point(carriers: &Carriers, carrier: u32, p: u32) -> Self {
        let axis = long_axis(carriers.direction(carrier));
        Self { start: carriers.points[p as usize][axis], direction: 0, num: 0, den: 1 }
    }

    /// The crossing with another carrier.
    pub(crate) fn crossing(carriers: &Carriers, carrier: u32, other: u32) -> Self {
        let direction = carriers.direction(carrier);
        let axis = long_axis(direction);
        let (num, den) = parameter(carriers, carrier, other);
        Self { start: carriers.at(carrier)[0][axis], direction: direction[axis], num, den }
    }

    /// Order of two points of one carrier. The coordinates differ by d · (num / den − num' / den') when both are
    /// crossings; a grid point's coordinate is an integer.
    pub(crate) fn cmp(&self, other: &Self) -> Ordering {
        match (self.direction, other.direction) {
            (0, 0) => self.start.cmp(&other.start),
            (0, _) => other.cmp(self).reverse(),
            (_, 0) => {
                // 41 + 84 bits.
                let offset = i128::from(other.start - self.start);
                (i128::from(self.direction) * self.num).cmp(&(offset * self.den))
            }
            (d, _) => {
                let product = |a: i128, b: i128| Int::<3>::from(a) * Int::from(b);
                let order = product(self.num, other.den).cmp(&product(other.num, self.den));
                if d < 0 { order.reverse() } else { order }
            }
        }
    }
}

/// Where a carrier crosses another's line, as a fraction num / den of its length, den > 0. At most 84 bits each.
pub(crate) fn parameter(carriers: &Carriers, carrier: u32, other: u32) -> (i128, i128) {
    let ([p, q], [r, _]) = (carriers.at(carrier), carriers.at(other));
    let direction = carriers.direction(other);
    let side = |x: [i64; 2]| cross(direction, [x[0] - r[0], x[1] - r[1]]);
    let (a, b) = (side(p), side(q));
    if a > b { (a, a - b) } else { (-a, b - a) }
}
