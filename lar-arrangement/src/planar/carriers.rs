//! Planar stage 1: segments → points on the integer grid and *carriers*, segments that never overlap along a line.
//!
//! Collinear segments that overlap or touch become one carrier; each remembers the stretch of it that it was, so
//! provenance is a range of the carrier's pieces. Carriers run from their lexicographically smaller end (by x,
//! then y) to the larger, and are ranked by slope: the angular order of half-edges around any vertex is then an
//! order of integers.

use crate::boxes::Aabb;
use crate::counting::sorted_numbers;
use crate::curve::z_order;
use crate::kernel::Sign;
use crate::parallel;
use crate::planar::input::Drawing;
use crate::planar::points::unify;
use std::cmp::Ordering;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

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
    pub(crate) fn new(drawing: &Drawing, snapped: Vec<[i64; 2]>) -> Self {
        let (points, point_of) = unify(snapped);
        let segments = parallel::map(drawing.segments.len(), |i| {
            Segment::new(drawing.segments[i].map(|p| point_of[p as usize]), &points)
        });
        drop(point_of);
        let lines = Lines::new(&segments, &points);
        let place = |p: u32| points[p as usize].map(|x| x as f64);
        let order = z_order(lines.first.len(), |i| {
            Aabb::around(lines.ends[lines.first[i as usize] as usize].map(place))
        });
        let first = parallel::map_light(order.len(), |i| lines.first[order[i] as usize]);
        let number = parallel::map_light(segments.len(), |_| AtomicU32::new(0));
        parallel::for_each(first.len(), |i| number[first[i] as usize].store(i as u32, Relaxed));
        let number = |input: u32| number[input as usize].load(Relaxed);
        let ends = parallel::map_light(first.len(), |i| lines.ends[first[i] as usize]);
        let member = |input: usize| {
            let Segment { ends, reversed, .. } = segments[input];
            Member { input: input as u32, carrier: number(lines.of[input]), ends, reversed }
        };
        let mut members = parallel::map_light(segments.len(), member);
        if lines.n_with_length < members.len() {
            members.retain(|member| member.ends[0] != member.ends[1]);
        }
        Self {
            positions: parallel::map_light(ends.len(), |i| ends[i].map(|p| points[p as usize])),
            ends,
            rank: parallel::map_light(first.len(), |i| lines.rank[first[i] as usize].load(Relaxed)),
            stops: lines.stops.iter().map(|&(input, p)| (number(input), p)).collect(),
            members,
            points,
        }
    }

    /// The box of a carrier.
    pub(crate) fn box_of(&self, carrier: u32) -> Aabb<2> {
        Aabb::around(self.at(carrier).map(|p| p.map(|x| x as f64)))
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

/// The segments with a length by slope, line and place along the line, each as its sector of directions and its number.
struct BySlope<'a> {
    segments: &'a [Segment],
    points: &'a [[i64; 2]],
    sorted: Vec<u64>,
}

/// Bits of a segment's number.
const NUMBER: u32 = 31;

impl<'a> BySlope<'a> {
    fn new(segments: &'a [Segment], points: &'a [[i64; 2]]) -> Self {
        let mut out = Self { segments, points, sorted: Vec::new() };
        let numbers = parallel::map_light(segments.len(), |i| sector(segments[i].slope) << NUMBER | i as u64);
        let settle = |sorted: &mut [u64]| {
            let same_sector = |a: &u64, b: &u64| a >> NUMBER == b >> NUMBER;
            sorted.chunk_by_mut(same_sector).for_each(|same| out.settle(same));
        };
        out.sorted = sorted_numbers(&numbers, 32 + NUMBER, settle);
        out.sorted.truncate(out.sorted.partition_point(|x| x >> NUMBER < NO_SECTOR));
        out
    }

    /// Sorts segments of one sector.
    fn settle(&self, same: &mut [u64]) {
        if same.len() < 2 || same[0] >> NUMBER == NO_SECTOR {
            return;
        }
        let slope = |x: u64| self.slope(number(x));
        let mut near: Vec<(f64, u64)> = same.iter().map(|&x| (slope(x), x)).collect();
        parallel::sort_distinct_by(&mut near, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        same.iter_mut().zip(&near).for_each(|(to, (_, x))| *to = *x);
        let mut rest = same;
        for equal in near.chunk_by(|a, b| a.0 == b.0) {
            let (equal, after) = rest.split_at_mut(equal.len());
            if equal.len() > 1 {
                sort_along_lines(equal, self.segments, self.points);
            }
            rest = after;
        }
    }

    fn slope(&self, i: u32) -> f64 {
        self.segments[i as usize].slope
    }

    /// Whether two segments have equal slopes; they are looked at only if their sectors are equal.
    fn is_same(&self, a: u64, b: u64) -> bool {
        a >> NUMBER == b >> NUMBER && self.slope(number(a)) == self.slope(number(b))
    }

    /// The first place not before i where another slope begins.
    fn begin(&self, i: usize) -> usize {
        match i {
            0 => 0,
            _ => i + self.sorted[i..].partition_point(|&x| self.is_same(x, self.sorted[i - 1])),
        }
    }

    /// The segments of each slope that begins in a range of places, with the first one's place.
    fn slopes(&self, range: Range<usize>) -> impl Iterator<Item = (usize, &[u64])> + '_ {
        let mut begin = self.begin(range.start);
        let slopes = self.sorted[begin..self.begin(range.end)].chunk_by(|&a, &b| self.is_same(a, b));
        slopes.map(move |same| {
            begin += same.len();
            (begin - same.len(), same)
        })
    }
}

