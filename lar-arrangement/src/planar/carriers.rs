//! Planar stage 1: segments → points on the integer grid and *carriers*, segments that never overlap along a line.
//!
//! Collinear segments that overlap or touch become one carrier; each remembers the stretch of it that it was, so
//! provenance is a range of the carrier's pieces. Carriers run from their lexicographically smaller end (by x,
//! then y) to the larger, and are ranked by slope: the angular order of half-edges around any vertex is then an
//! order of integers.

use crate::boxes::{Aabb, z_order};
use crate::counting::sorted_by_place;
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
        let first: Vec<u32> = order.iter().map(|&i| lines.first[i as usize]).collect();
        let mut number = vec![0; segments.len()];
        for (&input, carrier) in first.iter().zip(0..) {
            number[input as usize] = carrier;
        }
        let ends = parallel::map_light(first.len(), |i| lines.ends[first[i] as usize]);
        let member = |input: usize| {
            let Segment { ends, reversed, .. } = segments[input];
            Member { input: input as u32, carrier: number[lines.of[input] as usize], ends, reversed }
        };
        let mut members = parallel::map_light(segments.len(), member);
        members.retain(|member| member.ends[0] != member.ends[1]);
        Self {
            positions: parallel::map_light(ends.len(), |i| ends[i].map(|p| points[p as usize])),
            ends,
            rank: parallel::map_light(first.len(), |i| lines.rank[first[i] as usize]),
            stops: lines.stops.iter().map(|&(input, p)| (number[input as usize], p)).collect(),
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

/// The numbers of the segments with a length, by slope and number.
fn by_slope(segments: &[Segment]) -> Vec<u32> {
    const BITS: u32 = 31;
    const FINEST: f64 = (1u64 << 30) as f64;
    let number = |x: u64| x as u32 & (u32::MAX >> 1);
    // One of 2^32 sectors of directions, from −2 to 2 in all. Every step rises with the slope.
    let sector = |slope: f64| {
        let x = if slope.abs() <= 1.0 { slope } else { 2f64.copysign(slope) - 1.0 / slope };
        ((x + 2.0) * FINEST) as u64
    };
    let mut keyed = Vec::with_capacity(segments.len());
    let with_length = segments.iter().zip(0..).filter(|(s, _)| !s.slope.is_nan());
    keyed.extend(with_length.map(|(s, i)| sector(s.slope) << BITS | i));
    // First by as many sectors as hold a few segments each; the last is that of vertical ones.
    let bits = (keyed.len() / 4).max(1).ilog2().min(16);
    let (offsets, mut keyed) = sorted_by_place((1 << bits) + 1, &keyed, |x| (x >> (63 - bits)) as usize);
    parallel::sort_stretches(&mut keyed, &offsets, Ord::cmp);
    let mut near = Vec::new();
    for same in keyed.chunk_by_mut(|a, b| a >> BITS == b >> BITS).filter(|same| same.len() > 1) {
        near.clear();
        near.extend(same.iter().map(|&x| (segments[number(x) as usize].slope, x)));
        parallel::sort_distinct_by(&mut near, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        same.iter_mut().zip(&near).for_each(|(to, &(_, x))| *to = x);
    }
    keyed.into_iter().map(number).collect()
}

/// A sum like y − k x of a slope and coordinates, which may all be off by half a unit in the last place: below 2^-11
/// for coordinates of 40 bits and slopes of at most 1.
const OFFSET_ERROR: f64 = 1.0 / 1024.0;

/// Sorts segments whose rounded slopes are equal by exact slope, line, and place along the line.
fn sort_along_lines(same: &mut [u32], segments: &[Segment], points: &[[i64; 2]]) {
    let segment = |i: u32| &segments[i as usize];
    let exactly = |a: u32, b: u32| segment(a).cmp_along_lines(segment(b), points).then(a.cmp(&b));
    let direction = |i: u32| segment(i).direction(points);
    if same.windows(2).any(|w| turn(direction(w[0]), direction(w[1])) != Sign::Zero) {
        return parallel::sort_distinct_by(same, |&a, &b| exactly(a, b));
    }
    let slope = segment(same[0]).slope;
    // How far the line lies to the left.
    let offset = |i: u32| {
        let [x, y] = points[segment(i).ends[0] as usize].map(|x| x as f64);
        if slope.abs() <= 1.0 { y - slope * x } else { slope.signum() * (y / slope - x) }
    };
    let mut placed: Vec<(f64, u32)> = same.iter().map(|&i| (offset(i), i)).collect();
    parallel::sort_distinct_by(&mut placed, |a, b| match a.0 - b.0 {
        gap if gap.abs() > 2.0 * OFFSET_ERROR => gap.total_cmp(&0.0),
        _ => exactly(a.1, b.1),
    });
    same.iter_mut().zip(placed).for_each(|(to, (_, i))| *to = i);
}

/// Segments joined to carriers, which are named after their first segments.
struct Lines {
    /// The first segment of each carrier, ascending.
    first: Vec<u32>,
    /// For each segment the first one of its carrier.
    of: Vec<u32>,
    /// Ends of the carrier that begins with a segment.
    ends: Vec<[u32; 2]>,
    rank: Vec<u32>,
    /// As in `Carriers`.
    stops: Vec<(u32, u32)>,
}

impl Lines {
    fn new(segments: &[Segment], points: &[[i64; 2]]) -> Self {
        let mut keys = by_slope(segments);
        let mut out = Self {
            first: Vec::new(),
            of: (0..segments.len() as u32).collect(),
            ends: segments.iter().map(|s| s.ends).collect(),
            rank: vec![0; segments.len()],
            stops: Vec::new(),
        };
        let mut rank = 0;
        let slope = |input: u32| segments[input as usize].slope;
        for same in keys.chunk_by_mut(|&a, &b| slope(a) == slope(b)) {
            if let [input] = *same {
                out.rank[input as usize] = rank;
            } else {
                sort_along_lines(same, segments, points);
                rank = out.push_parallel(same, segments, points, rank);
            }
            rank += 1;
        }
        drop(keys);
        let is_first =
            |&input: &u32| out.of[input as usize] == input && !segments[input as usize].slope.is_nan();
        out.first = (0..segments.len() as u32).filter(is_first).collect();
        out
    }

    /// Segments with equal keys, sorted by slope, line, and place along the line; returns the last one's rank.
    fn push_parallel(
        &mut self,
        same: &[u32],
        segments: &[Segment],
        points: &[[i64; 2]],
        mut rank: u32,
    ) -> u32 {
        let segment = |i: usize| &segments[same[i] as usize];
        let mut begin = 0;
        for i in 0..same.len() {
            let (input, first) = (same[i] as usize, same[begin] as usize);
            let [start, end] = segment(i).ends;
            if i > 0 && turn(segment(i - 1).direction(points), segment(i).direction(points)) != Sign::Zero {
                rank += 1;
            }
            self.rank[input] = rank;
            let continues = i > 0
                && segment(i - 1).is_in_line(segment(i), points)
                && points[start as usize] <= points[self.ends[first][1] as usize];
            if !continues {
                self.push_stops(&same[begin..i], segments);
                begin = i;
            } else if points[end as usize] > points[self.ends[first][1] as usize] {
                self.ends[first][1] = end;
            }
        }
        self.push_stops(&same[begin..], segments);
        rank
    }

    /// Names the carrier of some segments, and adds the ends of these that lie inside it.
    fn push_stops(&mut self, members: &[u32], segments: &[Segment]) {
        if members.len() < 2 {
            return;
        }
        let first = members[0];
        let ends = self.ends[first as usize];
        let all = members.iter().flat_map(|&input| segments[input as usize].ends);
        let mut inside: Vec<u32> = all.filter(|p| !ends.contains(p)).collect();
        inside.sort_unstable();
        inside.dedup();
        self.stops.extend(inside.into_iter().map(|p| (first, p)));
        members.iter().for_each(|&input| self.of[input as usize] = first);
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
