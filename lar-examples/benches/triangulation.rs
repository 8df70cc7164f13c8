//! Times of triangulation: all faces of complexes, one large face, points. `cargo bench -p lar-examples --bench triangulation`

use criterion::{Criterion, Throughput};
use lar_arrangement::arrange;
use lar_arrangement::planar::{Drawing, PlanarArranger};
use lar_core::{ChainComplex, Points, cuboid_grid};
use lar_examples::scenes;
use lar_triangle::{delaunay, triangulate, triangulate_cells, triangulate_face};
use std::f64::consts::TAU;
use std::hint::black_box;

const FACES: &str = "the faces are polygons";

fn main() {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    spatial(&mut criterion, "100 random cubes", &random_cubes());
    spatial(&mut criterion, "grid of 64,000 cubes", &grid());
    planar(&mut criterion);
    large_face(&mut criterion);
    points(&mut criterion);
    criterion.final_summary();
}

fn random_cubes() -> ChainComplex {
    let surfaces = scenes::surfaces(&scenes::random_cubes(100, 1)).expect("the scene is well formed");
    arrange(&surfaces).expect("cubes can be arranged").complex().clone()
}

fn grid() -> ChainComplex {
    ChainComplex::from_model(&cuboid_grid(&[40, 40, 40])).expect("a grid is a complex")
}

/// Faces a second, and all cells with their triangles.
fn spatial(criterion: &mut Criterion, name: &str, complex: &ChainComplex) {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(complex.n_cells(2) as u64));
    group.bench_function("faces", |b| b.iter(|| triangulate(black_box(complex)).expect(FACES)));
    group.bench_function("cells", |b| b.iter(|| triangulate_cells(black_box(complex)).expect(FACES)));
    group.finish();
}

/// The faces between 1000 segments.
fn planar(criterion: &mut Criterion) {
    let segments: Vec<[f64; 4]> = evenly_spread([2.0, 3.0, 5.0, 7.0].map(f64::sqrt)).take(1000).collect();
    let arrangement = PlanarArranger::new().arrange(&Drawing::from_segments(&segments));
    let arrangement = arrangement.expect("segments can be arranged");
    let complex = arrangement.complex();
    let mut group = criterion.benchmark_group("faces between 1000 segments");
    group.throughput(Throughput::Elements(complex.n_cells(2) as u64));
    group.bench_function("faces", |b| b.iter(|| triangulate(black_box(complex)).expect(FACES)));
    group.finish();
}

/// A star of 10^5 corners with 100 holes of 100 corners.
fn large_face(criterion: &mut Criterion) {
    let mut coords: Vec<f64> = Vec::new();
    let mut loops: Vec<Vec<u32>> = Vec::new();
    let mut star = |n: usize, [x, y]: [f64; 2], radius: f64, turn: f64| {
        let first = (coords.len() / 2) as u32;
        for i in 0..n {
            let (sin, cos) = (turn * TAU * i as f64 / n as f64).sin_cos();
            let r = if i % 2 == 0 { radius } else { 0.9 * radius };
            coords.extend([x + r * cos, y + r * sin]);
        }
        loops.push((first..first + n as u32).collect());
    };
    star(100_000, [0.0; 2], 10.0, 1.0);
    for hole in 0..100 {
        let (column, row) = (f64::from(hole % 10), f64::from(hole / 10));
        star(100, [column - 4.5, row - 4.5], 0.4, -1.0);
    }
    let points = Points::from_columns(2, coords);
    let loops: Vec<&[u32]> = loops.iter().map(Vec::as_slice).collect();
    let mut group = criterion.benchmark_group("one face with 100 holes");
    group.throughput(Throughput::Elements(points.len() as u64));
    group
        .bench_function("corners", |b| b.iter(|| triangulate_face(black_box(&points), &loops).expect(FACES)));
    group.finish();
}

fn points(criterion: &mut Criterion) {
    let spread = evenly_spread([2.0, 3.0].map(f64::sqrt)).take(100_000);
    let points = Points::from_columns(2, spread.flatten().collect());
    let mut group = criterion.benchmark_group("Delaunay triangulation");
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("points", |b| b.iter(|| delaunay(black_box(&points)).expect("points of the plane")));
    group.finish();
}

/// Points spread evenly over a unit cube: multiples of numbers that have no ratio, modulo 1.
fn evenly_spread<const N: usize>(steps: [f64; N]) -> impl Iterator<Item = [f64; N]> {
    (1..).map(move |i| steps.map(|step| (f64::from(i) * step).fract()))
}
