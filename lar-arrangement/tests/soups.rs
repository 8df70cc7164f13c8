//! Random triangles and quadrilaterals with small integer corners: coplanar overlaps, common edges, corners inside
//! faces, repeated and degenerate faces abound. No counts are known beforehand; laws are.

mod common;

use common::{all_counts, exact_motions, flipped, shuffled, surface};
use lar_arrangement::{Arrangement, Arranger, Checks, Planes};
use lar_core::Surface;
use proptest::prelude::*;
use std::num::NonZeroUsize;

type Corner = [i8; 3];

fn corner() -> impl Strategy<Value = Corner> {
    prop::array::uniform3(0i8..4)
}

/// A triangle, possibly degenerate.
fn triangle() -> impl Strategy<Value = Vec<Corner>> {
    prop::collection::vec(corner(), 3)
}

/// Four corners anywhere: skew, or self-crossing, or both.
fn skew() -> impl Strategy<Value = Vec<Corner>> {
    prop::collection::vec(corner(), 4)
}

/// p, p + a, p + a + b, p + b, in this order or crossing itself.
fn planar() -> impl Strategy<Value = Vec<Corner>> {
    (corner(), corner(), corner(), any::<bool>()).prop_map(|(p, a, b, crossed)| {
        let sum = |x: Corner, y: Corner| -> Corner { std::array::from_fn(|k| x[k] + y[k] - 1) };
        let (q, r) = (sum(p, a), sum(p, b));
        let far = sum(q, b);
        if crossed { vec![p, q, r, far] } else { vec![p, q, far, r] }
    })
}

fn soup(face: impl Strategy<Value = Vec<Corner>>) -> impl Strategy<Value = Vec<Vec<Corner>>> {
    prop::collection::vec(face, 2..=12)
}

/// Corners on the integer lattice moved by up to two steps of the arrangement's grid, or nearly so.
fn nearly(corner: [(i8, i8); 3]) -> [f64; 3] {
    corner.map(|(x, moved)| f64::from(x) + f64::from(moved) * 2f64.powi(-38))
}

/// A triangle or quadrilateral that is nearly a lattice one.
fn nearly_degenerate() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let moved = prop_oneof![3 => Just(0i8), 1 => -2i8..=2];
    let corner = prop::array::uniform3((0i8..4, moved)).prop_map(nearly);
    prop::collection::vec(corner, 3..=3)
}

/// One surface, every face with its own points.
fn surface_of(faces: &[Vec<Corner>]) -> Surface {
    surface_at(&faces.iter().map(|f| f.iter().map(|p| p.map(f64::from)).collect()).collect::<Vec<_>>())
}

fn surface_at(faces: &[Vec<[f64; 3]>]) -> Surface {
    let points: Vec<[f64; 3]> = faces.concat();
    let mut begin = 0;
    let ids: Vec<Vec<u32>> = faces
        .iter()
        .map(|f| {
            let ids = (begin..begin + f.len() as u32).collect();
            begin += f.len() as u32;
            ids
        })
        .collect();
    surface(&points, &ids.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

fn arranged(surfaces: &[Surface], planes: Planes) -> Result<Arrangement, TestCaseError> {
    let arranger = Arranger::new().checks(Checks::EveryStage).planes(planes);
    arranger.arrange(surfaces).map_err(|e| TestCaseError::fail(e.to_string()))
}

fn json(surfaces: &[Surface], threads: usize) -> Result<String, TestCaseError> {
    let threads = NonZeroUsize::new(threads).expect("at least one thread");
    let a = Arranger::new().threads(threads).arrange(surfaces);
    let a = a.map_err(|e| TestCaseError::fail(e.to_string()))?;
    a.complex().to_json().map_err(|e| TestCaseError::fail(e.to_string()))
}

/// The laws that hold for every soup. Returns its arrangement.
fn check_laws(surface: &Surface, seed: u64, planes: Planes) -> Result<Arrangement, TestCaseError> {
    let one = std::slice::from_ref(surface);
    let a = arranged(one, planes)?;
    prop_assert_eq!(json(one, 1)?, json(one, 3)?);
    let total: f64 = a.volumes().iter().sum();
    prop_assert!(total.abs() < 1e-9, "volumes add up to {}", total);
    let random = &mut common::Random(seed);
    for variant in [flipped(surface), shuffled(surface, random)] {
        let other = arranged(&[variant], planes)?;
        prop_assert_eq!(all_counts(&other), all_counts(&a));
    }
    Ok(a)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_500))]

    /// The diagonal of a skew quadrilateral depends on the axis of its projection, so axes stay.
    #[test]
    fn skew_faces(faces in soup(prop_oneof![triangle(), skew()]), seed: u64) {
        check_laws(&surface_of(&faces), seed, Planes::Canonical)?;
    }

    #[test]
    fn planar_faces(faces in soup(prop_oneof![triangle(), planar()]), seed: u64) {
        let surface = surface_of(&faces);
        let a = check_laws(&surface, seed, Planes::Canonical)?;
        for (name, variant) in exact_motions(&[surface]) {
            let other = arranged(&variant, Planes::Canonical)?;
            prop_assert_eq!(all_counts(&other), all_counts(&a), "{}", name);
        }
    }

    /// Corners a step beside edges and planes: every filter must give way to the exact answer. With canonical planes
    /// most of them are on these edges and planes; which, may hang on the numbering, the laws do not.
    #[test]
    fn nearly_degenerate_faces(faces in prop::collection::vec(nearly_degenerate(), 2..=12), seed: u64) {
        let surface = surface_at(&faces);
        let a = check_laws(&surface, seed, Planes::AsGiven)?;
        for (name, variant) in exact_motions(&[surface]) {
            prop_assert_eq!(all_counts(&arranged(&variant, Planes::AsGiven)?), all_counts(&a), "{}", name);
            arranged(&variant, Planes::Canonical)?;
        }
    }

    /// Everything in two planes at a right angle: all pairs are coplanar or meet in one line.
    #[test]
    fn faces_in_two_planes(faces in soup(triangle()), seed: u64) {
        let flat: Vec<Vec<Corner>> = faces
            .iter()
            .enumerate()
            .map(|(i, f)| f.iter().map(|&[x, y, _]| if i % 3 == 0 { [x, 1, y] } else { [x, y, 2] }).collect())
            .collect();
        let surface = surface_of(&flat);
        let a = check_laws(&surface, seed, Planes::Canonical)?;
        for (name, variant) in exact_motions(&[surface]) {
            let other = arranged(&variant, Planes::Canonical)?;
            prop_assert_eq!(all_counts(&other), all_counts(&a), "{}", name);
        }
    }
}
