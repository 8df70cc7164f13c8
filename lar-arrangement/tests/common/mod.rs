//! What the tests of arrangements share: random numbers, scenes, exact variants of a scene, and its counts.
#![allow(dead_code, reason = "every test binary uses a part of it")]

use lar_arrangement::{Arrangement, ArrangementError, Arranger, Checks};
use lar_core::{Affine, Points, Struct, Surface, TriangleMesh, cuboid_grid, r, rotation, t};
use std::f64::consts::TAU;

/// SplitMix64 (Steele, Lea, Flood 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// Uniform in lo..hi.
    pub(crate) fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A random order of 0..n.
    pub(crate) fn permutation(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        (1..n).for_each(|i| order.swap(i, self.below(i + 1)));
        order
    }
}

/// Runs a check on `count` seeds from 0 on, or as many as `LAR_SCENES` says from `LAR_SEED` on; a panic is followed by
/// its seed.
pub(crate) fn each_seed(count: u64, check: impl Fn(u64)) {
    each_of([], count, check);
}

/// The same, after the seeds that once failed.
pub(crate) fn each_of<const N: usize>(failed_once: [u64; N], count: u64, check: impl Fn(u64)) {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let first = number("LAR_SEED").unwrap_or(0);
    let drawn = first..first + number("LAR_SCENES").unwrap_or(count);
    for seed in failed_once.into_iter().chain(drawn) {
        let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| check(seed)));
        assert!(outcome.is_ok(), "LAR_SEED={seed} LAR_SCENES=1 shows it again");
    }
}

/// The surfaces of a scene.
pub(crate) fn surfaces(scene: &Struct) -> Vec<Surface> {
    let models = scene.eval_struct().expect("the scene is well formed");
    models.iter().map(|m| m.to_surface().expect("the models have faces")).collect()
}

/// A surface of faces with one loop each.
pub(crate) fn surface(points: &[[f64; 3]], faces: &[&[u32]]) -> Surface {
    let mut out = Surface::new("surface", Points::from_xyz(points));
    faces.iter().for_each(|&face| {
        out.push_face([face], 1);
    });
    out
}

/// The box between two corners, faces outward.
pub(crate) fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Surface {
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { lo[k] } else { hi[k] });
    let faces: [&[u32]; 6] =
        [&[0, 4, 6, 2], &[1, 3, 7, 5], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 2, 3, 1], &[4, 5, 7, 6]];
    surface(&(0..8).map(corner).collect::<Vec<_>>(), &faces)
}

/// An upright prism over a regular polygon of `n` corners, turned by a part of a corner.
pub(crate) fn prism(n: u32, radius: f64, turn: f64, z: [f64; 2]) -> Surface {
    let corner = |i: u32, z: f64| {
        let angle = TAU * (f64::from(i) + turn) / f64::from(n);
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    let points: Vec<[f64; 3]> = z.iter().flat_map(|&z| (0..n).map(move |i| corner(i, z))).collect();
    let mut out = surface(&points, &[]);
    let (top, bottom): (Vec<u32>, Vec<u32>) = ((n..2 * n).collect(), (0..n).rev().collect());
    out.push_face([&bottom[..]], 1);
    out.push_face([&top[..]], 1);
    for i in 0..n {
        out.push_face([&[i, (i + 1) % n, n + (i + 1) % n, n + i][..]], 1);
    }
    out
}

/// Faces of one convex loop as fans of triangles.
pub(crate) fn triangle_mesh(s: &Surface) -> TriangleMesh {
    let fan = |f: usize| {
        let cycle = s.face(f).next().expect("faces have a loop").to_vec();
        (1..cycle.len() - 1).map(move |i| [cycle[0], cycle[i], cycle[i + 1]])
    };
    TriangleMesh { points: s.points.clone(), triangles: (0..s.n_faces()).flat_map(fan).collect() }
}

/// All stages checked.
pub(crate) fn arrange_checked(surfaces: &[Surface]) -> Result<Arrangement, ArrangementError> {
    Arranger::new().checks(Checks::EveryStage).arrange(surfaces)
}

/// All stages checked; panics when one does not hold.
#[track_caller]
pub(crate) fn arranged(surfaces: &[Surface]) -> Arrangement {
    arrange_checked(surfaces).unwrap_or_else(|e| panic!("{e}"))
}

/// Vertices, edges, faces, cells.
pub(crate) fn counts(a: &Arrangement) -> [usize; 4] {
    [a.n_vertices(), a.n_edges(), a.n_faces(), a.n_cells()]
}

/// Everything that is counted: vertices, edges, faces, cells, shells, loops, components, dangling faces, parents.
pub(crate) fn all_counts(a: &Arrangement) -> [usize; 9] {
    let [v, e, f, c] = counts(a);
    let parents = (0..f as u32).map(|f| a.parents(lar_core::FaceId(f)).len()).sum();
    [v, e, f, c, a.n_shells(), a.n_loops(), a.n_components(), a.dangling_faces().count(), parents]
}

/// Volumes of the bounded cells, ascending.
pub(crate) fn sorted_volumes(a: &Arrangement) -> Vec<f64> {
    let mut volumes = a.volumes()[1..].to_vec();
    volumes.sort_by(f64::total_cmp);
    volumes
}

#[track_caller]
pub(crate) fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    let close =
        found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance);
    assert!(close, "{what}: {found:?} instead of {expected:?} (± {tolerance:e})");
}

/// The surface with its points mapped; loops stay as they are.
pub(crate) fn mapped(s: &Surface, map: impl Fn([f64; 3]) -> [f64; 3]) -> Surface {
    let mut out = s.clone();
    let points: Vec<[f64; 3]> = (0..s.points.len()).map(|i| map(s.points.xyz(i))).collect();
    out.points = Points::from_xyz(&points);
    out
}

