//! Planar stage 1b: segments by slope, and what neighbours in that order have in common: the slope, the direction, the
//! line.

use crate::counting::{sorted_by_place, sorted_numbers};
use crate::kernel::Sign;
use crate::parallel;
use crate::planar::carriers::{cross, turn};
use std::cmp::Ordering;
use std::ops::Range;

/// A segment from its lexicographically smaller end.
#[derive(Clone, Copy, Default)]
pub(super) struct Segment {
    /// dy / dx, correctly rounded, so equal slopes stay equal and unequal ones keep their order. Not a number for a
    /// segment without length.
    pub(super) slope: f64,
    pub(super) ends: [u32; 2],
}

impl Segment {
    pub(super) fn new(ends: [u32; 2], points: &[[i64; 2]]) -> Self {
        let [a, b] = ends.map(|p| points[p as usize]);
        let (ends, a, b) = if b < a { ([ends[1], ends[0]], b, a) } else { (ends, a, b) };
        let slope = match [b[0] - a[0], b[1] - a[1]] {
            [0, 0] => f64::NAN,
            [0, _] => f64::INFINITY,
            // Adding zero makes −0 and 0 one slope.
            [dx, dy] => dy as f64 / dx as f64 + 0.0,
        };
        Self { slope, ends }
    }

    fn direction(&self, points: &[[i64; 2]]) -> [i64; 2] {
        let [a, b] = self.ends.map(|p| points[p as usize]);
        [b[0] - a[0], b[1] - a[1]]
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

/// The segments with a length by slope, line and place along the line, each as its number and what it has in common with
/// the one before.
pub(super) struct BySlope<'a> {
    segments: &'a [Segment],
    points: &'a [[i64; 2]],
    pub(super) sorted: Vec<u64>,
}

/// Bits of a segment's number, above which is its sector of directions, until it is known what a segment has in common
/// with the one before.
const NUMBER: u32 = 31;

/// Marks a rounded slope that is equal to the one before.
const SAME_SLOPE: u64 = 1 << 63;

/// Marks, besides, exactly the same direction.
pub(super) const PARALLEL: u64 = 1 << 62;

/// Marks, besides, the same line.
pub(super) const IN_LINE: u64 = 1 << 61;

impl<'a> BySlope<'a> {
    pub(super) fn new(segments: &'a [Segment], points: &'a [[i64; 2]]) -> Self {
        let mut out = Self { segments, points, sorted: Vec::new() };
        let numbers = parallel::map_light(segments.len(), |i| sector(segments[i].slope) << NUMBER | i as u64);
        let settle = |sorted: &mut [u64]| {
            let same_sector = |a: &u64, b: &u64| a >> NUMBER == b >> NUMBER;
            sorted.chunk_by_mut(same_sector).filter(|same| same.len() > 1).for_each(|same| out.settle(same));
        };
        out.sorted = sorted_numbers(&numbers, 32 + NUMBER, settle);
        out.sorted.truncate(out.sorted.partition_point(|x| (x & !SAME_SLOPE) >> NUMBER < NO_SECTOR));
        out
    }

    /// Sorts segments of one sector.
    fn settle(&self, same: &mut [u64]) {
        if same[0] >> NUMBER == NO_SECTOR {
            return;
        }
        let near: Vec<(f64, u64)> = same.iter().map(|&x| (self.slope(number(x)), x)).collect();
        let mut rest = same;
        for equal in sorted_slopes(near).chunk_by(|a, b| a.0 == b.0) {
            let (to, after) = rest.split_at_mut(equal.len());
            to.iter_mut().zip(equal).for_each(|(to, (_, x))| *to = *x);
            if to.len() > 1 {
                sort_along_lines(to, self.segments, self.points);
                self.mark(to);
            }
            rest = after;
        }
    }

    /// Marks what segments of one rounded slope have in common.
    fn mark(&self, same: &mut [u64]) {
        let mut before = number(same[0]);
        for x in &mut same[1..] {
            let [a, b] = [before, number(*x)].map(|i| &self.segments[i as usize]);
            let more = match turn(a.direction(self.points), b.direction(self.points)) {
                Sign::Zero if a.offset_to(b, self.points) == 0 => PARALLEL | IN_LINE,
                Sign::Zero => PARALLEL,
                _ => 0,
            };
            before = number(*x);
            *x = u64::from(before) | SAME_SLOPE | more;
        }
    }

    fn slope(&self, i: u32) -> f64 {
        self.segments[i as usize].slope
    }

