//! Simple solids for examples and tests.

use crate::{Cells, Model, Points, TriangleMesh};
use rustc_hash::FxHashMap;

/// The standard d-simplex: the origin and the d unit points, with all its skeletons. The p-cells are the
/// subsets of p + 1 vertices in lexicographic order. A simplex of no dimension has no cells, since points
/// without coordinates are not counted.
///
/// # Panics
/// When `d` is above 24: the skeletons have 2^(d+1) cells.
///
/// ```
/// let tetrahedron = lar_core::simplex(3);
/// assert_eq!(tetrahedron.f_vector(), [4, 6, 4, 1]);
/// assert_eq!(&tetrahedron.cells(2)[1], [0, 1, 3]);
/// ```
#[must_use]
pub fn simplex(d: usize) -> Model {
    assert!(d <= 24, "the skeletons of a {d}-simplex have 2^{} cells", d + 1);
    if d == 0 {
        return Model::new(Points::new(0), vec![Cells::new()]);
    }
    let mut points = Points::new(d);
    let mut corner = vec![0.; d];
    points.push(&corner);
    for axis in 0..d {
        corner[axis] = 1.;
        points.push(&corner);
        corner[axis] = 0.;
    }
    let mut cells = vec![Cells::new(); d + 1];
    push_subsets(&mut Vec::new(), 0, d, &mut cells);
    Model::new(points, cells)
}

/// Appends every extension of `chosen` by vertices from `next..=d`, in lexicographic order within each size.
fn push_subsets(chosen: &mut Vec<u32>, next: usize, d: usize, cells: &mut [Cells]) {
    for v in (0_u32..).take(d + 1).skip(next) {
        chosen.push(v);
        cells[chosen.len() - 1].push(chosen);
        push_subsets(chosen, v as usize + 1, d, cells);
        chosen.pop();
    }
}

/// The prism over the triangle (0,0), (1,0), (0,1) from z = 0 to z = 1, with all its skeletons: f-vector 6, 9,
/// 5, 1.
///
/// ```
/// let prism = lar_core::triangular_prism();
/// assert_eq!(prism.f_vector(), [6, 9, 5, 1]);
/// ```
#[must_use]
pub fn triangular_prism() -> Model {
    let base = [[0., 0.], [1., 0.], [0., 1.]];
    let points: Vec<[f64; 3]> = [0., 1.].iter().flat_map(|&z| base.map(|[x, y]| [x, y, z])).collect();
    let edges = vec![0, 1, 0, 2, 1, 2, 3, 4, 3, 5, 4, 5, 0, 3, 1, 4, 2, 5];
    let faces: [&[u32]; 5] = [&[0, 1, 2], &[3, 4, 5], &[0, 1, 3, 4], &[0, 2, 3, 5], &[1, 2, 4, 5]];
    let cells = vec![
        Cells::singletons(6),
        Cells::uniform(2, edges),
        faces.into_iter().collect(),
        Cells::uniform(6, (0..6).collect()),
    ];
    Model::new(Points::from_xyz(&points), cells)
}

/// A sphere of radius 1 about the origin: the regular icosahedron, its triangles cut into four at the
/// midpoints of their edges and the midpoints pushed out to the sphere, `level` times. 20 · 4^level triangles,
/// outward. O(size).
///
/// # Panics
/// When `level` is above 13: the vertices could not be numbered by `u32`.
///
/// ```
/// let sphere = lar_core::icosphere(2);
/// assert_eq!((sphere.points.len(), sphere.triangles.len()), (162, 320));
/// assert!(sphere.is_closed());
/// ```
#[must_use]
pub fn icosphere(level: u32) -> TriangleMesh {
    assert!(level <= 13, "an icosphere of level {level} has 10 · 4^{level} + 2 vertices");
    let mut points = icosahedron_points();
    let mut triangles = ICOSAHEDRON.to_vec();
    for _ in 0..level {
        triangles = subdivided(&mut points, &triangles);
    }
    TriangleMesh { points: Points::from_xyz(&points), triangles }
}

/// The corners (±1, ±φ, 0) and their cyclic shifts, on the unit sphere.
fn icosahedron_points() -> Vec<[f64; 3]> {
    let golden = f64::midpoint(1., 5_f64.sqrt());
    let mut points = Vec::with_capacity(12);
    for shift in 0..3 {
        for [one, phi] in [[-1., golden], [1., golden], [-1., -golden], [1., -golden]] {
            let mut corner = [one, phi, 0.];
            corner.rotate_right(shift);
            points.push(on_sphere(corner));
        }
    }
    points
}

const ICOSAHEDRON: [[u32; 3]; 20] = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
];

fn on_sphere(p: [f64; 3]) -> [f64; 3] {
    let length = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    p.map(|x| x / length)
}

/// Each triangle cut into four; new points are appended in first-seen order.
fn subdivided(points: &mut Vec<[f64; 3]>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            let (p, q) = (points[a as usize], points[b as usize]);
            points.push(on_sphere([p[0] + q[0], p[1] + q[1], p[2] + q[2]]));
            u32::try_from(points.len() - 1).expect("at most 10 · 4^13 + 2 vertices")
        })
    };
    let mut cut = Vec::with_capacity(4 * triangles.len());
    for &[a, b, c] in triangles {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        cut.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn icospheres_are_round_closed_and_outward() {
        for level in 0..5 {
            let sphere = icosphere(level);
            assert_eq!(sphere.triangles.len(), 20 * 4_usize.pow(level));
            assert_eq!(sphere.points.len(), 10 * 4_usize.pow(level) + 2);
            assert!(sphere.is_closed());
            assert_eq!(sphere.n_components(), 1);
            assert!(sphere.signed_volume() > 2.5);
            assert!(sphere.points.iter().all(|p| (p.iter().map(|x| x * x).sum::<f64>() - 1.).abs() < 1e-15));
        }
        let icosahedron = icosphere(0);
        for &[a, b, c] in &icosahedron.triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let [p, q] = [p, q].map(|v| icosahedron.points.xyz(v as usize));
                let squared: f64 = p.iter().zip(q).map(|(x, y)| (x - y) * (x - y)).sum();
                assert!((squared - (2. - 2. / 5_f64.sqrt())).abs() < 1e-15);
            }
        }
    }

    #[track_caller]
    fn check_solid(model: &Model, f_vector: &[usize], volume: f64) {
        assert_eq!(model.validate(), []);
        assert_eq!(model.f_vector(), f_vector);
        let complex = crate::ChainComplex::from_model(model).unwrap();
        assert_eq!(complex.cell_volumes().len(), 1);
        assert!((complex.cell_volumes()[0] - volume).abs() < 1e-15);
    }

    #[test]
    fn solids() {
        check_solid(&simplex(3), &[4, 6, 4, 1], 1. / 6.);
        check_solid(&triangular_prism(), &[6, 9, 5, 1], 0.5);
        assert_eq!(simplex(0).f_vector(), [0]);
        assert_eq!(simplex(1).f_vector(), [2, 1]);
        assert_eq!(simplex(5).f_vector(), [6, 15, 20, 15, 6, 1]);
        assert_eq!(simplex(5).validate(), []);
    }
}
