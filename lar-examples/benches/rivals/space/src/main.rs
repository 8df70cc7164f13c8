//! The Boolean of the solids of a directory with one of some libraries; prints what that took and what came out:
//! `space ENGINE union|difference SECONDS DIRECTORY`.

mod engines;
#[path = "../../common/measure.rs"]
mod measure;

use engines::Mesh;
use measure::{Cost, measure};
use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::Duration;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [engine, operation, seconds, directory] = &arguments[..] else {
        return Err("usage: space ENGINE union|difference SECONDS DIRECTORY".into());
    };
    let engine = engines::named(engine).ok_or("no such engine")?;
    let meshes = read(Path::new(directory))?;
    let time = Duration::from_secs_f64(seconds.parse()?);
    let (mesh, Cost { cpu, wall, memory }) = measure(time, || engine(&meshes, operation == "union"))?;
    let (area, volume) = (mesh.area(), mesh.volume());
    let n_triangles = mesh.triangles.len();
    println!(
        r#"{{"cpu": {cpu}, "wall": {wall}, "memory": {memory}, "counts": [1], "triangles": {n_triangles}, "area": {area}, "volume": {volume}}}"#
    );
    Ok(())
}

/// The operands in the order of their names: coordinates in 64 bits, vertices of triangles in 32.
fn read(directory: &Path) -> Result<Vec<Mesh>, Box<dyn Error>> {
    let entries = fs::read_dir(directory)?.collect::<Result<Vec<_>, _>>()?;
    let mut paths: Vec<_> = entries.into_iter().map(|e| e.path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "points"));
    paths.sort();
    let mesh = |points: &std::path::PathBuf| -> Result<Mesh, Box<dyn Error>> {
        let coordinates = fs::read(points)?;
        let vertices = fs::read(points.with_extension("triangles"))?;
        let coordinates = coordinates.chunks_exact(8).map(|b| Ok(f64::from_le_bytes(b.try_into()?)));
        let vertices = vertices.chunks_exact(4).map(|b| Ok(u32::from_le_bytes(b.try_into()?) as usize));
        let vertices = vertices.collect::<Result<Vec<_>, Box<dyn Error>>>()?;
        Ok(Mesh {
            points: coordinates.collect::<Result<_, Box<dyn Error>>>()?,
            triangles: vertices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        })
    };
    paths.iter().map(mesh).collect()
}