fn number(x: u64) -> u32 {
    x as u32 & (u32::MAX >> 1)
}

/// The sector of segments without length.
const NO_SECTOR: u64 = u32::MAX as u64;

/// One of nearly 2^32 sectors of directions, from −2 to 2 in all; none is lower than that of a smaller slope.
fn sector(slope: f64) -> u64 {
    const FINEST: f64 = (1u64 << 30) as f64;
    if slope.is_nan() {
        return NO_SECTOR;
    }
    let x = if slope.abs() <= 1.0 { slope } else { 2f64.copysign(slope) - 1.0 / slope };
    (((x + 2.0) * FINEST) as u64).min(NO_SECTOR - 1)
}

/// A sum like y − k x of a slope and coordinates, which may all be off by half a unit in the last place: below 2^-11
/// for coordinates of 40 bits and slopes of at most 1.
const OFFSET_ERROR: f64 = 1.0 / 1024.0;

/// Sorts segments whose rounded slopes are equal by exact slope, line, and place along the line.
fn sort_along_lines(same: &mut [u64], segments: &[Segment], points: &[[i64; 2]]) {
    let segment = |x: u64| &segments[number(x) as usize];
    let exactly = |a: u64, b: u64| segment(a).cmp_along_lines(segment(b), points).then(a.cmp(&b));
    let direction = |x: u64| segment(x).direction(points);
    if same.windows(2).any(|w| turn(direction(w[0]), direction(w[1])) != Sign::Zero) {
        return parallel::sort_distinct_by(same, |&a, &b| exactly(a, b));
    }
    let slope = segment(same[0]).slope;
    // How far the line lies to the left.
    let offset = |x: u64| {
        let [x, y] = points[segment(x).ends[0] as usize].map(|x| x as f64);
        if slope.abs() <= 1.0 { y - slope * x } else { slope.signum() * (y / slope - x) }
    };
    let mut placed: Vec<(f64, u64)> = same.iter().map(|&x| (offset(x), x)).collect();
    parallel::sort_distinct_by(&mut placed, |a, b| match a.0 - b.0 {
        gap if gap.abs() > 2.0 * OFFSET_ERROR => gap.total_cmp(&0.0),
        _ => exactly(a.1, b.1),
    });
    same.iter_mut().zip(placed).for_each(|(to, (_, x))| *to = x);
}

/// Segments joined to carriers, which are named after their first segments.
struct Lines {
    n_with_length: usize,
    /// The first segment of each carrier, ascending.
    first: Vec<u32>,
    /// For each segment the first one of its carrier.
    of: Vec<u32>,
    /// Ends of the carrier that begins with a segment.
    ends: Vec<[u32; 2]>,
    rank: Vec<AtomicU32>,
    /// As in `Carriers`.
    stops: Vec<(u32, u32)>,
}

impl Lines {
    fn new(segments: &[Segment], points: &[[i64; 2]]) -> Self {
        let n = segments.len();
        let by_slope = BySlope::new(segments, points);
        let n_with_length = by_slope.sorted.len();
        let rank = parallel::map_light(n, |_| AtomicU32::new(0));
        let (n_chunks, range) = parallel::chunks(n_with_length, 1 << 12);
        let joined = parallel::map(n_chunks, |chunk| {
            let mut out = Joined { segments, points, rank: &rank, lines: Vec::new(), stops: Vec::new() };
            by_slope.slopes(range(chunk)).for_each(|(place, same)| out.push_slope(place as u32, same));
            (out.lines, out.stops)
        });
        drop(by_slope);
        let mut of = parallel::map_light(n, |i| i as u32);
        let mut ends = parallel::map_light(n, |i| segments[i].ends);
        for Line { members, ends: joined } in joined.iter().flat_map(|(lines, _)| lines) {
            ends[members[0] as usize] = *joined;
            members.iter().for_each(|&input| of[input as usize] = members[0]);
        }
        let is_first = |input: u32| of[input as usize] == input && !segments[input as usize].slope.is_nan();
        let first = parallel::select(n, is_first);
        let stops = joined.into_iter().flat_map(|(_, stops)| stops).collect();
        Self { n_with_length, first, of, ends, rank, stops }
    }
}

