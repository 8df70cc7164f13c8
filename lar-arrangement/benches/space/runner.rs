//! Measures one operation on one workload in a process of its own and prints a line of JSON; writes workloads as files.

use crate::operation::{Job, Operation, Outcome};
use crate::workloads::{WORKLOADS, Workload};
use cpu_time::ProcessTime;
use lar_arrangement::Stats;
use lar_core::{TriangleMesh, write_mesh};
use serde_json::{Value, json};
use std::error::Error;
use std::fs;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// What the command line asks for.
pub(crate) struct Request {
    pub(crate) workload: &'static Workload,
    operation: Operation,
    threads: NonZeroUsize,
    repeat: usize,
    seconds: f64,
    write: Option<(PathBuf, Format)>,
}

#[derive(Clone, Copy)]
enum Format {
    /// Points and triangles as numbers, least significant byte first: 64 bits a coordinate, 32 bits a vertex.
    Arrays,
    Obj,
    Stl,
}

impl Request {
    /// The request that the arguments make, if any: `--json WORKLOAD`, and what may go with it.
    pub(crate) fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Option<Self>> {
        let (mut workload, mut operation, mut directory) = (None, Operation::Cells, None);
        let (mut threads, mut format) = (NonZeroUsize::MIN, Format::Arrays);
        let (mut repeat, mut seconds) = (1, f64::INFINITY);
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or_else(|| format!("{argument} needs a value"));
            match argument.as_str() {
                "--json" => workload = Some(named(&value()?)?),
                "--boolean" => operation = Operation::Boolean,
                "--threads" => threads = value()?.parse()?,
                "--repeat" => repeat = value()?.parse::<NonZeroUsize>()?.get(),
                "--seconds" => seconds = value()?.parse()?,
                "--write" => directory = Some(PathBuf::from(value()?)),
                "--format" => format = Format::named(&value()?)?,
                // For criterion, or from cargo.
                _ => {}
            }
        }
        let write = directory.map(|d| (d, format));
        Ok(workload.map(|workload| Self { workload, operation, threads, repeat, seconds, write }))
    }

    /// Writes the operands when a directory is given, measures otherwise.
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<()> {
        match &self.write {
            Some((directory, format)) => write(self.workload, &directory.join(self.workload.name), *format),
            None => Ok(writeln!(out, "{}", self.measure()?)?),
        }
    }

    /// Times are medians, without the first run, in memory touched for the first time, when there are several; memory is what
    /// that run adds to the process at its peak.
    fn measure(&self) -> Result<Value> {
        let job = Job::new(self.workload, self.threads);
        let (mut cpu, mut wall, mut stats) = (Vec::new(), Vec::new(), Vec::new());
        // The program is in memory before anything is measured, and its threads are started: they are kept.
        drop(Job::new(named("three-cubes")?, self.threads).run(self.operation)?);
        let before = memory("VmRSS:");
        reset_peak()?;
        let mut memory_used = None;
        let mut last = None;
        let start = Instant::now();
        while cpu.len() < self.repeat && (cpu.is_empty() || start.elapsed().as_secs_f64() < self.seconds) {
            drop(last.take());
            let (since, cpu_since) = (Instant::now(), ProcessTime::now());
            let outcome = job.run(self.operation)?;
            cpu.push(cpu_since.elapsed().as_secs_f64());
            wall.push(since.elapsed().as_secs_f64());
            memory_used = memory_used.or_else(|| Some(memory("VmHWM:")? - before?));
            stats.push(outcome.stats().clone());
            last = Some(outcome);
        }
        let outcome: Outcome = last.ok_or("no repetition")?;
        Ok(json!({
            "workload": self.workload.name,
            "operation": self.operation.name(),
            "threads": self.threads,
            "facets": job.n_facets(),
            "cpu": median(&cpu),
            "wall": median(&wall),
            "cpu_least": cpu.iter().copied().fold(f64::INFINITY, f64::min),
            "repeat": cpu.len(),
            "memory": memory_used,
            "counts": outcome.counts(),
            "area": outcome.area(),
            "volume": outcome.volume(),
            "stages": stages(&stats),
            "pairs_tested": outcome.stats().pairs_tested,
            "pairs_crossing": outcome.stats().pairs_crossing,
            "coplanar_groups": outcome.stats().coplanar_groups,
            "exact_fallbacks": outcome.stats().exact_fallbacks,
        }))
    }
}

fn named(name: &str) -> Result<&'static Workload> {
    let names = || WORKLOADS.iter().map(|w| w.name).collect::<Vec<_>>().join(" ");
    Workload::named(name).ok_or_else(|| format!("no workload {name}; there are {}", names()).into())
}

impl Format {
    fn named(name: &str) -> Result<Self> {
        match name {
            "arrays" => Ok(Self::Arrays),
            "obj" => Ok(Self::Obj),
            "stl" => Ok(Self::Stl),
            _ => Err(format!("no format {name}; there are arrays obj stl").into()),
        }
    }
}

fn write(workload: &Workload, directory: &Path, format: Format) -> Result<()> {
    fs::create_dir_all(directory)?;
    for (i, mesh) in workload.meshes().iter().enumerate() {
        let path = directory.join(format!("{i:06}"));
        match format {
            Format::Arrays => write_arrays(mesh, &path)?,
            Format::Obj => write_mesh(path.with_extension("obj"), mesh)?,
            Format::Stl => write_mesh(path.with_extension("stl"), mesh)?,
        }
    }
    Ok(())
}

fn write_arrays(mesh: &TriangleMesh, path: &Path) -> Result<()> {
    let points: Vec<u8> = mesh.points.coords().iter().flat_map(|x| x.to_le_bytes()).collect();
    let triangles: Vec<u8> = mesh.triangles.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
    fs::write(path.with_extension("points"), points)?;
    Ok(fs::write(path.with_extension("triangles"), triangles)?)
}

/// Median seconds of each stage, in their order.
fn stages(runs: &[Stats]) -> Value {
    let one = |i: usize| runs.iter().map(|s| s.stages[i].1.as_secs_f64()).collect::<Vec<_>>();
    let names = runs.first().map_or(&[][..], |s| &s.stages);
    names.iter().enumerate().map(|(i, (name, _))| json!([name, median(&one(i))])).collect()
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values[usize::from(values.len() > 1)..].to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    f64::midpoint(sorted[(n - 1) / 2], sorted[n / 2])
}

/// Sets the peak back to what is in use now (proc(5)); elsewhere than on Linux there is none.
fn reset_peak() -> Result<()> {
    if cfg!(target_os = "linux") {
        fs::write("/proc/self/clear_refs", "5")?;
    }
    Ok(())
}

/// Bytes, from a field of the process status.
fn memory(field: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(field))?;
    Some(1024 * line.trim().strip_suffix(" kB")?.parse::<u64>().ok()?)
}
