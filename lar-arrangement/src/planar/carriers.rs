//! Planar stage 1: segments → points on the integer grid and *carriers*, segments that never overlap along a line.
//!
//! Collinear segments that overlap or touch become one carrier; each remembers the stretch of it that it was, so
//! provenance is a range of the carrier's pieces. Carriers run from their lexicographically smaller end (by x,
//! then y) to the larger, and are ranked by slope: the angular order of half-edges around any vertex is then an
//! order of integers.

use crate::kernel::Sign;
use crate::planar::input::Drawing;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// A segment of the input on the grid, as a stretch of a carrier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Member {
    /// Index of the input segment.
    pub input: u32,
    pub carrier: u32,
    /// First and last grid point along the carrier.
    pub ends: [u32; 2],
    /// Whether the input segment runs against the carrier.
    pub reversed: bool,
}

/// Carriers over grid points.
#[derive(Debug, Default)]
pub(crate) struct Carriers {
    /// Distinct grid points, in first-seen order.
    pub points: Vec<[i64; 2]>,
    /// Ends of each carrier, lexicographically ascending.
    pub ends: Vec<[u32; 2]>,
    /// Rank by slope, from just above vertical down to vertical up; parallel carriers have equal ranks.
    pub rank: Vec<u32>,
    /// Grid points strictly inside a carrier where members of it end: (carrier, point).
    pub stops: Vec<(u32, u32)>,
    /// Sorted by input segment; segments without length are missing.
    pub members: Vec<Member>,
}

impl Carriers {
    /// `snapped` are the grid positions of the drawing's points. O(n log n).
    pub(crate) fn new(drawing: &Drawing, snapped: &[[i64; 2]]) -> Self {
        let mut out = Self::default();
        let point_of = out.unify(snapped);
        let mut segments: Vec<Segment> = Vec::with_capacity(drawing.segments.len());
        for (&[a, b], input) in drawing.segments.iter().zip(0..) {
            let ends = [a, b].map(|p| point_of[p as usize]);
            if ends[0] != ends[1] {
                segments.push(Segment::new(ends, input, &out.points));
            }
        }
        segments.sort_unstable_by(|a, b| a.key.total_cmp(&b.key).then_with(|| a.input.cmp(&b.input)));
        let mut begin = 0;
        while begin < segments.len() {
            let key = segments[begin].key;
            let end = begin + segments[begin..].iter().take_while(|s| s.key == key).count();
            if end - begin > 1 {
                segments[begin..end].sort_by(|a, b| a.cmp_along_lines(b, &out.points));
            }
            begin = end;
        }
        out.push_lines(&segments);
        out.members.sort_unstable_by_key(|m| m.input);
        out
    }

    fn unify(&mut self, snapped: &[[i64; 2]]) -> Vec<u32> {
        let mut ids: FxHashMap<[i64; 2], u32> = FxHashMap::default();
        ids.reserve(snapped.len());
        snapped
            .iter()
            .map(|&p| {
                *ids.entry(p).or_insert_with(|| {
                    self.points.push(p);
                    self.points.len() as u32 - 1
                })
            })
            .collect()
    }

    /// Segments sorted by slope, line, and place along the line → carriers.
    fn push_lines(&mut self, segments: &[Segment]) {
        let mut rank = 0;
        let mut first = 0;
        for (i, s) in segments.iter().enumerate() {
            if i > 0 && turn(segments[i - 1].direction, s.direction) != Sign::Zero {
                rank += 1;
            }
            let last = self.ends.last().copied();
            let continues = i > 0
                && last.is_some_and(|[_, end]| {
                    let (end, start) = (self.points[end as usize], self.points[s.ends[0] as usize]);
                    segments[i - 1].is_in_line(s, &self.points) && start <= end
                });
            if continues {
                let carrier = self.ends.len() - 1;
                if self.points[s.ends[1] as usize] > self.points[self.ends[carrier][1] as usize] {
                    self.ends[carrier][1] = s.ends[1];
                }
            } else {
                self.push_stops(first);
                first = self.members.len();
                self.ends.push(s.ends);
                self.rank.push(rank);
            }
            let carrier = self.ends.len() as u32 - 1;
            self.members.push(Member { input: s.input, carrier, ends: s.ends, reversed: s.reversed });
        }
        self.push_stops(first);
    }

    /// The ends of the last carrier's members (from `first` on) that lie inside it.
    fn push_stops(&mut self, first: usize) {
        if self.members.len() - first < 2 {
            return;
        }
        let carrier = self.ends.len() as u32 - 1;
        let ends = self.ends[carrier as usize];
        let mut inside: Vec<u32> =
            self.members[first..].iter().flat_map(|m| m.ends).filter(|p| !ends.contains(p)).collect();
        inside.sort_unstable();
        inside.dedup();
        self.stops.extend(inside.into_iter().map(|p| (carrier, p)));
    }

    pub(crate) fn at(&self, carrier: u32) -> [[i64; 2]; 2] {
        self.ends[carrier as usize].map(|p| self.points[p as usize])
    }

    pub(crate) fn direction(&self, carrier: u32) -> [i64; 2] {
        let [a, b] = self.at(carrier);
        [b[0] - a[0], b[1] - a[1]]
    }
}

/// a × b: positive when b turns left of a. Components of at most 41 bits, so the products fit easily.
pub(crate) fn cross(a: [i64; 2], b: [i64; 2]) -> i128 {
    i128::from(a[0]) * i128::from(b[1]) - i128::from(a[1]) * i128::from(b[0])
}

pub(crate) fn turn(a: [i64; 2], b: [i64; 2]) -> Sign {
    Sign::from(cross(a, b))
}

/// A segment with length, from its lexicographically smaller end.
struct Segment {
    /// dy / dx, correctly rounded, so equal slopes have equal keys and unequal keys order exactly.
    key: f64,
    ends: [u32; 2],
    direction: [i64; 2],
    input: u32,
    reversed: bool,
}

impl Segment {
    fn new(ends: [u32; 2], input: u32, points: &[[i64; 2]]) -> Self {
        let [a, b] = ends.map(|p| points[p as usize]);
        let reversed = b < a;
        let (ends, a, b) = if reversed { ([ends[1], ends[0]], b, a) } else { (ends, a, b) };
        let direction = [b[0] - a[0], b[1] - a[1]];
        // Adding zero makes −0 and 0 one key.
        let key =
            if direction[0] == 0 { f64::INFINITY } else { direction[1] as f64 / direction[0] as f64 + 0.0 };
        Self { key, ends, direction, input, reversed }
    }

    fn is_in_line(&self, other: &Self, points: &[[i64; 2]]) -> bool {
        turn(self.direction, other.direction) == Sign::Zero && self.offset_to(other, points) == 0
    }

    /// How far the other one's line lies to the left, times the length.
    fn offset_to(&self, other: &Self, points: &[[i64; 2]]) -> i128 {
        let (p, q) = (points[self.ends[0] as usize], points[other.ends[0] as usize]);
        cross(self.direction, [q[0] - p[0], q[1] - p[1]])
    }

    /// By slope, then by line from right to left, then along the line, then by input.
    fn cmp_along_lines(&self, other: &Self, points: &[[i64; 2]]) -> Ordering {
        0.cmp(&cross(self.direction, other.direction))
            .then_with(|| 0.cmp(&self.offset_to(other, points)))
            .then_with(|| points[self.ends[0] as usize].cmp(&points[other.ends[0] as usize]))
            .then_with(|| self.input.cmp(&other.input))
    }
}
