//! Time and memory of one operation, for the programs that compare libraries.

use cpu_time::ProcessTime;
use std::error::Error;
use std::fs;
use std::time::{Duration, Instant};

/// What the runs of an operation took.
pub struct Cost {
    /// Medians, without the first run, in memory touched for the first time, when there are several.
    pub cpu: f64,
    pub wall: f64,
    /// Bytes that the first run added to the process at its peak.
    pub memory: u64,
}

/// Runs the operation once, and again until `time` has passed; what the last run returns.
pub fn measure<T>(
    time: Duration,
    mut operation: impl FnMut() -> Result<T, Box<dyn Error>>,
) -> Result<(T, Cost), Box<dyn Error>> {
    // Sets the peak back to what is in use now (proc(5)).
    fs::write("/proc/self/clear_refs", "5")?;
    let before = kilobytes("VmRSS:")?;
    let (mut cpu, mut wall, mut memory) = (Vec::new(), Vec::new(), None);
    let start = Instant::now();
    loop {
        let (since, cpu_since) = (Instant::now(), ProcessTime::now());
        let result = operation()?;
        cpu.push(cpu_since.elapsed().as_secs_f64());
        wall.push(since.elapsed().as_secs_f64());
        let memory = *memory.get_or_insert(1024 * (kilobytes("VmHWM:")? - before));
        if time <= start.elapsed() {
            return Ok((result, Cost { cpu: median(cpu), wall: median(wall), memory }));
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    if values.len() > 1 {
        values.remove(0);
    }
    values.sort_by(f64::total_cmp);
    let n = values.len();
    f64::midpoint(values[(n - 1) / 2], values[n / 2])
}

fn kilobytes(field: &str) -> Result<u64, Box<dyn Error>> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(field)).ok_or("no such field")?;
    Ok(line.trim().trim_end_matches(" kB").parse()?)
}
