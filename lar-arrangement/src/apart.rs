//! Stage 1h: triangles that the plane of one keeps apart from the other.
//!
//! Most pairs of facets whose boxes meet do not: small ones side by side, and above all a large one and what is in its box.
//! All corners of one lie on one side of the plane of the other, farther away than anything that matters: the two do not
//! touch, no corners are nearly one, and they do not lie nearly in one plane.
//!
//! The test is one of `f64` with a margin for all rounding: where it fails nothing is claimed.

use crate::boxes::{LARGE, Near};
use crate::soup::Soup;
use crate::vector::{cross, dot, minus, size};

type Vector = [f64; 3];

/// A triangle.
struct Triangle {
    corners: [Vector; 3],
    /// Two sides, and their product, which is normal to the plane.
    sides: [Vector; 2],
    normal: Vector,
}

impl Triangle {
    fn through(corners: [Vector; 3]) -> Self {
        let sides = [minus(corners[1], corners[0]), minus(corners[2], corners[0])];
        Self { corners, sides, normal: cross(sides[0], sides[1]) }
    }

    /// The square of the width: of twice the area over the longest side.
    fn width_2(&self) -> f64 {
        let [a, b] = self.sides;
        let c = minus(b, a);
        dot(self.normal, self.normal) / dot(a, a).max(dot(b, b)).max(dot(c, c))
    }

    /// On which side of the plane a point is, as ±1, when it is farther away than what counts as near: a length that grows
    /// with the distance d from the corners, reach · (1 + 2 · d / width). 0 when it may be nearer.
    ///
    /// The height of the point is det / |n|, and the width is |n| over the longest side l, so what counts as near is
    /// reach · (|n| + 2 · d · l) for the determinant; neither |n| nor d · l is above s², for the sum s of lengths. Corners are
    /// rounded by less than 2^-12, and s is below 2^44: the determinant is off by less than s².
    fn side(&self, p: Vector, reach: f64) -> i8 {
        let (det, near) = self.height(p, 0.0, reach);
        i8::from(det > near) - i8::from(det < -near)
    }

    /// The determinant for a point, and what counts as near for points not farther from it than some length.
    fn height(&self, p: Vector, around: f64, reach: f64) -> (f64, f64) {
        let off = minus(p, self.corners[0]);
        let s = size(self.sides[0]) + size(self.sides[1]) + size(off) + around;
        (dot(self.normal, off), (4.0 * reach + 1.0) * s * s)
    }

    /// Whether the plane of this one keeps another triangle apart.
    fn keeps_off(&self, other: &Self, reach: f64) -> bool {
        let [a, b, c] = other.corners.map(|p| self.side(p, reach));
        let is_beyond = a != 0 && a == b && b == c;
        // The other may be the wider one, or that is a matter of rounding.
        let is_wider = || self.width_2() > 1.001 * other.width_2();
        is_beyond && (is_wider() || self.corners.iter().any(|&p| other.side(p, reach) != 0))
    }

    /// Whether the plane of this one keeps all triangles in a box apart, none of them wider.
    fn keeps_off_box(&self, target: &Near<3>, reach: f64) -> bool {
        let [lo, hi] = [target.lo, target.hi].map(|side| side.map(f64::from));
        let (middle, half) =
            ([0, 1, 2].map(|k| (lo[k] + hi[k]) / 2.0), [0, 1, 2].map(|k| (hi[k] - lo[k]) / 2.0));
        let spread = dot(self.normal.map(f64::abs), half);
        let (det, near) = self.height(middle, size(half), reach);
        // No side in the box is longer than the sum of its sides.
        let longest = 2.0 * size(half);
        det.abs() - spread > near && self.width_2() > 1.001 * longest * longest
    }
}

fn triangle(soup: &Soup, facet: u32) -> Triangle {
    Triangle::through(soup.geometry.base(facet).map(|p| soup.geometry.position(p)))
}

/// Whether two facets are triangles that have nothing in common, lie farther than `reach` from each other, and not nearly in one
/// plane: all corners of one near the plane of the wider one, as near as [`Triangle::side`] has it. Only asked where the box of
/// one, as their sizes tell, is large beside the other: most of what is in the box of a large one is apart from it, of two that
/// are alike few are.
pub(crate) fn are_apart(soup: &Soup, pair: [u32; 2], sizes: [f32; 2], reach: f64) -> bool {
    let [large, small] = if sizes[0] > sizes[1] { pair } else { [pair[1], pair[0]] };
    sizes[0].max(sizes[1]) > LARGE * sizes[0].min(sizes[1])
        && pair.iter().all(|&facet| soup.is_triangle(facet))
        && triangle(soup, large).keeps_off(&triangle(soup, small), reach)
}

