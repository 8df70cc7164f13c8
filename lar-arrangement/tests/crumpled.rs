//! Meshes that cross themselves: neighbours are settled by points where a mesh is regular. The same triangles turned over at
//! random are regular nowhere, and must give the same cells.

mod common;

use common::{Random, all_counts, arranged, each_seed};
use lar_arrangement::Arrangement;
use lar_core::{Points, Surface, icosphere};
use std::cell::Cell;

/// A sphere of triangles, every point moved.
fn crumpled(level: u32, moved: impl FnMut([f64; 3]) -> [f64; 3]) -> Surface {
    let mut sphere = icosphere(level);
    let points: Vec<[f64; 3]> = (0..sphere.points.len()).map(|p| sphere.points.xyz(p)).map(moved).collect();
    sphere.points = Points::from_xyz(&points);
    Surface::from_triangles("crumpled", &sphere)
}

fn turned_at_random(surface: &Surface, random: &mut Random) -> Surface {
    let mut out = Surface::new("turned", surface.points.clone());
    for triangle in surface.triangles().expect("all faces are triangles").as_chunks::<3>().0 {
        let [a, b, c] = *triangle;
        out.push_face([&if random.below(2) == 0 { [a, b, c] } else { [a, c, b] }[..]], 1);
    }
    out
}

/// Arranged as it is and turned at random: the same counts. Returns the arrangement as it is.
#[track_caller]
fn check(surface: &Surface, seed: u64) -> Arrangement {
    let regular = arranged(std::slice::from_ref(surface));
    let irregular = arranged(&[turned_at_random(surface, &mut Random(seed))]);
    assert_eq!(all_counts(&regular), all_counts(&irregular), "seed {seed}");
    assert!(regular.stats().pairs_tested <= irregular.stats().pairs_tested, "seed {seed}");
    regular
}

#[test]
fn spheres_that_cross_themselves() {
    let n_cells = Cell::new(0);
    each_seed(40, |seed| {
        let random = &mut Random(seed);
        // From hardly dented to a heap of triangles.
        let size = [0.05, 0.2, 0.5, 1.0][seed as usize % 4];
        let mut shift = || size * (random.below(1 << 20) as f64 / f64::from(1 << 19) - 1.0);
        let surface = crumpled(1 + seed as u32 % 2, |p| p.map(|x| x + shift()));
        n_cells.set(n_cells.get() + check(&surface, seed).n_cells() - 2);
    });
    assert!(n_cells.get() > 1000, "only {} cells", n_cells.get());
}

/// On a coarse lattice: triangles in one plane, corners on edges, points that meet.
#[test]
fn spheres_on_a_lattice() {
    each_seed(60, |seed| {
        let random = &mut Random(seed);
        let (scale, reach) = [(2.0, 1), (3.0, 2), (5.0, 2)][seed as usize % 3];
        let mut shift = || random.below(2 * reach + 1) as f64 - reach as f64;
        check(&crumpled(1 + seed as u32 % 2, |p| p.map(|x| (scale * x).round() + shift())), seed);
    });
}

/// Smooth surfaces that fold over and cross themselves: large parts of them are seen side by side along an axis, others
/// cover themselves. Of some there are so many triangles that those which nothing comes near are not looked at.
#[test]
fn spheres_bent_by_waves() {
    let n_cells = Cell::new(0);
    each_seed(12, |seed| {
        let random = &mut Random(seed);
        let mut number = |size: f64| size * (random.below(1 << 20) as f64 / f64::from(1 << 19) - 1.0);
        let waves: [[f64; 4]; 3] =
            std::array::from_fn(|_| [number(1.5), number(3.0), number(3.0), number(3.0)]);
        let bent = |p: [f64; 3]| {
            std::array::from_fn(|k| {
                let [height, a, b, c] = waves[k];
                p[k] + height * (a * p[0] + b * p[1] + c * p[2]).sin()
            })
        };
        let level = if seed % 6 == 5 { 4 } else { 3 };
        n_cells.set(n_cells.get() + check(&crumpled(level, bent), seed).n_cells() - 2);
    });
    assert!(n_cells.get() > 50, "only {} cells", n_cells.get());
}

/// Neighbours in a smooth mesh are no pairs.
#[test]
fn a_sphere_has_few_pairs() {
    let sphere = Surface::from_triangles("sphere", &icosphere(4));
    let a = arranged(std::slice::from_ref(&sphere));
    assert_eq!((a.n_faces(), a.n_cells()), (5120, 2));
    assert!(a.stats().pairs_tested < 1000, "{} pairs", a.stats().pairs_tested);
}
