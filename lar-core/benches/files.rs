//! Reading and writing of surface files, in bytes a second: a ball of 81 920 triangles. Reading of 10^5 segments.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lar_core::{MeshFormat, PolygonMesh, icosphere, parse_segments, parse_surface};
use std::hint::black_box;

const FORMATS: [(MeshFormat, &str); 6] = [
    (MeshFormat::Obj, "ball.obj"),
    (MeshFormat::StlBinary, "ball.stl"),
    (MeshFormat::StlText, "ball_text.stl"),
    (MeshFormat::PlyLittleEndian, "ball.ply"),
    (MeshFormat::PlyText, "ball_text.ply"),
    (MeshFormat::Off, "ball.off"),
];

fn files(c: &mut Criterion) {
    let ball = icosphere(6);
    for (format, name) in FORMATS {
        let bytes = ball.to_bytes(format).expect("a ball can be written");
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Bytes(bytes.len() as u64)).sample_size(10);
        group.bench_function("read", |b| b.iter(|| parse_surface(black_box(&bytes), name)));
        group.bench_function("write", |b| b.iter(|| black_box(&ball).to_bytes(format)));
        group.finish();
    }
}

fn segments(c: &mut Criterion) {
    let line =
        |k: u32| format!("{} {} {} {}\n", f64::from(k).sqrt(), f64::from(k).ln_1p(), 0.1 * f64::from(k), k);
    let text: String = (0..100_000).map(line).collect();
    let mut group = c.benchmark_group("segments");
    group.throughput(Throughput::Bytes(text.len() as u64)).sample_size(10);
    group.bench_function("read", |b| b.iter(|| parse_segments(black_box(text.as_bytes()), "a.seg")));
    group.finish();
}

criterion_group!(benches, files, segments);
criterion_main!(benches);
