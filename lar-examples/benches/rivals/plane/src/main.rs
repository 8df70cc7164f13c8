//! Arranges the segments of a file with one of some libraries and prints what that took and what came out:
//! `plane ENGINE FILE`. `plane write DIRECTORY` writes the workloads.

mod engines;
#[path = "../../../../../lar-arrangement/benches/planar/workloads.rs"]
mod workloads;

use cpu_time::ProcessTime;
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["write", directory] => write(Path::new(directory)),
        [engine, file] => measure(engine, &read(file)?),
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
fn measure(engine: &str, segments: &[[f64; 4]]) -> Result<(), Box<dyn Error>> {
    let engine = engines::named(engine).ok_or("no such engine")?;
    // Sets the peak back to what is in use now (proc(5)).
    fs::write("/proc/self/clear_refs", "5")?;
    let before = kilobytes("VmRSS:")?;
    let (wall, cpu) = (Instant::now(), ProcessTime::now());
    let count = engine(segments)?;
    let (cpu, wall) = (cpu.elapsed(), wall.elapsed());
    let memory = kilobytes("VmHWM:")? - before;
    let [v, e, f, c] = count().map(|n| n.map_or("null".to_owned(), |n| n.to_string()));
    println!(
        r#"{{"cpu": {}, "wall": {}, "memory": {}, "counts": [{v}, {e}, {f}, {c}]}}"#,
        cpu.as_secs_f64(),
        wall.as_secs_f64(),
        1024 * memory
    );
    Ok(())
}

fn kilobytes(field: &str) -> Result<u64, Box<dyn Error>> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(field)).ok_or("no such field")?;
    Ok(line.trim().trim_end_matches(" kB").parse()?)
}