/// Whether a facet is apart, in this sense, from all triangles in a box.
pub(crate) fn keeps_off(soup: &Soup, facet: u32, target: &Near<3>, reach: f64) -> bool {
    soup.are_triangles() && triangle(soup, facet).keeps_off_box(target, reach)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::Aabb;
    use proptest::prelude::*;

    /// The least distance of two triangles among points of theirs with barycentric coordinates in sixths.
    fn distance(f: &Triangle, g: &Triangle) -> f64 {
        let points = |t: &Triangle| {
            let [a, b, c] = t.corners;
            let at = |i: u32, j: u32| {
                let (u, v) = (f64::from(i) / 6.0, f64::from(j) / 6.0);
                [0, 1, 2].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v)
            };
            (0..=6).flat_map(|i| (0..=6 - i).map(move |j| at(i, j))).collect::<Vec<_>>()
        };
        let of_g = points(g);
        let apart = |p: &Vector| {
            of_g.iter().map(|&q| dot(minus(*p, q), minus(*p, q))).fold(f64::INFINITY, f64::min).sqrt()
        };
        points(f).iter().map(apart).fold(f64::INFINITY, f64::min)
    }

    /// Whether all corners of the narrower one are near the plane of the wider one.
    fn are_nearly_coplanar(f: &Triangle, g: &Triangle, reach: f64) -> bool {
        let (wide, narrow) = if f.width_2() >= g.width_2() { (f, g) } else { (g, f) };
        let length = dot(wide.normal, wide.normal).sqrt();
        narrow.corners.iter().all(|&p| {
            let off = minus(p, wide.corners[0]);
            let near = reach * (1.0 + 2.0 * dot(off, off).sqrt() / wide.width_2().sqrt());
            dot(wide.normal, off).abs() <= near * length
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn what_is_apart_is_far_and_in_another_plane(
            corners in prop::array::uniform6(prop::array::uniform3(-50i32..50)),
            flat in 0usize..4,
            scale in 1i32..1000,
            reach in 0i32..50,
        ) {
            let mut corners = corners.map(|p| p.map(|x| f64::from(x * scale)));
            // Some lie in a plane, or across it.
            corners.iter_mut().skip(flat).step_by(2).for_each(|p| p[2] /= 50.0);
            let [a, b, c, d, e, f] = corners;
            let (f, g) = (Triangle::through([a, b, c]), Triangle::through([d, e, f]));
            prop_assume!(size(f.normal) > 0.0 && size(g.normal) > 0.0);
            let reach = f64::from(reach);
            if f.keeps_off(&g, reach) {
                prop_assert!(distance(&f, &g) > reach);
                prop_assert!(!are_nearly_coplanar(&f, &g, reach));
            }
            let within = Near::new(&Aabb::around(g.corners));
            prop_assert!(!f.keeps_off_box(&within, reach) || f.keeps_off(&g, reach));
        }
    }

    #[test]
    fn a_large_triangle_and_small_ones_in_its_box() {
        let size = 2f64.powi(40);
        let large = Triangle::through([[-size, -size, -size], [size, size, -size], [size, -size, size]]);
        let small = |at: Vector, size: f64| {
            let corner = |x: f64, y: f64| [at[0] + x * size, at[1] + y * size, at[2] + (x + y) * size];
            Triangle::through([at, corner(1.0, 0.0), corner(0.3, 0.8)])
        };
        let [a, b, c] = large.corners;
        let middle: Vector = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
        for width in [2f64.powi(20), 2f64.powi(30)] {
            let off = small([middle[0], middle[1], middle[2] - size / 1000.0 - 3.0 * width], width);
            assert!(large.keeps_off(&off, 4.0) && large.keeps_off(&off, 2f64.powi(18)));
            assert!(large.keeps_off_box(&Near::new(&Aabb::around(off.corners)), 4.0));
            let across = small(middle.map(|x| x - width / 3.0), width);
            assert!(!large.keeps_off(&across, 0.0));
            assert!(!large.keeps_off_box(&Near::new(&Aabb::around(across.corners)), 0.0));
        }
    }
}
