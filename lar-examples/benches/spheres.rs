//! Times of whole operations: the union of two spheres (arrangement, Boolean, its simplified surface), and
//! arrangements of three and of many cubes. `cargo bench -p lar-examples`

use criterion::{BenchmarkId, Criterion, Throughput};
use lar_arrangement::{Detail, Expression, FillRule, arrange};
use lar_core::Surface;
use lar_examples::scenes;
use std::hint::black_box;

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    spheres(&mut criterion);
    cubes(&mut criterion);
    criterion.final_summary();
}

fn spheres(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("union of two spheres");
    let union = Expression::union_of(2);
    for level in [5, 6] {
        let spheres = scenes::two_spheres(level, 0.7).expect("the offset is finite");
        let triangles = n_faces(&spheres);
        group.throughput(Throughput::Elements(triangles));
        group.bench_function(BenchmarkId::from_parameter(triangles / 2), |b| {
            b.iter(|| {
                let arrangement = arrange(black_box(&spheres)).expect("spheres are well formed");
                let solid = arrangement.boolean(&union, FillRule::NonZero).expect("spheres are closed");
                solid.to_complex(Detail::Simplified)
            });
        });
    }
    group.finish();
}

fn cubes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("arrangement of cubes");
    let scenes = [
        ("three cubes", scenes::three_cubes()),
        ("30 random", scenes::random_cubes(30, 1)),
        ("100 random", scenes::random_cubes(100, 1)),
    ];
    for (name, scene) in scenes {
        let surfaces = scenes::surfaces(&scene).expect("the scene is well formed");
        group.throughput(Throughput::Elements(n_faces(&surfaces)));
        group.bench_function(name, |b| b.iter(|| arrange(black_box(&surfaces))));
    }
    group.finish();
}

fn n_faces(surfaces: &[Surface]) -> u64 {
    surfaces.iter().map(|s| s.n_faces() as u64).sum()
}
