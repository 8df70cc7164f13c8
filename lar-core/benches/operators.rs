//! Boundary operators, products, incidence queries, Betti numbers, integrals, on grids of n³ cubes and on
//! triangulated spheres.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lar_core::{Cells, ChainComplex, Graph, Surface, cuboid_grid, icosphere, shared_vertices};
use std::hint::black_box;

fn grid(n: usize) -> ChainComplex {
    ChainComplex::from_model(&cuboid_grid(&[n; 3])).expect("grids are well-formed")
}

fn sphere(level: u32) -> ChainComplex {
    let surface = Surface::from_triangles("sphere", &icosphere(level));
    ChainComplex::from_surface(&surface).expect("spheres are well-formed")
}

fn boundary(c: &mut Criterion) {
    let mut group = c.benchmark_group("boundary");
    group.sample_size(10);
    for n in [10, 20, 40] {
        let model = cuboid_grid(&[n; 3]);
        group.bench_with_input(BenchmarkId::new("unsigned_3", n), &model, |b, model| {
            b.iter(|| model.unsigned_boundary(3));
        });
        group.bench_with_input(BenchmarkId::new("complex", n), &model, |b, model| {
            b.iter(|| ChainComplex::from_model(model));
        });
        let complex = grid(n);
        group.bench_with_input(BenchmarkId::new("with_exterior", n), &complex, |b, complex| {
            b.iter(|| complex.with_exterior());
        });
    }
    group.finish();
}

fn products(c: &mut Criterion) {
    let mut group = c.benchmark_group("products");
    group.sample_size(10);
    for n in [10, 20, 40] {
        let complex = grid(n);
        group.bench_with_input(BenchmarkId::new("boundary_of_boundary", n), &complex, |b, complex| {
            b.iter(|| black_box(complex.boundary(2) * complex.boundary(3)));
        });
        let model = cuboid_grid(&[n; 3]);
        group.bench_with_input(BenchmarkId::new("shared_vertices", n), &model, |b, model| {
            b.iter(|| shared_vertices(model.cells(3), model.cells(2), model.points().len()));
        });
    }
    group.finish();
}

fn incidence(c: &mut Criterion) {
    let mut group = c.benchmark_group("incidence");
    group.sample_size(10);
    let complex = grid(40);
    let incidence = complex.incidence();
    group.bench_function("both_directions", |b| b.iter(|| complex.incidence()));
    for (name, p, q) in [("VV", 0, 0), ("CV", 3, 0), ("EC", 1, 3), ("FF", 2, 2)] {
        group.bench_function(name, |b| b.iter(|| incidence.relation(p, q)));
    }
    group.bench_function("one_query", |b| b.iter(|| incidence.related(3, 0, black_box(31_000))));
    let queries: Cells = (0..1000).map(|i| [64 * i]).collect();
    group.bench_function("batch_of_1000", |b| b.iter(|| incidence.batch(3, 3, &queries)));
    group.finish();
}

fn topology(c: &mut Criterion) {
    let mut group = c.benchmark_group("topology");
    group.sample_size(10);
    for n in [10, 20, 40] {
        let complex = grid(n);
        group.bench_with_input(BenchmarkId::new("betti_grid", n), &complex, |b, complex| {
            b.iter(|| complex.betti_numbers());
        });
    }
    for level in [4, 5, 6, 7] {
        let complex = sphere(level);
        group.bench_with_input(BenchmarkId::new("betti_sphere", level), &complex, |b, complex| {
            b.iter(|| complex.betti_numbers());
        });
    }
    let graph = Graph::of_complex(&grid(40)).expect("edges of a grid have two ends");
    group.bench_function("biconnected", |b| b.iter(|| graph.biconnected_components()));
    group.finish();
}

fn integration(c: &mut Criterion) {
    let mut group = c.benchmark_group("integration");
    group.sample_size(10);
    let complex = grid(20);
    group.bench_function("mass_properties_of_8000_cells", |b| b.iter(|| complex.mass_properties(3)));
    let mesh = icosphere(6);
    group.bench_function("mass_properties_of_82000_triangles", |b| b.iter(|| mesh.solid_mass_properties()));
    let small = icosphere(3);
    for degree in [0, 2, 8, 30] {
        group.bench_with_input(BenchmarkId::new("1280_triangles_degree", degree), &degree, |b, &degree| {
            b.iter(|| small.volume_integral([degree, 0, 0]));
        });
    }
    group.finish();
}

criterion_group!(benches, boundary, products, incidence, topology, integration);
criterion_main!(benches);
