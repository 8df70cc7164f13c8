//! Planar stage 2: where carriers meet. Each meeting becomes an [`Event`] on the carriers it is inside of.

use crate::boxes::{BoxTree, NO_GROUP};
use crate::error::ArrangementError;
use crate::parallel::{self, Team};
use crate::planar::along::{key, long_axis};
use crate::planar::bundles::{BUNDLE, Bundle, Bundles, bundles_at, n_sampled};
use crate::planar::carriers::{Carriers, cross};
use crate::planar::events::{Event, Lot, Ranges};
use crate::progress::{Cancelled, Course};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Everything that lies inside carriers.
#[derive(Debug)]
pub(crate) struct Crossings {
    /// The two carriers of each crossing.
    pub crossings: Vec<[u32; 2]>,
    pub ranges: Ranges,
    pub lots: Vec<Lot>,
    pub pairs_tested: u64,
}

/// `tree` holds the boxes of the carriers, a sample of its blocks first, `bundles` those that are known. O(n log n + pairs
/// of boxes that meet), where pairs of carriers in one large bundle do not count.
///
/// A sample is searched in rounds of growing length, so that bundles are known before most pairs are looked at. A
/// block is paired with what comes after it, so what is left after a round can be laid out anew.
pub(crate) fn crossings(
    carriers: &Carriers,
    tree: &BoxTree<2>,
    bundles: Bundles,
    course: &Course,
    team: &Team,
) -> Result<Crossings, ArrangementError> {
    let sample = n_sampled(tree.items().len());
    let quiet = course.quiet();
    let mut search = Search::new(carriers, bundles, team);
    let mut regrouped = if search.bundles.is_empty() { None } else { Some(search.regrouped(tree.items())?) };
    let (mut begin, mut sampled, mut length) = (0, 0, 1);
    loop {
        let tree = regrouped.as_ref().unwrap_or(tree);
        let n_blocks = tree.n_blocks();
        let end = if sampled < sample { (begin + length).min(n_blocks) } else { n_blocks };
        // Nearly all of the work is in the last round.
        let course = if end == n_blocks { course } else { &quiet };
        let is_news = search.round(tree, begin..end, course)?;
        if end == n_blocks {
            return search.finish();
        }
        (begin, sampled, length) = (end, sampled + end - begin, 2 * length);
        if is_news {
            regrouped = Some(search.regrouped(tree.items_from(begin))?);
            begin = 0;
        }
    }
}

/// What is known after some rounds.
struct Search<'a> {
    carriers: &'a Carriers,
    team: &'a Team,
    bundles: Bundles,
    /// Without the crossings, which are still in parts.
    out: Crossings,
    crossings: Vec<Vec<[u32; 2]>>,
    /// Number of grid points and crossings.
    n_vertices: usize,
    /// So many pairs of carriers are to be expected in a block.
    pairs_a_block: usize,
}

impl<'a> Search<'a> {
    fn new(carriers: &'a Carriers, bundles: Bundles, team: &'a Team) -> Self {
        Self {
            carriers,
            team,
            bundles,
            out: Crossings::with_stops(carriers),
            crossings: Vec::new(),
            n_vertices: carriers.points.len(),
            pairs_a_block: 0,
        }
    }

    /// A tree of some carriers that is laid out for the bundles.
    fn regrouped(&self, items: &[u32]) -> Result<BoxTree<2>, ArrangementError> {
        let Self { carriers, bundles, .. } = self;
        self.team.work(items.len(), || bundles.tree(carriers, items.to_vec()))
    }

    /// Searches some blocks; true when they have told of a large bundle.
    fn round(
        &mut self,
        tree: &BoxTree<2>,
        blocks: Range<usize>,
        course: &Course,
    ) -> Result<bool, ArrangementError> {
        let (n_blocks, expected) = (blocks.len(), self.pairs_a_block * blocks.len());
        // A pair takes as long as several of what else is counted.
        let parts = self
            .team
            .work(8 * expected, || search_blocks(self.carriers, tree, &self.bundles, blocks, course))??;
        let (pairs_before, vertices_before) = (self.out.pairs_tested, self.n_vertices);
        let mut is_news = false;
        for part in parts {
            for bundle in &part.bundles {
                is_news |= self.bundles.learn(bundle);
            }
            self.out.lots.push(part.lot.numbered_from(self.n_vertices as u32));
            self.out.pairs_tested += part.pairs;
            self.n_vertices += part.crossings.len();
            self.crossings.push(part.crossings);
        }
        // Once a bundle is known, only those of its pairs that were kept are to be expected again.
        let pairs = if is_news {
            self.n_vertices - vertices_before
        } else {
            (self.out.pairs_tested - pairs_before) as usize
        };
        self.pairs_a_block = pairs / n_blocks.max(1);
        Ok(is_news)
    }

    fn finish(mut self) -> Result<Crossings, ArrangementError> {
        self.out.crossings = self.team.work(self.n_vertices, || parallel::concat(&self.crossings))?;
        Ok(self.out)
    }
}