/// Segments that are one carrier.
struct Line {
    members: Vec<u32>,
    ends: [u32; 2],
}

/// What some slopes add to the carriers.
struct Joined<'a> {
    segments: &'a [Segment],
    points: &'a [[i64; 2]],
    rank: &'a [AtomicU32],
    /// Carriers of more than one segment.
    lines: Vec<Line>,
    stops: Vec<(u32, u32)>,
}

impl Joined<'_> {
    fn segment(&self, x: u64) -> &Segment {
        &self.segments[number(x) as usize]
    }

    /// Segments with equal slopes, by exact slope, line, and place along the line; `place` is the first one's among
    /// all. The rank of a direction is the place where it begins.
    fn push_slope(&mut self, place: u32, same: &[u64]) {
        if let &[x] = same {
            return self.rank[number(x) as usize].store(place, Relaxed);
        }
        let mut rank = place;
        let (mut begin, mut end) = (0, self.segment(same[0]).ends[1]);
        for (i, &x) in same.iter().enumerate() {
            if i > 0 {
                let (before, this) = (self.segment(same[i - 1]), self.segment(x));
                if turn(before.direction(self.points), this.direction(self.points)) != Sign::Zero {
                    rank = place + i as u32;
                }
                let at = |p: u32| self.points[p as usize];
                let [start, last] = this.ends;
                let continues = before.is_in_line(this, self.points) && at(start) <= at(end);
                if !continues {
                    self.push_line(&same[begin..i], end);
                    (begin, end) = (i, last);
                } else if at(last) > at(end) {
                    end = last;
                }
            }
            self.rank[number(x) as usize].store(rank, Relaxed);
        }
        self.push_line(&same[begin..], end);
    }

    /// Joins segments to one carrier that ends in a point; adds the ends of these that lie inside it.
    fn push_line(&mut self, members: &[u64], end: u32) {
        if members.len() < 2 {
            return;
        }
        let ends = [self.segment(members[0]).ends[0], end];
        let all = members.iter().flat_map(|&x| self.segment(x).ends);
        let mut inside: Vec<u32> = all.filter(|p| !ends.contains(p)).collect();
        inside.sort_unstable();
        inside.dedup();
        let members: Vec<u32> = members.iter().map(|&x| number(x)).collect();
        self.stops.extend(inside.into_iter().map(|p| (members[0], p)));
        self.lines.push(Line { members, ends });
    }
}

/// A segment from its lexicographically smaller end.
struct Segment {
    /// dy / dx, correctly rounded, so equal slopes stay equal and unequal ones keep their order. Not a number for a
    /// segment without length.
    slope: f64,
    ends: [u32; 2],
    reversed: bool,
}

impl Segment {
    fn new(ends: [u32; 2], points: &[[i64; 2]]) -> Self {
        let [a, b] = ends.map(|p| points[p as usize]);
        let reversed = b < a;
        let (ends, a, b) = if reversed { ([ends[1], ends[0]], b, a) } else { (ends, a, b) };
        let slope = match [b[0] - a[0], b[1] - a[1]] {
            [0, 0] => f64::NAN,
            [0, _] => f64::INFINITY,
            // Adding zero makes −0 and 0 one slope.
            [dx, dy] => dy as f64 / dx as f64 + 0.0,
        };
        Self { slope, ends, reversed }
    }

    fn direction(&self, points: &[[i64; 2]]) -> [i64; 2] {
        let [a, b] = self.ends.map(|p| points[p as usize]);
        [b[0] - a[0], b[1] - a[1]]
    }

    fn is_in_line(&self, other: &Self, points: &[[i64; 2]]) -> bool {
        turn(self.direction(points), other.direction(points)) == Sign::Zero
            && self.offset_to(other, points) == 0
    }

    /// How far the other one's line lies to the left, times the length.
    fn offset_to(&self, other: &Self, points: &[[i64; 2]]) -> i128 {
        let (p, q) = (points[self.ends[0] as usize], points[other.ends[0] as usize]);
        cross(self.direction(points), [q[0] - p[0], q[1] - p[1]])
    }

    /// By slope, then by line from right to left, then along the line.
    fn cmp_along_lines(&self, other: &Self, points: &[[i64; 2]]) -> Ordering {
        0.cmp(&cross(self.direction(points), other.direction(points)))
            .then_with(|| 0.cmp(&self.offset_to(other, points)))
            .then_with(|| points[self.ends[0] as usize].cmp(&points[other.ends[0] as usize]))
    }
}
