//! Grids with all their skeletons, products, simplicial grids, mapped solids, boundaries: time against size.
//!
//! `cargo bench -p lar-core --bench grids`

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use lar_core::mapper::{Ball, Sphere};
use lar_core::{Model, cuboid_grid, grid_1, product, simplex_grid};
use std::hint::black_box;

fn n_cells(model: &Model) -> u64 {
    model.f_vector().iter().map(|&n| n as u64).sum()
}

/// One benchmark for each size, its throughput in cells of the result.
fn sizes(c: &mut Criterion, name: &str, sizes: &[usize], build: impl Fn(usize) -> Model) {
    let mut group = c.benchmark_group(name);
    group.sample_size(10);
    for &n in sizes {
        group.throughput(Throughput::Elements(n_cells(&build(n))));
        group.bench_function(BenchmarkId::from_parameter(n), |b| b.iter(|| build(black_box(n))));
    }
    group.finish();
}

fn grids(c: &mut Criterion) {
    sizes(c, "cuboid_grid n³", &[10, 30, 100], |n| cuboid_grid(&[n; 3]));
    sizes(c, "cuboid_grid n⁴", &[5, 20], |n| cuboid_grid(&[n; 4]));
    sizes(c, "simplex_grid n³", &[10, 40], |n| simplex_grid(&[n; 3]).unwrap());
    sizes(c, "product of n² and n", &[10, 30, 100], |n| {
        product(&cuboid_grid(&[n, n]), &grid_1(n).unwrap()).unwrap()
    });
    sizes(c, "boundary of n³", &[10, 30], |n| cuboid_grid(&[n; 3]).boundary().unwrap());
    sizes(c, "sphere n × 2n", &[18, 180], |n| {
        Sphere { shape: [n, 2 * n], ..Sphere::default() }.model().unwrap()
    });
    sizes(c, "ball n × 2n × n/4", &[16, 64], |n| {
        Ball { shape: [n, 2 * n, n / 4], ..Ball::default() }.model().unwrap()
    });
}

criterion_group!(benches, grids);
criterion_main!(benches);
