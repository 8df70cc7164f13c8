//! Planar stage 1: segments → points on the integer grid and *carriers*, segments that never overlap along a line.
//!
//! Collinear segments that overlap or touch become one carrier; each remembers the stretch of it that it was, so
//! provenance is a range of the carrier's pieces. Carriers run from their lexicographically smaller end (by x,
//! then y) to the larger, and are ranked by slope: the angular order of half-edges around any vertex is then an
//! order of integers.

use crate::boxes::{Aabb, z_order};
use crate::kernel::Sign;
use crate::parallel;
use crate::planar::input::Drawing;
use crate::planar::points::unify;
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

/// Carriers over grid points, numbered along a space-filling curve: what is near in the plane is near in memory.
#[derive(Debug, Default)]
pub(crate) struct Carriers {
    /// Distinct grid points, in first-seen order.
    pub points: Vec<[i64; 2]>,
    /// Ends of each carrier, lexicographically ascending.
    pub ends: Vec<[u32; 2]>,
    /// Their positions.
    positions: Vec<[[i64; 2]; 2]>,
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
        let (points, point_of) = unify(snapped);
        let segment = |input: u32| {
            let ends = drawing.segments[input as usize].map(|p| point_of[p as usize]);
            Segment::new(ends, input, &points)
        };
        let inputs = sorted_inputs(drawing.segments.len(), &segment, &points);
        let mut out = Self::default();
        out.push_lines(inputs.iter().map(|&input| segment(input)), &points);
        drop(inputs);
        out.points = points;
        out.number_in_space();
        parallel::sort_distinct_by(&mut out.members, |a, b| a.input.cmp(&b.input));
        out
    }

    /// Gives the carriers the numbers of their boxes along the curve.
    fn number_in_space(&mut self) {
        self.positions = self.ends.iter().map(|ends| ends.map(|p| self.points[p as usize])).collect();
        let order = z_order(self.ends.len(), |c| self.box_of(c));
        let mut new = vec![0; order.len()];
        for (&old, number) in order.iter().zip(0..) {
            new[old as usize] = number;
        }
        self.positions = order.iter().map(|&c| self.positions[c as usize]).collect();
        self.ends = order.iter().map(|&c| self.ends[c as usize]).collect();
        self.rank = order.iter().map(|&c| self.rank[c as usize]).collect();
        self.stops.iter_mut().for_each(|(c, _)| *c = new[*c as usize]);
        self.members.iter_mut().for_each(|m| m.carrier = new[m.carrier as usize]);
    }

    /// The box of a carrier.
    pub(crate) fn box_of(&self, carrier: u32) -> Aabb<2> {
        Aabb::around(self.at(carrier).map(|p| p.map(|x| x as f64)))
    }

    /// Segments sorted by slope, line, and place along the line → carriers.
    fn push_lines(&mut self, segments: impl ExactSizeIterator<Item = Segment>, points: &[[i64; 2]]) {
        self.ends.reserve(segments.len());
        self.rank.reserve(segments.len());
        self.members.reserve(segments.len());
        let (mut rank, mut first) = (0, 0);
        let mut last: Option<Segment> = None;
        for s in segments {
            if last.is_some_and(|l| l.key != s.key || turn(l.direction, s.direction) != Sign::Zero) {
                rank += 1;
            }
            let end = self.ends.last_mut().filter(|[_, end]| {
                last.is_some_and(|l| l.is_in_line(&s, points))
                    && points[s.ends[0] as usize] <= points[*end as usize]
            });
            if let Some([_, end]) = end {
                if points[s.ends[1] as usize] > points[*end as usize] {
                    *end = s.ends[1];
                }
            } else {
                self.push_stops(first);
                first = self.members.len();
                self.ends.push(s.ends);
                self.rank.push(rank);
            }
            let carrier = self.ends.len() as u32 - 1;
            self.members.push(Member { input: s.input, carrier, ends: s.ends, reversed: s.reversed });
            last = Some(s);
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
        self.positions[carrier as usize]
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

/// The input segments with length, by slope, then by line, then along the line.
fn sorted_inputs(
    n: usize,
    segment: &(impl Fn(u32) -> Segment + Sync + Send),
    points: &[[i64; 2]],
) -> Vec<u32> {
    let mut keys = parallel::map(n, |i| (segment(i as u32).key, i as u32));
    // A segment without length has no slope; that sorts after all numbers.
    parallel::sort_distinct_by(&mut keys, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    keys.truncate(keys.partition_point(|(key, _)| !key.is_nan()));
    for same in keys.chunk_by_mut(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        let mut along: Vec<Segment> = same.iter().map(|&(_, input)| segment(input)).collect();
        parallel::sort_distinct_by(&mut along, |a, b| a.cmp_along_lines(b, points));
        same.iter_mut().zip(along).for_each(|(key, s)| key.1 = s.input);
    }
    keys.into_iter().map(|(_, input)| input).collect()
}

/// A segment from its lexicographically smaller end.
#[derive(Clone, Copy)]
struct Segment {
    /// dy / dx, correctly rounded, so equal slopes have equal keys and unequal keys order exactly. Not a number for a
    /// segment without length.
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
        let key = match direction {
            // With a plus sign: the total order has it after all numbers.
            [0, 0] => f64::NAN.abs(),
            [0, _] => f64::INFINITY,
            // Adding zero makes −0 and 0 one key.
            [dx, dy] => dy as f64 / dx as f64 + 0.0,
        };
        Self { key, ends, direction, input, reversed }
    }

    fn is_in_line(&self, other: &Self, points: &[[i64; 2]]) -> bool {
        self.key == other.key
            && turn(self.direction, other.direction) == Sign::Zero
            && self.offset_to(other, points) == 0
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
