//! Reports of progress, and stopping at any of them.

mod common;

use common::{Random, cuboid};
use lar_arrangement::planar::{Drawing, PlanarArranger};
use lar_arrangement::{
    Arrangement, ArrangementError, Arranger, BooleanError, Cancel, Detail, Evaluator, Expression, FillRule,
    Progress, Stats,
};
use lar_core::{ChainComplex, Surface};
use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::mpsc;

type Report<'a> = &'a (dyn Fn(Progress) + Sync);

/// An operation with a number of threads, under the eyes of a report and a request to stop.
trait Operation {
    fn run(
        &self,
        threads: usize,
        report: Report,
        cancel: &Cancel,
    ) -> Result<(ChainComplex, Stats), ArrangementError>;
}

impl Operation for Vec<Surface> {
    fn run(
        &self,
        threads: usize,
        report: Report,
        cancel: &Cancel,
    ) -> Result<(ChainComplex, Stats), ArrangementError> {
        let threads = NonZeroUsize::new(threads).unwrap();
        let a = Arranger::new().threads(threads).progress(report).cancel(cancel).arrange(self)?;
        Ok((a.complex().clone(), a.stats().clone()))
    }
}

impl Operation for Drawing {
    fn run(
        &self,
        threads: usize,
        report: Report,
        cancel: &Cancel,
    ) -> Result<(ChainComplex, Stats), ArrangementError> {
        let threads = NonZeroUsize::new(threads).unwrap();
        let a = PlanarArranger::new().threads(threads).progress(report).cancel(cancel).arrange(self)?;
        Ok((a.complex().clone(), a.stats().clone()))
    }
}

/// Boxes that cross, and one in whose upper face many of them stand: segments enough for a tree.
fn boxes() -> Vec<Surface> {
    let mut random = Random(5);
    let mut out = vec![cuboid([-1.0, -1.0, 0.0], [1.0, 1.0, 0.5])];
    for _ in 0..60 {
        let at = [0, 1, 2].map(|_| random.between(-0.5, 0.5));
        out.push(cuboid(at, at.map(|x| x + 0.3)));
    }
    out
}

fn needles() -> Drawing {
    let mut random = Random(6);
    Drawing::from_segments(&Vec::from_iter((0..700).map(|_| [0, 1, 2, 3].map(|_| random.between(0.0, 1.0)))))
}

#[track_caller]
fn check_reports(operation: &impl Operation) {
    let quiet = operation.run(1, &|_| (), &Cancel::new()).unwrap();
    for threads in [1, 2, 4] {
        let seen = Mutex::new(Vec::new());
        let (complex, stats) =
            operation.run(threads, &|p| seen.lock().unwrap().push(p), &Cancel::new()).unwrap();
        assert_eq!(complex, quiet.0, "{threads} threads");
        let seen = seen.into_inner().unwrap();
        assert!(seen.is_sorted_by(|a, b| a.fraction <= b.fraction), "{seen:?}");
        assert_eq!((seen[0].fraction, seen[seen.len() - 1].fraction), (0.0, 1.0));
        let mut stages: Vec<&str> = seen.iter().map(|p| p.stage).collect();
        stages.dedup();
        assert_eq!(stages, Vec::from_iter(stats.stages.iter().map(|s| s.0)), "{threads} threads");
        // Each begins where the shares of those before it end.
        let begins: Vec<f64> =
            stages.iter().map(|s| seen.iter().find(|p| p.stage == *s).unwrap().fraction).collect();
        assert!(begins.is_sorted_by(|a, b| a < b), "{begins:?}");
    }
}

#[test]
fn reports_rise_from_0_to_1_through_all_stages() {
    check_reports(&boxes());
    check_reports(&needles());
}

/// Stops at the first report, at the second, and so on until the operation is done before that.
#[track_caller]
fn check_stops(operation: &impl Operation, threads: usize) {
    for stop in 0.. {
        let (cancel, seen) = (Cancel::new(), Mutex::new(0));
        let report = |_: Progress| {
            let mut seen = seen.lock().unwrap();
            if *seen == stop {
                cancel.request();
            }
            *seen += 1;
        };
        let done = operation.run(threads, &report, &cancel);
        let after = seen.into_inner().unwrap().max(stop) - stop;
        match done {
            Err(error) => assert_eq!(error, ArrangementError::Cancelled),
            // The last report says that everything is done.
            Ok(_) => return assert!(after <= 1, "{after} reports after the request"),
        }
        // One of the request, then each thread may end its chunk.
        assert!(after <= 1 + threads, "{after} reports after the request");
    }
}

