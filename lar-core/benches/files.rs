//! Reading and writing of OBJ and STL, in bytes a second: a ball of 81 920 triangles.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lar_core::{MeshFormat, PolygonMesh, icosphere, parse_surface};
use std::hint::black_box;

const FORMATS: [(MeshFormat, &str); 5] = [
    (MeshFormat::Obj, "ball.obj"),
    (MeshFormat::StlBinary, "ball.stl"),
    (MeshFormat::StlText, "ball_text.stl"),
    (MeshFormat::PlyLittleEndian, "ball.ply"),
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

criterion_group!(benches, files);
criterion_main!(benches);
