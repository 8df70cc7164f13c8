//! Areas and volumes of polygonal loops in floating point. Nothing topological is decided here except on which
//! side of a closed surface the inside lies.

use crate::Points;

pub(crate) type Vec3 = [f64; 3];

pub(crate) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Point `i` in space: missing coordinates are 0, those after the third are left out.
pub(crate) fn xyz(points: &Points, i: usize) -> Vec3 {
    match *points.point(i) {
        [x, y, z, ..] => [x, y, z],
        [x, y] => [x, y, 0.],
        [x] => [x, 0., 0.],
        [] => [0.; 3],
    }
}

/// Signed area of a loop of plane points, positive when counter-clockwise; relative to its first vertex.
pub(crate) fn loop_area_2d(points: &Points, cycle: &[u32]) -> f64 {
    let Some(&first) = cycle.first() else { return 0. };
    let origin = points.point(first as usize);
    let at = |v: u32| {
        let p = points.point(v as usize);
        [p[0] - origin[0], p[1] - origin[1]]
    };
    let doubled: f64 =
        cycle.windows(2).map(|w| (at(w[0]), at(w[1]))).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
    doubled / 2.
}

/// The area vector of a loop (Newell): its direction is the normal seen from which the loop turns
/// counter-clockwise, its length the area of the loop's projection along it. Relative to the first vertex.
pub(crate) fn loop_area_vector(points: &Points, cycle: &[u32]) -> Vec3 {
    let Some(&first) = cycle.first() else { return [0.; 3] };
    let origin = xyz(points, first as usize);
    let at = |v: u32| sub(xyz(points, v as usize), origin);
    let mut doubled = [0.; 3];
    for w in cycle.windows(2) {
        let c = cross(at(w[0]), at(w[1]));
        for (sum, x) in doubled.iter_mut().zip(c) {
            *sum += x;
        }
    }
    doubled.map(|x| x / 2.)
}

/// Signed volume of the cone from `apex` over the triangles that fan out from the loop's first vertex;
/// positive when the loop turns counter-clockwise seen from outside. Summed over the loops of a closed surface
/// this is the enclosed volume, whatever the apex.
pub(crate) fn loop_cone_volume(points: &Points, cycle: &[u32], apex: Vec3) -> f64 {
    let Some(&first) = cycle.first() else { return 0. };
    dot(loop_area_vector(points, cycle), sub(xyz(points, first as usize), apex)) / 3.
}
