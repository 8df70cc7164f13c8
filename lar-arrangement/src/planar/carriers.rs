//! Planar stage 1: segments → points on the integer grid and *carriers*, segments that never overlap along a line.
//!
//! Collinear segments that overlap or touch become one carrier; each remembers the stretch of it that it was, so
//! provenance is a range of the carrier's pieces. Carriers run from their lexicographically smaller end (by x,
//! then y) to the larger, and are ranked by slope: the angular order of half-edges around any vertex is then an
//! order of integers.

use crate::boxes::Aabb;
use crate::curve::z_order;
use crate::kernel::Sign;
use crate::parallel;
use crate::planar::input::Drawing;
use crate::planar::slopes::{BySlope, IN_LINE, PARALLEL, Segment, number};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// A segment of the input on the grid, as a stretch of a carrier.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
    /// `points` are the distinct grid points, all in the box `hull`, and `point_of` holds for each point of the drawing
    /// which of them it is. O(n log n).
    pub(crate) fn new(drawing: &Drawing, points: Vec<[i64; 2]>, point_of: &[u32], hull: &Aabb<2>) -> Self {
        let segments = parallel::map_light(drawing.segments.len(), |i| {
            Segment::new(drawing.segments[i].map(|p| point_of[p as usize]), &points)
        });
        let lines = Lines::new(&segments, &points);
        let place = |p: u32| points[p as usize].map(|x| x as f64);
        let order = z_order(hull, lines.first.len(), |i| {
            Aabb::around(lines.ends[lines.first[i as usize] as usize].map(place))
        });
        let first = parallel::map_light(order.len(), |i| lines.first[order[i] as usize]);
        let number = parallel::atomic_zeros(segments.len());
        parallel::for_each(first.len(), |i| number[first[i] as usize].store(i as u32, Relaxed));
        let number = |input: u32| number[input as usize].load(Relaxed);
        let ends = parallel::map_light(first.len(), |i| lines.ends[first[i] as usize]);
        let member = |input: usize| {
            let ends = segments[input].ends;
            let reversed = point_of[drawing.segments[input][0] as usize] != ends[0];
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
        let rank = parallel::atomic_zeros(n);
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
            if i > 0 && x & PARALLEL == 0 {
                rank = place + i as u32;
            }
            if i > 0 {
                let at = |p: u32| self.points[p as usize];
                let [start, last] = self.segment(x).ends;
                let continues = x & IN_LINE != 0 && at(start) <= at(end);
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
