//! The same bytes for any number of threads.

mod common;

use common::{Random, random_cubes, surfaces, three_cubes};
use lar_arrangement::{Arrangement, Arranger};
use lar_core::{CellId, FaceId, Surface};
use std::num::NonZeroUsize;

/// The complex as JSON, and all that is not in it.
fn written(a: &Arrangement) -> String {
    let faces: Vec<_> = (0..a.n_faces() as u32)
        .map(FaceId)
        .map(|f| {
            (a.cells_of_face(f), a.shells_of_face(f), a.parents(f), a.face_vertices(f).collect::<Vec<_>>())
        })
        .collect();
    let windings: Vec<Vec<i32>> = (0..a.n_cells() as u32)
        .map(|c| (0..a.n_solids()).map(|s| a.winding(CellId(c), s)).collect())
        .collect();
    let json = a.complex().to_json().expect("the complex is valid");
    format!("{json}\n{faces:?}\n{windings:?}\n{:?}", a.volumes())
}

#[track_caller]
fn check(input: &[Surface]) -> Arrangement {
    let arranged = |threads: usize| {
        let threads = NonZeroUsize::new(threads).expect("at least one thread");
        Arranger::new().threads(threads).arrange(input).expect("the input is well formed")
    };
    let one = arranged(1);
    let expected = written(&one);
    for threads in [2, 7, 1] {
        assert!(written(&arranged(threads)) == expected, "{threads} threads give another result");
    }
    one
}

#[test]
fn three_cubes_are_the_same_for_any_number_of_threads() {
    let a = check(&surfaces(&three_cubes()));
    assert_eq!(a.n_cells(), 8);
}

/// Enough facets and pairs that every stage has more than one chunk of work.
#[test]
fn sixty_cubes_are_the_same_for_any_number_of_threads() {
    let a = check(&random_cubes(60, &mut Random(60)).0);
    assert!(a.n_cells() > 1000, "only {} cells", a.n_cells());
}

/// Operations that share threads with others, or begin on one that is at work, end, and give what they give alone.
#[test]
fn operations_at_once_are_as_each_alone() {
    let input = random_cubes(20, &mut Random(20)).0;
    let expected = written(&Arranger::new().threads(NonZeroUsize::MIN).arrange(&input).expect("well formed"));
    let arranged = |threads: usize| {
        let arranger = NonZeroUsize::new(threads).map_or(Arranger::new(), |n| Arranger::new().threads(n));
        assert!(written(&arranger.arrange(&input).expect("well formed")) == expected, "{threads} threads");
    };
    std::thread::scope(|scope| {
        for caller in 0..6 {
            let arranged = &arranged;
            scope.spawn(move || (0..8).for_each(|i| arranged((caller + i) % 4)));
        }
    });
    let report = |_| arranged(2);
    let within = Arranger::new().threads(NonZeroUsize::new(3).expect("more than none")).progress(&report);
    assert!(
        written(&within.arrange(&input).expect("well formed")) == expected,
        "an operation within another"
    );
}