/// What is found in some blocks, a chunk of them at a time.
fn search_blocks(
    carriers: &Carriers,
    tree: &BoxTree<2>,
    bundles: &Bundles,
    blocks: Range<usize>,
    course: &Course,
) -> Result<Vec<Part>, Cancelled> {
    let ranges = Ranges::new(carriers.ends.len());
    let size = (blocks.len() / 256).clamp(8, 64);
    let (n_chunks, range) = parallel::chunks(blocks.len(), size);
    course.map(n_chunks, |chunk| {
        let mut found = Found::default();
        for block in range(chunk).take_while(|_| !course.is_cancelled()) {
            found.search(carriers, tree, bundles, blocks.start + block);
        }
        let Found { crossings, events, bundles, pairs, .. } = found;
        Part { crossings, lot: Lot::new(ranges, &events), bundles, pairs }
    })
}

impl Crossings {
    /// The ends of collinear segments inside a carrier.
    fn with_stops(carriers: &Carriers) -> Self {
        let event = |&(carrier, vertex): &(u32, u32)| {
            let key = carriers.points[vertex as usize][long_axis(carriers.direction(carrier))] as f64;
            Event { carrier, vertex, key }
        };
        let events: Vec<Event> = carriers.stops.iter().map(event).collect();
        let ranges = Ranges::new(carriers.ends.len());
        Self { crossings: Vec::new(), ranges, lots: vec![Lot::new(ranges, &events)], pairs_tested: 0 }
    }
}

/// What a chunk of blocks yields.
struct Part {
    crossings: Vec<[u32; 2]>,
    lot: Lot,
    bundles: Vec<Bundle>,
    pairs: u64,
}

#[derive(Default)]
struct Found {
    crossings: Vec<[u32; 2]>,
    events: Vec<Event>,
    bundles: Vec<Bundle>,
    /// The last of these bundles that a carrier is in.
    marks: FxHashMap<u32, u32>,
    pairs: u64,
}

impl Found {
    /// The pairs of a block, without those in one bundle.
    fn search(&mut self, carriers: &Carriers, tree: &BoxTree<2>, bundles: &Bundles, block: usize) {
        let (first_event, first_crossing) = (self.events.len(), self.crossings.len());
        tree.pairs_of_block(block, |i, j| {
            self.pairs += 1;
            if !self.is_in_bundle(bundles, i, j) {
                self.meet(carriers, i, j);
            }
        });
        if self.events.len() - first_event >= 2 * BUNDLE {
            let pivot = tree.first_of_block(block);
            let first_bundle = self.bundles.len();
            for bundle in bundles_at(carriers, pivot, &self.events[first_event..], &self.crossings) {
                let number = self.bundles.len() as u32;
                self.marks.extend(bundle.carriers.iter().map(|&c| (c, number)));
                self.bundles.push(bundle);
            }
            if first_bundle < self.bundles.len() {
                self.forget(pivot, first_bundle as u32, first_crossing, first_event);
            }
        }
    }

    /// Leaves out what a block has found before its bundles were known: pairs of one bundle without the pivot, which
    /// meets both where they meet.
    fn forget(&mut self, pivot: u32, first_bundle: u32, first_crossing: usize, first_event: usize) {
        let is_new = |[s, t]: [u32; 2]| {
            let mark = self.marks.get(&s).filter(|&&mark| first_bundle <= mark);
            s == pivot || t == pivot || mark.is_none() || mark != self.marks.get(&t)
        };
        // In place: what comes before is not looked at again.
        let mut n_crossings = first_crossing;
        let mut numbers = vec![None; self.crossings.len() - first_crossing];
        for old in first_crossing..self.crossings.len() {
            let pair = self.crossings[old];
            if is_new(pair) {
                numbers[old - first_crossing] = Some(n_crossings);
                self.crossings[n_crossings] = pair;
                n_crossings += 1;
            }
        }
        self.crossings.truncate(n_crossings);
        let mut n_events = first_event;
        for old in first_event..self.events.len() {
            let event = self.events[old];
            let kept = match event.crossing_of_lot() {
                None => Some(event),
                Some(crossing) => numbers[crossing - first_crossing].map(|number| event.renumbered(number)),
            };
            if let Some(event) = kept {
                self.events[n_events] = event;
                n_events += 1;
            }
        }
        self.events.truncate(n_events);
    }

    fn is_in_bundle(&self, bundles: &Bundles, i: u32, j: u32) -> bool {
        let bundle = bundles.of(i);
        (bundle != NO_GROUP && bundle == bundles.of(j))
            || (!self.marks.is_empty()
                && self.marks.get(&i).is_some_and(|mark| self.marks.get(&j) == Some(mark)))
    }

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
            let number = self.crossings.len();
            self.crossings.push([s, t]);
            self.events.push(Event::crossing(s, number, s < t, key(p, ds, to_p, to_q)));
            self.events.push(Event::crossing(t, number, t < s, key(r, dt, to_r, to_w)));
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
}

fn same_side(a: i128, b: i128) -> bool {
    (a > 0 && b > 0) || (a < 0 && b < 0)
}
