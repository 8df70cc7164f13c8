//! The mean of a monomial over a simplex, by Bernstein coefficients.
//!
//! A polynomial of degree n on a k-simplex with barycentric coordinates λ is Σ c_α · n!/α! · λ^α over the
//! multi-indices α = (α0, …, αk) of sum n. All its basis polynomials have the same integral, so its mean is the
//! mean of the c_α. Multiplication by the linear function with vertex values x_0 … x_k gives degree n + 1 and
//! c'_α = Σ α_i x_i c_(α − e_i) / (n + 1), a weighted mean: no term is subtracted unless coordinates differ in
//! sign.
//!
//! Source: Farouki, "The Bernstein polynomial basis: a centennial retrospective", CAGD 29 (2012).

use super::IntegrationError;
use crate::measure::Vec3;

/// The highest degree a + b + c of a monomial that is integrated. There (n + 1)³ coefficients take 17 MB, and
/// the monomial of a model ten units wide reaches 10^128.
pub const MAX_DEGREE: u32 = 128;

/// ∫ u^a v^b over the triangle u, v ≥ 0, u + v ≤ 1: a! b! / (a + b + 2)!, to rounding for any degrees; 0 where
/// that is below the smallest number. O(min(a, b)), at most some thousand steps.
///
/// ```
/// use lar_core::triangle_moment;
/// assert_eq!(triangle_moment(0, 0), 0.5);
/// assert!((triangle_moment(2, 1) - 1. / 60.).abs() < 1e-17);
/// assert_eq!(triangle_moment(u32::MAX, u32::MAX), 0.);
/// ```
#[doc(alias = "M")]
#[must_use]
pub fn triangle_moment(a: u32, b: u32) -> f64 {
    let n = f64::from(a) + f64::from(b);
    let (small, large) = (a.min(b), f64::from(a.max(b)));
    let mut moment = 1. / ((n + 1.) * (n + 2.));
    for i in (1..=small).map(f64::from) {
        moment *= i / (large + i);
        if moment == 0. {
            break;
        }
    }
    moment
}

pub(super) fn check_degree(degrees: [u32; 3]) -> Result<(), IntegrationError> {
    let degree = degrees.iter().map(|&g| u64::from(g)).sum();
    if degree <= u64::from(MAX_DEGREE) { Ok(()) } else { Err(IntegrationError::Degree { degree }) }
}

/// The mean of x^a y^b z^c over the simplex of 1 to 4 vertices; `coefficients` is scratch memory. O(n^(k+1))
/// for degree n = a + b + c and k + 1 vertices.
pub(super) fn mean(vertices: &[Vec3], degrees: [u32; 3], coefficients: &mut Vec<f64>) -> f64 {
    let degree: usize = degrees.iter().map(|&g| g as usize).sum();
    let k = vertices.len() - 1;
    let stride = degree + 1;
    coefficients.clear();
    coefficients.resize(stride.pow(u32::try_from(k).expect("simplices have at most 4 vertices")), 0.);
    coefficients[0] = 1.;
    let axes = (0..3).flat_map(|axis| std::iter::repeat_n(axis, degrees[axis] as usize));
    for (below, axis) in axes.enumerate() {
        let mut values = [0.; 4];
        for (value, vertex) in values.iter_mut().zip(vertices) {
            *value = vertex[axis];
        }
        raise(coefficients, stride, k, below + 1, values);
    }
    let (mut sum, mut n) = (0., 0.);
    for_each_index(k, degree, |[_, i, j, l]| {
        sum += coefficients[(l * stride + j) * stride + i];
        n += 1.;
    });
    sum / n
}

/// Multiplies a polynomial of degree `n` − 1 by the linear function of the given values at the vertices, in
/// place: c_α stands at α1 + stride·α2 + stride²·α3 and is read only by places at or after its own.
fn raise(c: &mut [f64], stride: usize, k: usize, n: usize, values: [f64; 4]) {
    #[expect(clippy::cast_precision_loss, reason = "degrees are at most MAX_DEGREE")]
    let weight = |i: usize| i as f64 / n as f64;
    for_each_index(k, n, |[h, i, j, l]| {
        let at = (l * stride + j) * stride + i;
        let mut sum = if h > 0 { weight(h) * values[0] * c[at] } else { 0. };
        for (index, value, step) in
            [(i, values[1], 1), (j, values[2], stride), (l, values[3], stride * stride)]
        {
            if index > 0 {
                sum += weight(index) * value * c[at - step];
            }
        }
        c[at] = sum;
    });
}

/// The multi-indices of sum `n` with k + 1 places (the others 0), the highest last place first.
fn for_each_index(k: usize, n: usize, mut visit: impl FnMut([usize; 4])) {
    for l in (0..=if k >= 3 { n } else { 0 }).rev() {
        for j in (0..=if k >= 2 { n - l } else { 0 }).rev() {
            for i in (0..=if k >= 1 { n - l - j } else { 0 }).rev() {
                visit([n - l - j - i, i, j, l]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STANDARD: [Vec3; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];

    /// k! a! b! c! / (a + b + c + k)!, the mean over the standard k-simplex.
    fn closed_form(k: u32, degrees: [u32; 3]) -> f64 {
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        factorial(k) * degrees.map(factorial).iter().product::<f64>()
            / factorial(degrees.iter().sum::<u32>() + k)
    }

    #[track_caller]
    fn check(k: u32, degrees: [u32; 3]) {
        let found = mean(&STANDARD[..=k as usize], degrees, &mut Vec::new());
        let expected = closed_form(k, degrees);
        assert!((found / expected - 1.).abs() < 1e-13, "{found} {expected}");
    }

    #[test]
    fn standard_simplices() {
        check(0, [0, 0, 0]);
        check(1, [0, 0, 0]);
        check(1, [7, 0, 0]);
        check(2, [3, 2, 0]);
        check(2, [40, 40, 0]);
        check(3, [0, 0, 0]);
        check(3, [1, 2, 3]);
        check(3, [10, 10, 10]);
        check(3, [20, 5, 30]);
        assert_eq!(mean(&STANDARD[2..3], [0, 9, 0], &mut Vec::new()), 1.);
    }

    #[test]
    fn moments_of_the_unit_triangle() {
        for (a, b) in (0..25).flat_map(|a| (0..25).map(move |b| (a, b))) {
            let expected = closed_form(2, [a, b, 0]) / 2.;
            assert!((triangle_moment(a, b) / expected - 1.).abs() < 1e-13, "{a} {b}");
        }
    }

    #[test]
    fn degrees_are_limited() {
        assert_eq!(check_degree([128, 0, 0]), Ok(()));
        let found = check_degree([u32::MAX; 3]).unwrap_err().to_string();
        assert_eq!(found, "a monomial of degree 12884901885; integrals are taken up to degree 128");
    }
}
