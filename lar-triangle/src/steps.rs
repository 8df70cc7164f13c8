//! Steps, counted in tests only: how costs grow is tested by counting, because times depend on the machine.

/// Notes one step: a predicate, or an edge or point passed on a walk.
#[inline]
pub(crate) fn step() {
    #[cfg(test)]
    tests::STEPS.set(tests::STEPS.get() + 1);
}

#[cfg(test)]
#[path = "../tests/common/mod.rs"]
mod common;

#[cfg(test)]
mod tests {
    use super::common::{Polygon, comb, sieve, spiral};
    use crate::{Quality, Triangulator};
    use std::cell::Cell;

    thread_local! {
        pub(super) static STEPS: Cell<u64> = const { Cell::new(0) };
    }

    fn steps(polygon: &Polygon, expected: Quality) -> u64 {
        let (points, mut triangles) = (polygon.points(), Vec::new());
        let before = STEPS.get();
        let quality = Triangulator::new().face(&points, polygon.loop_slices(), &mut triangles);
        assert_eq!((quality, triangles.is_empty()), (Ok(expected), false));
        STEPS.get() - before
    }

    /// A comb with a tooth of no area: the fallback.
    fn broken_comb(teeth: usize) -> Polygon {
        let mut polygon = comb(teeth);
        let n = polygon.xy.len();
        polygon.xy[n / 2] = polygon.xy[n / 2 + 1];
        polygon
    }

    /// Steps grow with the size, or nearly: a polygon eight times as large takes less than twelve times as many.
    #[track_caller]
    fn check_growth(make: impl Fn(usize) -> Polygon, n: usize, expected: Quality) {
        let (small, large) = (make(n), make(8 * n));
        let corners = |polygon: &Polygon| polygon.xy.len() as f64;
        let size = corners(&large) / corners(&small);
        let [few, many] = [&small, &large].map(|polygon| steps(polygon, expected));
        assert!(small.xy.len() as u64 <= few, "{few} steps for {} corners", small.xy.len());
        assert!((many as f64) < 1.5 * size * few as f64, "{few} steps, {size} times as large {many}");
    }

    #[test]
    fn large_faces_take_near_linear_time() {
        check_growth(comb, 1000, Quality::Proper);
        check_growth(broken_comb, 1000, Quality::Combinatorial);
        check_growth(|n| spiral(n / 50, 50), 2000, Quality::Proper);
        check_growth(|n| sieve(n.isqrt()), 400, Quality::Proper);
        check_growth(|n| Polygon::default().with(vec![[0.0, 0.0]; n]), 4000, Quality::Combinatorial);
    }
}
