//! Checks of an arrangement against its input and against the laws of chain complexes.

use lar_arrangement::Arrangement;
use lar_core::{FaceId, Points, Surface, Violation};

/// Relative difference that is allowed between the area of an input face and the sum of its pieces: rounding in sums
/// of a few thousand terms.
const AREA_TOLERANCE: f64 = 1e-9;

/// Grid steps by which a corner may move: half a step each way when it is snapped, the same when the result is
/// rounded, and as much in each of three directions.
const SNAPPING_STEPS: f64 = 4.0;

type Vec3 = [f64; 3];

/// True when each face of the arrangement has a parent, and the vector areas of the pieces of each input face, taken
/// with their relative signs, add up to its own: within 1e-9 of the area plus what snapping to the grid can change, and
/// what moved onto canonical planes.
///
/// `surfaces` are those that were arranged. O(size of both).
#[must_use]
pub fn parents_ok(arrangement: &Arrangement, surfaces: &[Surface]) -> bool {
    let scale = unit(surfaces);
    let mut sums: Vec<Vec<Vec3>> = surfaces.iter().map(|s| vec![[0.0; 3]; s.n_faces()]).collect();
    for face in (0..).map(FaceId).take(arrangement.n_faces()) {
        let parents = arrangement.parents(face);
        if parents.is_empty() {
            return false;
        }
        let loops = arrangement.face_vertices(face);
        let (area, _) = measures(loops, |v| scaled(arrangement.complex().points(), v, scale));
        for parent in parents {
            let entry = sums.get_mut(parent.solid as usize).and_then(|s| s.get_mut(parent.face as usize));
            let Some(sum) = entry else { return false };
            *sum = std::array::from_fn(|k| sum[k] + f64::from(parent.sign) * area[k]);
        }
    }
    let stats = arrangement.stats();
    let moved = (SNAPPING_STEPS * stats.grid_step + 2.0 * stats.farthest_move) * scale;
    surfaces.iter().zip(&sums).all(|(surface, sums)| {
        (0..surface.n_faces()).zip(sums).all(|(f, &sum)| {
            let (area, perimeter) = measures(surface.face(f), |v| scaled(&surface.points, v, scale));
            let slack = AREA_TOLERANCE * length(area) + moved * (perimeter + moved);
            length(sub(area, sum)) <= slack
        })
    })
}

/// True when ∂p·∂p+1 = 0 for all p.
#[must_use]
pub fn boundary_squared_zero(complex: &lar_core::ChainComplex) -> bool {
    let breaks = |v: &Violation| {
        matches!(v, Violation::Square { .. } | Violation::Shape { .. } | Violation::Storage { .. })
    };
    !complex.validate().iter().any(breaks)
}

/// A factor that brings all coordinates into ±1, so that areas neither overflow nor vanish.
fn unit(surfaces: &[Surface]) -> f64 {
    let coordinates = surfaces.iter().flat_map(|s| s.points.coords());
    let largest = coordinates.fold(0.0, |m: f64, x| m.max(x.abs()));
    let factor = largest.recip();
    if factor.is_normal() { factor } else { 1.0 }
}

fn scaled(points: &Points, v: u32, scale: f64) -> Vec3 {
    points.xyz(v as usize).map(|x| x * scale)
}

/// The vector area of a face, its holes counted against it, and the length of all its loops.
fn measures<L: AsRef<[u32]>>(loops: impl Iterator<Item = L>, at: impl Fn(u32) -> Vec3) -> (Vec3, f64) {
    let (mut area, mut perimeter) = ([0.0; 3], 0.0);
    for cycle in loops {
        let cycle = cycle.as_ref();
        let Some(&first) = cycle.first() else { continue };
        let origin = at(first);
        for (i, &v) in cycle.iter().enumerate() {
            let next = cycle[(i + 1) % cycle.len()];
            let [a, b] = [v, next].map(|v| sub(at(v), origin));
            let c = cross(a, b);
            area = std::array::from_fn(|k| area[k] + c[k] / 2.0);
            perimeter += length(sub(b, a));
        }
    }
    (area, perimeter)
}

fn sub(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: Vec3) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{random_cubes, surfaces, three_cubes, two_spheres};
    use lar_arrangement::arrange;
    use lar_core::{s, t};

    #[test]
    fn pieces_of_another_input_do_not_add_up() {
        let input = surfaces(&three_cubes()).unwrap();
        let arrangement = arrange(&input).unwrap();
        assert!(parents_ok(&arrangement, &input));
        assert!(boundary_squared_zero(arrangement.complex()));
        let mut larger = input.clone();
        larger[1] = larger[1].transformed(&s(&[1.0, 1.0, 1.0 + 1e-8])).unwrap();
        assert!(!parents_ok(&arrangement, &larger));
        assert!(!parents_ok(&arrangement, &input[..2]));
        let moved: Vec<_> = input.iter().map(|s| s.transformed(&t(&[1.0, 2.0, 3.0])).unwrap()).collect();
        assert!(parents_ok(&arrangement, &moved), "areas do not depend on the place");
    }
    #[test]
    fn pieces_add_up_in_larger_scenes() {
        let random = (1..=8).map(|n| surfaces(&random_cubes(n + 2, n as u64)).unwrap());
        let spheres = two_spheres(4, 0.7).unwrap().to_vec();
        let sizes = [1e-150, 1e150].map(|size| {
            let cubes = surfaces(&three_cubes()).unwrap();
            cubes.iter().map(|c| c.transformed(&s(&[size; 3])).unwrap()).collect()
        });
        for (i, input) in random.chain([spheres]).chain(sizes).enumerate() {
            let arrangement = arrange(&input).unwrap();
            assert!(parents_ok(&arrangement, &input), "scene {i}");
            assert!(boundary_squared_zero(arrangement.complex()), "scene {i}");
        }
    }

    #[test]
    fn operators_that_do_not_fit_are_no_complex() {
        let cube = arrange(&surfaces(&three_cubes()).unwrap()[..1]).unwrap();
        let complex = cube.complex();
        let mut boundaries: Vec<_> = (1..=3).map(|p| complex.boundary(p).clone()).collect();
        boundaries[2].data_mut()[0] *= -1;
        let broken = lar_core::ChainComplex::new(complex.points().clone(), boundaries);
        assert!(!boundary_squared_zero(&broken));
    }
}
