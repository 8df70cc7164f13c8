//! Arranges the segments of a file with one of some libraries and prints what that took and what came out:
//! `plane ENGINE FILE`. `plane write DIRECTORY` writes the workloads.

mod engines;
#[path = "../../common/measure.rs"]
mod measure;
#[path = "../../../../../lar-arrangement/benches/planar/workloads.rs"]
mod workloads;

use measure::{Cost, measure};
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::Duration;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["write", directory] => write(Path::new(directory)),
        [engine, file] => run(engine, &read(file)?),
        _ => Err("usage: plane write DIRECTORY | plane ENGINE FILE".into()),
    }
}

/// One segment a line. `{:?}` writes the shortest decimals that are read back as the same number.
fn write(directory: &Path) -> Result<(), Box<dyn Error>> {
    for (name, segments) in workloads::WORKLOADS {
        let mut text = String::new();
        for [x, y, z, w] in segments() {
            writeln!(text, "{x:?} {y:?} {z:?} {w:?}")?;
        }
        fs::write(directory.join(name).with_extension("seg"), text)?;
        println!("{name}");
    }
    Ok(())
}

fn read(file: &str) -> Result<Vec<[f64; 4]>, Box<dyn Error>> {
    let segment = |line: &str| -> Result<[f64; 4], Box<dyn Error>> {
        let numbers = line.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        Ok(numbers.try_into().map_err(|_| "a line has not four numbers")?)
    };
    fs::read_to_string(file)?.lines().map(segment).collect()
}

/// The time and memory of the operation alone, without the counting after it.
fn run(engine: &str, segments: &[[f64; 4]]) -> Result<(), Box<dyn Error>> {
    let warm_up = engines::warm_up(engine);
    let engine = engines::named(engine).ok_or("no such engine")?;
    // The program itself is in memory before anything is measured, and its threads are started.
    drop(engine(&warm_up)?);
    let (count, Cost { cpu, wall, memory }) = measure(Duration::ZERO, || engine(segments))?;
    let [v, e, f, c] = count().map(|n| n.map_or("null".to_owned(), |n| n.to_string()));
    println!(r#"{{"cpu": {cpu}, "wall": {wall}, "memory": {memory}, "counts": [{v}, {e}, {f}, {c}]}}"#);
    Ok(())
}
