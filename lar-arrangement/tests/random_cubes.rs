//! A thousand scenes of randomly turned cubes: the laws of the complex, and volumes by inclusion.

mod common;

use common::{Random, random_cubes};
use lar_arrangement::{Arrangement, Arranger, Checks, Closure};
use lar_core::CellId;

const SCENES: u64 = 1000;

#[track_caller]
fn check(seed: u64) -> Arrangement {
    let random = &mut Random(seed);
    let n = 3 + random.below(10);
    let (cubes, sizes) = random_cubes(n, random);
    // The stages' own tests on every eighth scene; they cost more than the arrangement.
    let checks = if seed.is_multiple_of(8) { Checks::EveryStage } else { Checks::Off };
    let a = Arranger::new().checks(checks).arrange(&cubes).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
    assert_eq!(a.complex().validate(), [], "seed {seed}");
    assert_eq!(a.euler(), 0, "seed {seed}");
    assert_eq!(a.dangling_faces().count(), 0, "seed {seed}");
    let volumes = a.volumes();
    assert!(volumes[1..].iter().all(|&v| v > 0.0), "seed {seed}: {volumes:?}");
    let bounded: f64 = volumes[1..].iter().sum();
    assert!((bounded + volumes[0]).abs() <= 1e-9 * bounded, "seed {seed}: {bounded} inside {}", volumes[0]);
    for (solid, size) in sizes.iter().enumerate() {
        assert_eq!(a.closure(solid), Closure::Closed, "seed {seed}: cube {solid}");
        let inside = |cell: usize| match a.winding(CellId(cell as u32), solid) {
            0 => 0.0,
            1 => volumes[cell],
            w => panic!("seed {seed}: winding number {w} of cube {solid} in cell {cell}"),
        };
        let (found, expected): (f64, f64) = ((1..volumes.len()).map(inside).sum(), size.powi(3));
        assert!(
            (found - expected).abs() <= 1e-9 * expected,
            "seed {seed}: cube {solid}: {found}, {expected}"
        );
    }
    a
}

/// Two threads take every second scene each.
#[test]
fn laws_and_volumes() {
    let cells_of = |first: u64| (first..SCENES).step_by(2).map(|seed| check(seed).n_cells()).sum::<usize>();
    let total = std::thread::scope(|scope| {
        let odd = scope.spawn(|| cells_of(1));
        cells_of(0) + odd.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    assert!(total > 20 * SCENES as usize, "only {total} cells: the cubes hardly meet");
}
