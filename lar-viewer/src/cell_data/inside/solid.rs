//! A point of a solid far from its boundary: the middle of a chord, moved to the middle of others.
//!
//! A ray into the solid from one of its triangles leaves it at the next one, and what is between is inside, so that no
//! point has to be located.

use glam::DVec3;

type Triangle = [DVec3; 3];

/// Triangles that chords begin at, at most: the largest.
const CHORDS: usize = 24;
/// Rounds of moving the point to the middles of chords through it.
const ROUNDS: usize = 3;
/// Directions of those chords.
const DIRECTIONS: [DVec3; 7] = [
    DVec3::X,
    DVec3::Y,
    DVec3::Z,
    DVec3::new(1.0, 1.0, 1.0),
    DVec3::new(-1.0, 1.0, 1.0),
    DVec3::new(1.0, -1.0, 1.0),
    DVec3::new(1.0, 1.0, -1.0),
];
/// The centroid will do when it is as deep as this part of what chords find.
const NEARLY_BEST: f64 = 0.8;

/// A point far from the triangles, which are counter-clockwise from outside: the centroid where it sees all of them from
/// inside and nothing is much deeper; the centroid as well when there is no chord.
pub(super) fn deep_point(triangles: &[Triangle], centroid: DVec3) -> DVec3 {
    let inward = |[a, b, c]: &Triangle| (b - a).cross(c - a).dot(centroid - a) < 0.0;
    let inside = triangles.iter().all(inward);
    let at_centroid = if inside { clearance(triangles, centroid) } else { 0.0 };
    // No ball inside is larger than one of the solid's volume.
    if inside && 0.55 * (0.75 * volume(triangles, centroid) / std::f64::consts::PI).cbrt() <= at_centroid {
        return centroid;
    }
    let chords = largest(triangles).into_iter().filter_map(|t| chord(triangles, t));
    let start = chords.map(|p| (clearance(triangles, p), p)).reduce(deeper);
    let Some(mut best) = start else { return centroid };
    for _ in 0..ROUNDS {
        for direction in DIRECTIONS {
            let [near, far] = [-1.0, 1.0].map(|sign| first_hit(triangles, best.1, sign * direction, 0.0));
            if let (Some(near), Some(far)) = (near, far) {
                let middle = best.1 + 0.5 * (far - near) * direction;
                best = deeper(best, (clearance(triangles, middle), middle));
            }
        }
    }
    if NEARLY_BEST * best.0 <= at_centroid { centroid } else { best.1 }
}

fn deeper(a: (f64, DVec3), b: (f64, DVec3)) -> (f64, DVec3) {
    if a.0 < b.0 { b } else { a }
}

fn largest(triangles: &[Triangle]) -> Vec<&Triangle> {
    let area = |[a, b, c]: &Triangle| (*b - *a).cross(*c - *a).length_squared();
    let mut sorted: Vec<&Triangle> = triangles.iter().collect();
    sorted.sort_by(|s, t| area(t).total_cmp(&area(s)));
    sorted.truncate(CHORDS);
    sorted
}

/// The middle of the chord from the middle of a triangle straight into the solid.
fn chord(triangles: &[Triangle], [a, b, c]: &Triangle) -> Option<DVec3> {
    let inward = (*c - *a).cross(*b - *a).try_normalize()?;
    let from = (*a + *b + *c) / 3.0;
    // The triangle itself is at 0, but for rounding.
    let beyond = 1e-9 * (*b - *a).length().max((*c - *a).length());
    let length = first_hit(triangles, from, inward, beyond)?;
    Some(from + 0.5 * length * inward)
}

/// How far along a ray the first triangle beyond a distance is, in lengths of the direction.
fn first_hit(triangles: &[Triangle], from: DVec3, direction: DVec3, beyond: f64) -> Option<f64> {
    let hits = triangles.iter().filter_map(|t| hit(t, from, direction)).filter(|t| beyond < *t);
    hits.reduce(f64::min)
}

/// Where a ray meets a triangle (Möller and Trumbore, Journal of Graphics Tools 2(1), 1997).
fn hit([a, b, c]: &Triangle, from: DVec3, direction: DVec3) -> Option<f64> {
    let (ab, ac) = (*b - *a, *c - *a);
    let p = direction.cross(ac);
    let determinant = ab.dot(p);
    let s = from - *a;
    let q = s.cross(ab);
    let [u, v, t] = [s.dot(p), direction.dot(q), ac.dot(q)].map(|x| x / determinant);
    // Comparisons with NaN, from a ray in the triangle's plane, do not hold.
    (0.0 <= u && 0.0 <= v && u + v <= 1.0).then_some(t)
}

/// Distance from the nearest triangle.
fn clearance(triangles: &[Triangle], p: DVec3) -> f64 {
    triangles.iter().map(|t| distance(t, p)).fold(f64::INFINITY, f64::min)
}