/// The surfaces moved by an affine map.
pub(crate) fn moved(surfaces: &[Surface], map: &Affine) -> Vec<Surface> {
    surfaces.iter().map(|s| s.transformed(map).expect("a map of 3-space")).collect()
}

/// All loops reversed.
pub(crate) fn flipped(s: &Surface) -> Surface {
    rebuilt(s, &(0..s.n_faces()).collect::<Vec<_>>(), |cycle| cycle.reverse())
}

/// The faces in another order, each loop starting elsewhere; points keep their numbers.
pub(crate) fn shuffled(s: &Surface, random: &mut Random) -> Surface {
    let order = random.permutation(s.n_faces());
    rebuilt(s, &order, |cycle| {
        let start = random.below(cycle.len().max(1));
        cycle.rotate_left(start);
    })
}

fn rebuilt(s: &Surface, order: &[usize], mut change: impl FnMut(&mut Vec<u32>)) -> Surface {
    let mut out = Surface::new(s.name.clone(), s.points.clone());
    for &f in order {
        let mut loops: Vec<Vec<u32>> = s.face(f).map(<[u32]>::to_vec).collect();
        loops.iter_mut().for_each(&mut change);
        out.push_face(loops.iter().map(Vec::as_slice), s.coefficient(f));
    }
    out
}

/// The surface with its points in another order.
pub(crate) fn renumbered(s: &Surface, random: &mut Random) -> Surface {
    let order = random.permutation(s.points.len());
    let mut new_from_old = vec![0; order.len()];
    order.iter().zip(0..).for_each(|(&old, new)| new_from_old[old] = new);
    let points: Vec<[f64; 3]> = order.iter().map(|&old| s.points.xyz(old)).collect();
    let all: Vec<usize> = (0..s.n_faces()).collect();
    let mut out = rebuilt(s, &all, |cycle| cycle.iter_mut().for_each(|v| *v = new_from_old[*v as usize]));
    out.points = Points::from_xyz(&points);
    out
}

/// Variants whose coordinates are the same numbers up to order and sign, so that snapping does the same to them:
/// quarter turns, mirrored axes, permuted axes.
pub(crate) fn exact_motions(surfaces: &[Surface]) -> Vec<(&'static str, Vec<Surface>)> {
    type Motion = (&'static str, fn([f64; 3]) -> [f64; 3]);
    let motions: [Motion; 7] = [
        ("quarter turn about x", |[x, y, z]| [x, -z, y]),
        ("quarter turn about y", |[x, y, z]| [z, y, -x]),
        ("quarter turn about z", |[x, y, z]| [-y, x, z]),
        ("axes x y z to y z x", |[x, y, z]| [y, z, x]),
        ("axes x y z to y x z", |[x, y, z]| [y, x, z]),
        ("mirrored x", |[x, y, z]| [-x, y, z]),
        ("mirrored y and z", |[x, y, z]| [x, -y, -z]),
    ];
    motions.map(|(name, m)| (name, surfaces.iter().map(|s| mapped(s, m)).collect())).into()
}

/// Variants that change nothing but numbers and orientations.
pub(crate) fn relabelled(surfaces: &[Surface], seed: u64) -> Vec<(&'static str, Vec<Surface>)> {
    let random = &mut Random(seed);
    let reversed: Vec<Surface> = surfaces.iter().rev().cloned().collect();
    let shuffle: Vec<Surface> = surfaces.iter().map(|s| shuffled(s, random)).collect();
    let number: Vec<Surface> = surfaces.iter().map(|s| renumbered(s, random)).collect();
    let one: Vec<Surface> =
        surfaces.iter().enumerate().map(|(i, s)| if i == 0 { flipped(s) } else { s.clone() }).collect();
    vec![
        ("solids in reverse order", reversed),
        ("faces in another order", shuffle),
        ("points in another order", number),
        ("all faces flipped", surfaces.iter().map(flipped).collect()),
        ("faces of the first solid flipped", one),
    ]
}

/// The scene of the 2019 paper's section 6.2.
pub(crate) fn three_cubes() -> Struct {
    let (pi, cube) = (std::f64::consts::PI, cuboid_grid(&[1, 1, 1]));
    Struct::new("three cubes")
        .with(cube.clone())
        .with(t(&[0.3, 0.4, 0.25]))
        .with(r([pi / 5.0, 0.0, 0.0]))
        .with(r([0.0, 0.0, pi / 12.0]))
        .with(cube.clone())
        .with(t(&[-0.2, 0.4, -0.2]))
        .with(r([0.0, pi / 5.0, 0.0]))
        .with(r([0.0, pi / 12.0, 0.0]))
        .with(cube)
}

/// `n` cubes of edge 0.3 to 1.3 about the origin, turned at random; also their edges' lengths.
pub(crate) fn random_cubes(n: usize, random: &mut Random) -> (Vec<Surface>, Vec<f64>) {
    (0..n)
        .map(|_| {
            let size = random.between(0.3, 1.3);
            let axis = [0; 3].map(|_| random.between(-1.0, 1.0));
            let turn = rotation(axis, random.between(0.0, 3.0)).expect("the axis is not zero");
            let at = [0; 3].map(|_| random.between(-0.8, 0.8));
            let half = size / 2.0;
            let placed = t(&at).compose(&turn).expect("both are maps of 3-space");
            (cuboid([-half; 3], [half; 3]).transformed(&placed).expect("a map of 3-space"), size)
        })
        .unzip()
}
