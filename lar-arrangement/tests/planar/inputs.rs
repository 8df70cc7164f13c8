//! Random inputs, rich in degeneracies.

use crate::common::Random;
use crate::oracle::Segment;

/// Coordinates are below this.
const SIDE: usize = 7;

fn coordinate(random: &mut Random) -> i64 {
    random.below(SIDE) as i64
}

/// Up to twelve segments of one of seven kinds.
pub(crate) fn segments(random: &mut Random) -> Vec<Segment> {
    let n = random.below(12) + 1;
    let kind = random.below(7);
    let mut out: Vec<Segment> = Vec::with_capacity(n);
    for _ in 0..n {
        let mut c = || coordinate(random);
        let [x, y, z, w] = [c(), c(), c(), c()];
        let segment = match kind {
            // Anything, with repetitions and points.
            0 => [x, y, z, w],
            // A star: through the middle, or half of the way.
            1 => [x, y, 6 - x, 6 - y],
            2 => [3, 3, x, y],
            // Few lines, much overlap.
            3 => [x, y % 2, z, y % 2],
            4 => [x, x + y % 2, z, z + y % 2],
            // Axis-parallel.
            5 if y < 3 => [x, w, x, z],
            5 => [x, w, z, w],
            // Few points: chains, bundles and repetitions.
            _ => [x % 3 * 3, y % 3 * 3, z % 3 * 3, w % 3 * 3],
        };
        out.push(segment);
    }
    for _ in 0..random.below(3) {
        let copied = out[random.below(out.len())];
        out.push(match random.below(3) {
            0 => copied,
            1 => [copied[2], copied[3], copied[0], copied[1]],
            _ => [copied[0], copied[1], copied[0], copied[1]],
        });
    }
    out
}

/// The same drawing moved, with all numbers exact, or told otherwise.
pub(crate) fn variants(segments: &[Segment], random: &mut Random) -> Vec<(&'static str, Vec<Segment>)> {
    let map = |f: fn(i64, i64) -> [i64; 2]| -> Vec<Segment> {
        let moved = |s: &Segment| {
            let ([a, b], [c, d]) = (f(s[0], s[1]), f(s[2], s[3]));
            [a, b, c, d]
        };
        segments.iter().map(moved).collect()
    };
    let order = random.permutation(segments.len());
    vec![
        ("a quarter turn", map(|x, y| [-y, x])),
        ("a half turn", map(|x, y| [-x, -y])),
        ("three quarter turns", map(|x, y| [y, -x])),
        ("mirrored", map(|x, y| [y, x])),
        ("a step", map(|x, y| [x - 3, y + 5])),
        ("far away", map(|x, y| [x + 1000, y - 3_000_000])),
        ("in another order", order.iter().map(|&i| segments[i]).collect()),
        ("reversed", segments.iter().map(|s| [s[2], s[3], s[0], s[1]]).collect()),
    ]
}

/// Segments through a few common points, so many that each is met by a bundle; the bundles cross each other.
pub(crate) fn stars(random: &mut Random, n_stars: usize, n_rays: usize, side: usize) -> Vec<Segment> {
    let mut out = Vec::with_capacity(n_stars * n_rays);
    for _ in 0..n_stars {
        let centre = [(); 2].map(|()| random.below(side) as i64);
        for _ in 0..n_rays {
            let [dx, dy] = [(); 2].map(|()| random.below(side) as i64 - side as i64 / 2);
            // Some begin in the middle, some cross it off their own middles.
            let [back, ahead] = [random.below(3) as i64, 1 + random.below(2) as i64];
            out.push([
                centre[0] - back * dx,
                centre[1] - back * dy,
                centre[0] + ahead * dx,
                centre[1] + ahead * dy,
            ]);
        }
    }
    out
}
