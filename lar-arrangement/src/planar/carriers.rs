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
        let ends: Vec<[u32; 2]> = first.iter().map(|&input| lines.ends[input as usize]).collect();
        let member = |(input, s): (usize, &Segment)| {
            let carrier = number[lines.of[input] as usize];
            Member { input: input as u32, carrier, ends: s.ends, reversed: s.reversed }
        };
        let has_length = |(_, s): &(usize, &Segment)| s.ends[0] != s.ends[1];
        Self {
            positions: ends.iter().map(|ends| ends.map(|p| points[p as usize])).collect(),
            ends,
            rank: first.iter().map(|&input| lines.rank[input as usize]).collect(),
            stops: lines.stops.iter().map(|&(input, p)| (number[input as usize], p)).collect(),
            members: segments.iter().enumerate().filter(has_length).map(member).collect(),
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
        let mut keys = parallel::map(segments.len(), |i| (segments[i].key, i as u32));
        // A segment without length has no slope; that sorts after all numbers.
        parallel::sort_distinct_by(&mut keys, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        keys.truncate(keys.partition_point(|(key, _)| !key.is_nan()));
        let mut out = Self {
            first: Vec::new(),
            of: (0..segments.len() as u32).collect(),
            ends: segments.iter().map(|s| s.ends).collect(),
            rank: vec![0; segments.len()],
            stops: Vec::new(),
        };
        let mut rank = 0;
        for same in keys.chunk_by_mut(|a, b| a.0 == b.0) {
            if let [(_, input)] = *same {
                out.rank[input as usize] = rank;
            } else {
                parallel::sort_distinct_by(same, |a, b| {
                    segments[a.1 as usize]
                        .cmp_along_lines(&segments[b.1 as usize], points)
                        .then(a.1.cmp(&b.1))
                });
                rank = out.push_parallel(same, segments, points, rank);
            }
            rank += 1;
        }
        drop(keys);
        let is_first =
            |&input: &u32| out.of[input as usize] == input && !segments[input as usize].key.is_nan();
        out.first = (0..segments.len() as u32).filter(is_first).collect();
        out
    }

    /// Segments with equal keys, sorted by slope, line, and place along the line; returns the last one's rank.
    fn push_parallel(
        &mut self,
        same: &[(f64, u32)],
        segments: &[Segment],
        points: &[[i64; 2]],
        mut rank: u32,
    ) -> u32 {
        let segment = |i: usize| &segments[same[i].1 as usize];
        let mut begin = 0;
        for i in 0..same.len() {
            let (input, first) = (same[i].1 as usize, same[begin].1 as usize);
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
    fn push_stops(&mut self, members: &[(f64, u32)], segments: &[Segment]) {
        if members.len() < 2 {
            return;
        }
        let first = members[0].1;
        let ends = self.ends[first as usize];
        let all = members.iter().flat_map(|&(_, input)| segments[input as usize].ends);
        let mut inside: Vec<u32> = all.filter(|p| !ends.contains(p)).collect();
        inside.sort_unstable();
        inside.dedup();
        self.stops.extend(inside.into_iter().map(|p| (first, p)));
        members.iter().for_each(|&(_, input)| self.of[input as usize] = first);
    }
}

/// A segment from its lexicographically smaller end.
struct Segment {
    /// dy / dx, correctly rounded, so equal slopes have equal keys and unequal keys order exactly. Not a number for a
    /// segment without length.
    key: f64,
    ends: [u32; 2],
    reversed: bool,
}

impl Segment {
    fn new(ends: [u32; 2], points: &[[i64; 2]]) -> Self {
        let [a, b] = ends.map(|p| points[p as usize]);
        let reversed = b < a;
        let (ends, a, b) = if reversed { ([ends[1], ends[0]], b, a) } else { (ends, a, b) };
        let key = match [b[0] - a[0], b[1] - a[1]] {
            // With a plus sign: the total order has it after all numbers.
            [0, 0] => f64::NAN.abs(),
            [0, _] => f64::INFINITY,
            // Adding zero makes −0 and 0 one key.
            [dx, dy] => dy as f64 / dx as f64 + 0.0,
        };
        Self { key, ends, reversed }
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
