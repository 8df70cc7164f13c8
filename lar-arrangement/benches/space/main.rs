//! Times of spatial arrangements and Booleans, whole and by stages: `cargo bench -p lar-arrangement --bench space`.
//!
//! One operation on one workload, measured in a process of its own, as a line of JSON:
//! `cargo bench -p lar-arrangement --bench space -- --json spheres-20k [--boolean] [--threads 2] [--repeat 5] [--seconds 1]`,
//! as often as is said but for no longer than is said. With `--write DIRECTORY [--format arrays|obj|stl]` the operands are
//! written there instead.
//! lar-examples/benches/rivals/space.py compares with other libraries on the same workloads.

mod operation;
mod runner;
mod workloads;

use criterion::{BenchmarkId, Criterion, Throughput};
use operation::{Job, Operation};
use runner::Request;
use std::error::Error;
use std::num::NonZeroUsize;
use std::time::Duration;
use workloads::Workload;

/// As in the command `lar`.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Those that take milliseconds.
const SMALL: [&str; 9] = [
    "three-cubes",
    "cubes-30",
    "cubes-100",
    "spheres-5k",
    "spheres-20k",
    "shifted-128",
    "coplanar-2",
    "turned-welded",
    "holes",
];

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(request) = Request::parse(std::env::args().skip(1))? {
        return request.run(&mut std::io::stdout().lock());
    }
    let mut criterion = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2))
        .configure_from_args();
    for name in SMALL {
        let workload = Workload::named(name).expect("a workload");
        whole(&mut criterion, workload);
        stages(&mut criterion, workload);
    }
    criterion.final_summary();
    Ok(())
}

fn whole(criterion: &mut Criterion, workload: &Workload) {
    for operation in [Operation::Cells, Operation::Boolean] {
        let mut group = criterion.benchmark_group(operation.name());
        for threads in [1, 2] {
            let job = Job::new(workload, NonZeroUsize::new(threads).expect("one or two"));
            group.throughput(Throughput::Elements(job.n_facets()));
            group.bench_function(BenchmarkId::new(workload.name, threads), |b| {
                b.iter(|| job.run(operation).expect("closed solids"));
            });
        }
        group.finish();
    }
}

/// Each stage, as the stop watch of whole runs on one thread has it.
fn stages(criterion: &mut Criterion, workload: &Workload) {
    let job = Job::new(workload, NonZeroUsize::MIN);
    let run = || job.run(Operation::Cells).expect("closed solids");
    let mut group = criterion.benchmark_group("stages");
    group.throughput(Throughput::Elements(job.n_facets()));
    for (i, (stage, _)) in run().stats().stages.iter().enumerate() {
        group.bench_function(BenchmarkId::new(*stage, workload.name), |b| {
            b.iter_custom(|n| (0..n).map(|_| run().stats().stages[i].1).sum());
        });
    }
    group.finish();
}
