//! Checks of an arrangement against its input and against the laws of chain complexes.

use lar_arrangement::{Arrangement, Parent};
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
/// what moved onto canonical planes. Input faces that share a merged face of the arrangement are taken together.
///
/// `surfaces` are those that were arranged. O(size of both).
#[must_use]
pub fn parents_ok(arrangement: &Arrangement, surfaces: &[Surface]) -> bool {
    let scale = unit(surfaces);
    let faces = || (0..).map(FaceId).take(arrangement.n_faces());
    let mut sums = Sums::new(surfaces);
    for face in faces() {
        let parents = arrangement.parents(face);
        let Some(numbers) = parents.iter().map(|p| sums.number(p)).collect::<Option<Vec<_>>>() else {
            return false;
        };
        if parents.is_empty() {
            return false;
        }
        if arrangement.crossed(face).len() < parents.len() {
            for (&a, p) in numbers.iter().zip(parents) {
                let first = parents.iter().position(|q| q.solid == p.solid).map_or(a, |i| numbers[i]);
                sums.join(first, a);
            }
        }
    }
    for face in faces() {
        let loops = arrangement.face_vertices(face);
        let (area, _) = measures(loops, |v| scaled(arrangement.complex().points(), v, scale));
        for parent in arrangement.crossed(face) {
            let number = sums.number(parent).expect("all were looked up");
            sums.add(number, -f64::from(parent.sign), area);
        }
    }
    let stats = arrangement.stats();
    let moved = (SNAPPING_STEPS * stats.grid_step + 2.0 * stats.farthest_move) * scale;
    for (surface, first) in surfaces.iter().zip(sums.firsts.clone()) {
        for f in 0..surface.n_faces() {
            let (area, perimeter) = measures(surface.face(f), |v| scaled(&surface.points, v, scale));
            sums.add(first + f, 1.0, area);
            sums.allow(first + f, AREA_TOLERANCE * length(area) + moved * (perimeter + moved));
        }
    }
    sums.are_zero()
}

/// Sums of vector areas by groups of input faces, which should be zero, and by how much they may not be.
struct Sums {
    /// Number of the first face of each surface.
    firsts: Vec<usize>,
    /// Another face of its group, or itself for the one that has the sum.
    group: Vec<usize>,
    sums: Vec<(Vec3, f64)>,
}

impl Sums {
    fn new(surfaces: &[Surface]) -> Self {
        let mut n = 0;
        let first = |s: &Surface| {
            n += s.n_faces();
            n - s.n_faces()
        };
        let firsts = surfaces.iter().map(first).collect();
        Self { firsts, group: (0..n).collect(), sums: vec![([0.0; 3], 0.0); n] }
    }

    /// Number of an input face, if there is such a face.
    fn number(&self, parent: &Parent) -> Option<usize> {
        let solid = parent.solid as usize;
        let end = self.firsts.get(solid + 1).copied().unwrap_or(self.group.len());
        let number = self.firsts.get(solid)? + parent.face as usize;
        (number < end).then_some(number)
    }

    fn root(&mut self, mut i: usize) -> usize {
        while self.group[i] != i {
            self.group[i] = self.group[self.group[i]];
            i = self.group[i];
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.group[b] = a;
    }

    fn add(&mut self, number: usize, factor: f64, area: Vec3) {
        let root = self.root(number);
        let (sum, _) = &mut self.sums[root];
        *sum = std::array::from_fn(|k| sum[k] + factor * area[k]);
    }

    fn allow(&mut self, number: usize, slack: f64) {
        let root = self.root(number);
        self.sums[root].1 += slack;
    }

    fn are_zero(&self) -> bool {
        self.sums.iter().all(|&(sum, slack)| length(sum) <= slack)
    }
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
    use lar_arrangement::{Arranger, Merge, arrange};
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
    fn merged_faces_add_up_together() {
        let input: Vec<Surface> = [two_spheres(1, 0.5).unwrap().to_vec(), surfaces_of_triangles()].concat();
        let arrangement = Arranger::new().merge(Merge::Coplanar).arrange(&input).unwrap();
        assert!(parents_ok(&arrangement, &input));
        let mut other = input.clone();
        let cube = other.last_mut().unwrap();
        *cube = cube.transformed(&s(&[1.0, 1.0, 1.001])).unwrap();
        assert!(!parents_ok(&arrangement, &other));
    }

    /// The three cubes as triangles.
    fn surfaces_of_triangles() -> Vec<Surface> {
        let cubes = surfaces(&three_cubes()).unwrap();
        let triangles = |cube: &Surface| {
            let model = lar_core::ChainComplex::from_surface(cube).unwrap();
            let triangles = lar_triangle::triangulate(&model).unwrap();
            let faces = (0..6).map(|f| (FaceId(f), 1));
            Surface::from_triangles("cube", &triangles.mesh_of_faces(model.points(), faces).unwrap())
        };
        cubes.iter().map(triangles).collect()
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