#[test]
fn stopped_at_any_report() {
    for threads in [1, 3] {
        check_stops(&boxes(), threads);
        check_stops(&needles(), threads);
    }
}

/// The boxes of all facets meet: 4.5 million pairs, from which no stage after the broad phase is to be begun.
#[test]
fn stopped_by_another_thread_in_the_broad_phase() {
    let mut random = Random(7);
    let mut all = common::surface(&[], &[]);
    for _ in 0..3000 {
        let at = [0, 1, 2].map(|_| random.between(0.0, 1.0));
        let first = all.points.len() as u32;
        for p in [at, at.map(|x| x - 2.0), [at[0] - 2.0, at[1] - 2.0, at[2]]] {
            all.points.push(&p);
        }
        all.push_face([&[first, first + 1, first + 2][..]], 1);
    }
    let cancel = Cancel::new();
    let (begun, is_begun) = mpsc::channel();
    let last = Mutex::new("");
    let report = |progress: Progress| {
        *last.lock().unwrap() = progress.stage;
        if progress.stage == "pairs" {
            begun.send(()).unwrap();
            while !cancel.is_requested() {
                std::thread::yield_now();
            }
        }
    };
    let done = std::thread::scope(|scope| {
        let work = scope.spawn(|| vec![all].run(2, &report, &cancel));
        is_begun.recv().unwrap();
        cancel.request();
        work.join().unwrap()
    });
    assert_eq!(done.unwrap_err(), ArrangementError::Cancelled);
    assert_eq!(*last.lock().unwrap(), "pairs");
}

#[test]
fn a_request_made_before_stops_at_once() {
    let cancel = Cancel::new();
    cancel.request();
    let reports = Mutex::new(0);
    let report = |_: Progress| *reports.lock().unwrap() += 1;
    assert_eq!(boxes().run(1, &report, &cancel).unwrap_err().to_string(), "cancelled");
    assert_eq!(needles().run(1, &report, &cancel).unwrap_err(), ArrangementError::Cancelled);
    assert_eq!(*reports.lock().unwrap(), 2);
}

/// The union of all solids: its surface, under the eyes of a report and a request to stop.
fn union(a: &Arrangement, report: Report, cancel: &Cancel) -> Result<ChainComplex, BooleanError> {
    let evaluator = Evaluator::new().progress(report).cancel(cancel);
    let solid = evaluator.solid(a, &Expression::union_of(a.n_solids()))?;
    Ok(evaluator.surface(&solid)?.complex)
}

/// Faces enough for several chunks of each stage.
fn sphere() -> Arrangement {
    let sphere = Surface::from_triangles("sphere", &lar_core::icosphere(5));
    Arranger::new().arrange(&[sphere, cuboid([-0.5; 3], [2.0; 3])]).unwrap()
}

#[test]
fn booleans_report_their_stages() {
    let a = sphere();
    let seen = Mutex::new(Vec::new());
    let complex = union(&a, &|p| seen.lock().unwrap().push(p), &Cancel::new()).unwrap();
    let quiet = a.boolean(&Expression::union_of(2), FillRule::NonZero).unwrap();
    assert_eq!(complex, quiet.to_complex(Detail::Simplified).complex);
    let seen = seen.into_inner().unwrap();
    let mut stages: Vec<&str> = seen.iter().map(|p| p.stage).collect();
    stages.dedup();
    assert_eq!(stages, ["cells", "surface", "coplanar faces", "straight edges", "loops", "complex"]);
    let (of_cells, of_surface) = seen.split_at(seen.iter().position(|p| p.stage == "surface").unwrap());
    for part in [of_cells, of_surface] {
        assert!(part.is_sorted_by(|a, b| a.fraction <= b.fraction), "{part:?}");
        assert_eq!((part[0].fraction, part[part.len() - 1].fraction), (0.0, 1.0));
    }
    let chunks = seen.iter().filter(|p| p.stage == "coplanar faces").count();
    assert!(chunks > 4, "{chunks} reports of one stage");
}

#[test]
fn booleans_stop_at_any_report() {
    let a = sphere();
    for stop in 0.. {
        let (cancel, seen) = (Cancel::new(), Mutex::new(0));
        let report = |_: Progress| {
            let mut seen = seen.lock().unwrap();
            if *seen == stop {
                cancel.request();
            }
            *seen += 1;
        };
        let done = union(&a, &report, &cancel);
        let n_seen = seen.into_inner().unwrap();
        match done {
            Err(error) => assert_eq!((error, n_seen), (BooleanError::Cancelled, stop + 1)),
            Ok(_) => return assert!(n_seen <= stop + 1 && stop > 12, "{n_seen} reports, stopped at {stop}"),
        }
    }
}