/// To the triangle's plane where the point is over it, else to the nearest side.
fn distance([a, b, c]: &Triangle, p: DVec3) -> f64 {
    let normal = (*b - *a).cross(*c - *a);
    let over = [[a, b], [b, c], [c, a]].into_iter().all(|[s, e]| 0.0 <= normal.cross(*e - *s).dot(p - *s));
    if let (true, Some(unit)) = (over, normal.try_normalize()) {
        return unit.dot(p - *a).abs();
    }
    let to_side = |s: DVec3, e: DVec3| {
        let along = e - s;
        let t = (along.dot(p - s) / along.length_squared()).clamp(0.0, 1.0);
        p.distance(if t.is_nan() { s } else { s + t * along })
    };
    to_side(*a, *b).min(to_side(*b, *c)).min(to_side(*c, *a))
}

fn volume(triangles: &[Triangle], near: DVec3) -> f64 {
    let six = |[a, b, c]: &Triangle| (*a - near).dot((*b - near).cross(*c - near));
    (triangles.iter().map(six).sum::<f64>() / 6.0).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_core::{Location, Points, SolidLocator, Surface, TriangleMesh};

    /// The walls of a box, outward, or of a cavity.
    fn walls(low: [f64; 3], high: [f64; 3], cavity: bool) -> Vec<Triangle> {
        let corner = |i: usize| {
            DVec3::from_array(std::array::from_fn(|k| if i >> k & 1 == 0 { low[k] } else { high[k] }))
        };
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        triangles.map(|[a, b, c]| if cavity { [a, c, b] } else { [a, b, c] }.map(corner)).collect()
    }

    /// The solid over a polygon, which is counter-clockwise, from height 0 to 1, as triangles from each corner to those of a
    /// triangulation.
    fn prism(polygon: &[[f64; 2]], triangles: &[[usize; 3]]) -> Vec<Triangle> {
        let at = |i: usize, z: f64| DVec3::new(polygon[i][0], polygon[i][1], z);
        let caps = triangles
            .iter()
            .flat_map(|&[a, b, c]| [[at(a, 0.), at(c, 0.), at(b, 0.)], [at(a, 1.), at(b, 1.), at(c, 1.)]]);
        let n = polygon.len();
        let sides = (0..n).flat_map(|i| {
            let j = (i + 1) % n;
            [[at(i, 0.), at(j, 0.), at(j, 1.)], [at(i, 0.), at(j, 1.), at(i, 1.)]]
        });
        caps.chain(sides).collect()
    }

    #[track_caller]
    fn check(triangles: &[Triangle], centroid: DVec3, least: f64) -> DVec3 {
        let p = deep_point(triangles, centroid);
        assert!(least <= clearance(triangles, p), "{p} is {} from the boundary", clearance(triangles, p));
        let corners: Vec<[f64; 3]> = triangles.as_flattened().iter().map(DVec3::to_array).collect();
        let mut points = corners.clone();
        points.sort_by(|p, q| p.partial_cmp(q).unwrap());
        points.dedup();
        let named: Vec<u32> =
            corners.iter().map(|c| points.iter().position(|p| p == c).unwrap() as u32).collect();
        let triangles = named.as_chunks::<3>().0.to_vec();
        let mesh = TriangleMesh { points: Points::from_xyz(&points), triangles };
        let surface = Surface::from_triangles("solid", &mesh);
        assert_eq!(SolidLocator::new(&surface).unwrap().locate(p.to_array()), Location::Inside, "{p}");
        p
    }

    #[test]
    fn the_centroid_of_a_box() {
        let cube = walls([0.0; 3], [1.0; 3], false);
        assert_eq!(check(&cube, DVec3::splat(0.5), 0.5), DVec3::splat(0.5));
        let slab = walls([0.0; 3], [8.0, 8.0, 1.0], false);
        assert_eq!(check(&slab, DVec3::new(4.0, 4.0, 0.5), 0.5), DVec3::new(4.0, 4.0, 0.5));
    }

    #[test]
    fn beside_a_cavity_and_in_a_bend() {
        let hollow = [walls([0.0; 3], [6.0; 3], false), walls([1.0; 3], [5.0; 3], true)].concat();
        check(&hollow, DVec3::splat(3.0), 0.45);
        let angle = [[0., 0.], [4., 0.], [4., 1.], [1., 1.], [1., 4.], [0., 4.]];
        let bent = prism(&angle, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
        check(&bent, DVec3::new(1.36, 1.36, 0.5), 0.45);
    }

    #[test]
    fn without_triangles_the_centroid() {
        assert_eq!(deep_point(&[], DVec3::ONE), DVec3::ONE);
        assert_eq!(deep_point(&[[DVec3::ZERO; 3]], DVec3::ONE), DVec3::ONE);
    }
}
