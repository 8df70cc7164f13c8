//! Times of planar arrangements on one thread and on two, per segment. `cargo bench -p lar-arrangement`, or with the
//! names of workloads. lar-examples/benches/rivals compares them with other libraries on the same workloads.

mod workloads;

use criterion::{BenchmarkId, Criterion, Throughput};
use lar_arrangement::planar::{Dangling, Drawing, PlanarArranger};
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Duration;

fn main() {
    let mut criterion = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2))
        .configure_from_args();
    let mut group = criterion.benchmark_group("planar");
    for (name, segments) in workloads::WORKLOADS {
        let drawing = Drawing::from_segments(&segments());
        group.throughput(Throughput::Elements(drawing.n_segments() as u64));
        for threads in [1, 2] {
            let threads = NonZeroUsize::new(threads).expect("one or two");
            let arranger = PlanarArranger::new().threads(threads).dangling(Dangling::Keep);
            group.bench_function(BenchmarkId::new(name, threads), |b| {
                b.iter(|| arranger.arrange(black_box(&drawing)));
            });
        }
    }
    group.finish();
    criterion.final_summary();
}
