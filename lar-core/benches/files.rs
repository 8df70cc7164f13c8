//! Reading and writing of surface files, in bytes a second: a ball of 81 920 triangles, as written here and as others
//! export it. Reading of 10^5 segments.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lar_core::{MeshFormat, PolygonMesh, TriangleMesh, icosphere, parse_segments, parse_surface};
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
    for (text, name) in [(exported_obj(&ball), "exported.obj"), (exported_stl(&ball), "exported_text.stl")] {
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Bytes(text.len() as u64)).sample_size(10);
        group.bench_function("read", |b| b.iter(|| parse_surface(black_box(text.as_bytes()), name)));
        group.finish();
    }
}

/// Six decimals, texture coordinates and normals, lines that end as on Windows.
fn exported_obj(ball: &TriangleMesh) -> String {
    let points = ball.points.coords().chunks_exact(3);
    let vertices = points.clone().map(|p| format!("v {:.6} {:.6} {:.6}\r\n", p[0], p[1], p[2]));
    let textures = points.clone().map(|p| format!("vt {:.4} {:.4}\r\n", p[0], p[1]));
    let normals = points.map(|p| format!("vn {:.4} {:.4} {:.4}\r\n", p[0], p[1], p[2]));
    let face = |[a, b, c]: [u32; 3]| format!("f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\r\n");
    let faces = ball.triangles.iter().map(|t| face([t[0] + 1, t[1] + 1, t[2] + 1]));
    vertices.chain(textures).chain(normals).chain(faces).collect()
}

/// Seven digits with an exponent of two, indented.
fn exported_stl(ball: &TriangleMesh) -> String {
    let number = |x: f64| {
        let text = format!("{x:.6e}");
        let (mantissa, exponent) = text.split_once('e').expect("an exponent");
        let exponent: i32 = exponent.parse().expect("a number");
        format!(" {mantissa}e{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs())
    };
    let vector = |p: &[f64]| p.iter().copied().map(number).collect::<String>();
    let vertex = |&v: &u32| format!("      vertex{}\n", vector(ball.points.point(v as usize)));
    let facet = |triangle: &[u32; 3]| {
        let corners: String = triangle.iter().map(vertex).collect();
        let normal = vector(ball.points.point(triangle[0] as usize));
        format!("  facet normal{normal}\n    outer loop\n{corners}    endloop\n  endfacet\n")
    };
    format!("solid ball\n{}endsolid ball\n", ball.triangles.iter().map(facet).collect::<String>())
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
