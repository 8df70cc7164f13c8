//! What an arrangement cost, as a table and for reports.

use lar_arrangement::Stats;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::time::Duration;

/// How much work there was.
#[derive(Debug, Serialize)]
pub(crate) struct Counters {
    /// Facets on the grid.
    facets: u64,
    /// Faces that were triangulated because they are not planar.
    triangulated_faces: u64,
    /// Faces without an inside, left out.
    degenerate_faces: u64,
    /// Pairs of facets whose boxes meet.
    pairs_tested: u64,
    /// Pairs with a point in common beyond shared corners.
    pairs_crossing: u64,
    /// Groups of overlapping coplanar facets.
    coplanar_groups: u64,
    /// Predicates that the filters left to exact integers.
    exact_fallbacks: u64,
}

impl Counters {
    pub(crate) fn of(stats: &Stats) -> Self {
        Self {
            facets: stats.facets,
            triangulated_faces: stats.triangulated_polygons,
            degenerate_faces: stats.degenerate_faces,
            pairs_tested: stats.pairs_tested,
            pairs_crossing: stats.pairs_crossing,
            coplanar_groups: stats.coplanar_groups,
            exact_fallbacks: stats.exact_fallbacks,
        }
    }

    fn rows(&self) -> [(&'static str, u64); 7] {
        [
            ("facets", self.facets),
            ("triangulated faces", self.triangulated_faces),
            ("degenerate faces", self.degenerate_faces),
            ("pairs of facets tested", self.pairs_tested),
            ("pairs that cross", self.pairs_crossing),
            ("coplanar groups", self.coplanar_groups),
            ("exact fallbacks", self.exact_fallbacks),
        ]
    }
}

/// The table of `--stats`: stages with their shares, counters, bytes.
pub(crate) struct Table<'a> {
    pub(crate) stages: &'a [(&'static str, Duration)],
    pub(crate) counters: &'a Counters,
    pub(crate) peak_memory: Option<u64>,
}

impl Display for Table<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let total: Duration = self.stages.iter().map(|s| s.1).sum();
        let row = |f: &mut Formatter<'_>, name: &str, time: Duration| {
            let seconds = time.as_secs_f64();
            let share = 100.0 * seconds / total.as_secs_f64().max(f64::MIN_POSITIVE);
            writeln!(f, "{name:<24}{seconds:>14.6} s {share:>4.0} %")
        };
        self.stages.iter().try_for_each(|&(name, time)| row(f, name, time))?;
        row(f, "all stages", total)?;
        let memory = self.peak_memory.map(|bytes| ("bytes at the peak", bytes));
        let mut counts = self.counters.rows().into_iter().chain(memory);
        counts.try_for_each(|(name, count)| writeln!(f, "{name:<24}{count:>14}"))
    }
}

/// The most memory that the process has held so far, in bytes, where the system tells (Linux).
pub(crate) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024 * kilobytes.trim().strip_suffix(" kB")?.parse::<u64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table() {
        let stats = lar_arrangement::arrange(&[]).expect("nothing to arrange").stats().clone();
        let stages = [("soup", Duration::from_millis(1)), ("pairs", Duration::from_millis(3))];
        let counters = Counters { pairs_tested: 298, ..Counters::of(&stats) };
        let table = Table { stages: &stages, counters: &counters, peak_memory: Some(4096) };
        let expected = "\
            soup                          0.001000 s   25 %\n\
            pairs                         0.003000 s   75 %\n\
            all stages                    0.004000 s  100 %\n\
            facets                               0\n\
            triangulated faces                   0\n\
            degenerate faces                     0\n\
            pairs of facets tested             298\n\
            pairs that cross                     0\n\
            coplanar groups                      0\n\
            exact fallbacks                      0\n\
            bytes at the peak                 4096\n";
        assert_eq!(table.to_string(), expected);
    }
}
