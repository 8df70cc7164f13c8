//! Planar stage 2b: events, sorted by ranges of carriers as they are found, so that every range's can be gathered
//! on its own.

use crate::counting::sorted_by_place;
use std::ops::Range;

/// A point inside a carrier: by its approximate coordinate along the carrier's longer axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Event {
    pub carrier: u32,
    /// A grid point, or (from the number of points on) a crossing; in a lot the number of a crossing of the lot, marked
    /// with `CROSSING`. There are fewer than 2^30.
    pub vertex: u32,
    /// Within `KEY_ERROR` of the exact coordinate.
    pub key: f64,
}

/// Marks vertices that are crossings of the same lot.
const CROSSING: u32 = 1 << 31;

/// Marks crossings on the first of their two carriers.
pub(crate) const FIRST: u32 = 1 << 30;

impl Event {
    /// A crossing of the lot, on the first or the second of its carriers.
    pub(crate) fn crossing(carrier: u32, number: usize, is_first: bool, key: f64) -> Self {
        Self { carrier, vertex: CROSSING | if is_first { FIRST } else { 0 } | number as u32, key }
    }

    /// The number of the crossing in the lot.
    pub(crate) fn crossing_of_lot(&self) -> Option<usize> {
        (self.vertex & CROSSING != 0).then_some((self.vertex & (FIRST - 1)) as usize)
    }

    /// The same with another number of its crossing in the lot.
    pub(crate) fn renumbered(self, number: usize) -> Self {
        Self { vertex: self.vertex & (CROSSING | FIRST) | number as u32, ..self }
    }

    /// The vertex without a mark.
    pub(crate) fn id(&self) -> u32 {
        self.vertex & !FIRST
    }
}

/// Ranges of carriers: at most 256, of 64 carriers or more.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ranges {
    n_carriers: usize,
    size: usize,
}

impl Ranges {
    pub(crate) fn new(n_carriers: usize) -> Self {
        Self { n_carriers, size: n_carriers.div_ceil(256).max(64) }
    }

    pub(crate) fn len(&self) -> usize {
        self.n_carriers.div_ceil(self.size)
    }

    pub(crate) fn carriers(&self, range: usize) -> Range<usize> {
        range * self.size..((range + 1) * self.size).min(self.n_carriers)
    }

    fn of(&self, carrier: u32) -> usize {
        carrier as usize / self.size
    }
}

/// Events by ranges of carriers.
#[derive(Debug)]
pub(crate) struct Lot {
    events: Vec<Event>,
    /// Where the events of each range begin.
    offsets: Vec<u32>,
    /// Number of the lot's first crossing among all vertices.
    base: u32,
}

impl Lot {
    /// Keeps the order of the events of a range.
    pub(crate) fn new(ranges: Ranges, events: &[Event]) -> Self {
        let (offsets, events) = sorted_by_place(ranges.len(), events, |e| ranges.of(e.carrier));
        Self { events, offsets, base: 0 }
    }

    /// The same with the number of its first crossing.
    pub(crate) fn numbered_from(self, base: u32) -> Self {
        Self { base, ..self }
    }

    /// The events of a range, with the final numbers of their vertices and the mark `FIRST`.
    pub(crate) fn of_range(&self, range: usize) -> impl Iterator<Item = Event> + '_ {
        let vertex = |v: u32| if v & CROSSING == 0 { v } else { self.base + (v ^ CROSSING) };
        self.events[self.offsets[range] as usize..self.offsets[range + 1] as usize]
            .iter()
            .map(move |e| Event { vertex: vertex(e.vertex), ..*e })
    }
}
