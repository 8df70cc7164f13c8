//! How long the curves are that the edges of a cell make.

use glam::DVec3;

/// Mean length of the curves that segments make between the points where three or more meet, or one ends: a circle of many
/// segments is one curve, not many short ones. Closed curves that meet nothing count as one together. O(n log n).
pub(crate) fn mean_curve_length(segments: &[[[f64; 3]; 2]]) -> f64 {
    // Adding zero makes minus zero plain.
    let mut ends: Vec<[u64; 3]> =
        segments.as_flattened().iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
    ends.sort_unstable();
    let ending: usize = ends.chunk_by(|a, b| a == b).map(<[_]>::len).filter(|&n| n != 2).sum();
    let length: f64 = segments.iter().map(|&[a, b]| DVec3::from(a).distance(DVec3::from(b))).sum();
    length / (ending / 2).max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(n: u32) -> Vec<[[f64; 3]; 2]> {
        let point = |i: u32| {
            let (sin, cos) = (f64::from(i % n) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            [cos, sin, 0.0]
        };
        (0..n).map(|i| [point(i), point(i + 1)]).collect()
    }

    #[test]
    fn curves_end_where_they_meet() {
        let check = |segments: &[[[f64; 3]; 2]], expected: f64| {
            let found = mean_curve_length(segments);
            assert!((found - expected).abs() < 1e-3 * expected.max(1.0), "{found}, not {expected}");
        };
        check(&[], 0.0);
        check(&[[[0.0; 3], [0.0, 3.0, 4.0]]], 5.0);
        check(&circle(4), 4.0 * 2f64.sqrt());
        check(&circle(1000), std::f64::consts::TAU);
        // Two more edges at opposite points divide the circle into two: four curves of π, π, 2 and 3.
        let spokes =
            [[[1.0, 0.0, 0.0], [3.0, -0.0, 0.0]], [[-1.0, circle(1000)[500][0][1], 0.0], [-4.0, 0.0, 0.0]]];
        check(&[&circle(1000)[..], &spokes].concat(), (std::f64::consts::TAU + 5.0) / 4.0);
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { 0.0 } else { 2.0 });
        let along =
            |k: usize| (0..8).filter(move |i| i >> k & 1 == 0).map(move |i| [corner(i), corner(i | 1 << k)]);
        check(&(0..3).flat_map(along).collect::<Vec<_>>(), 2.0);
    }
}