    /// The segments of each slope that begins in a range of places, with the first one's place.
    pub(super) fn slopes(&self, range: Range<usize>) -> impl Iterator<Item = (usize, &[u64])> + '_ {
        let is_same = |x: &&u64| *x & SAME_SLOPE != 0;
        let mut begin = range.start + self.sorted[range.clone()].iter().take_while(is_same).count();
        let mut end = range.end;
        if begin < end {
            end += self.sorted[end..].iter().take_while(is_same).count();
        }
        let slopes = self.sorted[begin..end].chunk_by(move |_, b| is_same(&b));
        slopes.map(move |same| {
            begin += same.len();
            (begin - same.len(), same)
        })
    }
}

/// By slope, then by number. Where many are crowded in one sector, they are sorted by narrower ones first.
fn sorted_slopes(mut near: Vec<(f64, u64)>) -> Vec<(f64, u64)> {
    const CROWD: usize = 64;
    let by_slope = |a: &(f64, u64), b: &(f64, u64)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    let all = || near.iter().map(|&(slope, _)| slope);
    let (lo, hi) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    if near.len() < CROWD || lo == hi || hi == f64::INFINITY {
        parallel::sort_distinct_by(&mut near, by_slope);
        return near;
    }
    let n_places = near.len() / 4;
    let scale = (n_places - 1) as f64 / (hi - lo);
    let place = |(slope, _): &(f64, u64)| ((slope - lo) * scale) as usize;
    let (offsets, mut sorted) = sorted_by_place(n_places, &near, place);
    parallel::each_stretch(&mut sorted, &offsets, |stretch| stretch.sort_unstable_by(by_slope));
    sorted
}

pub(super) fn number(x: u64) -> u32 {
    x as u32 & (u32::MAX >> 1)
}

/// The sector of segments without length.
const NO_SECTOR: u64 = u32::MAX as u64;

/// One of nearly 2^32 sectors of directions; none is lower than that of a smaller slope.
fn sector(slope: f64) -> u64 {
    const FINEST: f64 = (1u64 << 30) as f64;
    if slope.is_nan() {
        return NO_SECTOR;
    }
    (((bent(slope) + 2.0) * FINEST) as u64).min(NO_SECTOR - 1)
}

/// A number from −2 to 2 for a slope, not lower than that of a smaller one. It is spread as directions are.
fn bent(slope: f64) -> f64 {
    if slope.abs() <= 1.0 { slope } else { 2f64.copysign(slope) - 1.0 / slope }
}

/// A sum like y − k x of a slope and coordinates, which may all be off by half a unit in the last place: below 2^-11
/// for coordinates of 40 bits and slopes of at most 1.
const OFFSET_ERROR: f64 = 1.0 / 1024.0;

/// Sorts segments whose rounded slopes are equal by exact slope, line, and place along the line.
fn sort_along_lines(same: &mut [u64], segments: &[Segment], points: &[[i64; 2]]) {
    let segment = |x: u64| &segments[number(x) as usize];
    let exactly = |a: u64, b: u64| segment(a).cmp_along_lines(segment(b), points).then(a.cmp(&b));
    if let [a, b] = same {
        if exactly(*a, *b).is_gt() {
            std::mem::swap(a, b);
        }
        return;
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]
        #[test]
        fn crowded_slopes_are_in_exact_order(ends in prop::collection::vec((-3i64..3, -3i64..3, 0i64..3), 1..400)) {
            // Directions in a few sectors, some parallel, some in one line.
            let stretches = ends.iter().map(|&(x, y, k)| [[0, k], [(1 << 31) + x, (1 << 30) + y + k]]);
            let points: Vec<[i64; 2]> = stretches.flatten().collect();
            let segment = |i: u32| Segment::new([2 * i, 2 * i + 1], &points);
            let segments: Vec<Segment> = (0..ends.len() as u32).map(segment).collect();
            let sorted = BySlope::new(&segments, &points).sorted;
            let mut numbers: Vec<u32> = sorted.iter().map(|&x| number(x)).collect();
            for w in sorted.windows(2) {
                let [a, b] = [w[0], w[1]].map(|x| &segments[number(x) as usize]);
                let turn = cross(a.direction(&points), b.direction(&points));
                prop_assert!(turn >= 0);
                let in_line = turn == 0 && a.offset_to(b, &points) == 0;
                prop_assert!(turn > 0 || in_line || a.offset_to(b, &points) > 0);
                prop_assert_eq!(w[1] & SAME_SLOPE != 0, a.slope == b.slope);
                if a.slope == b.slope {
                    prop_assert_eq!(w[1] & PARALLEL != 0, turn == 0);
                    prop_assert_eq!(w[1] & IN_LINE != 0, in_line);
                }
            }
            numbers.sort_unstable();
            prop_assert!(numbers.into_iter().eq(0..ends.len() as u32));
        }
    }
}
