//! `lar measure`: mass properties of the cells, of the inputs, and of all together.

use super::input::{Inputs, Operands};
use super::report::{Coplanarity, Json, Moves, Threads, arrange};
use crate::{CommandError, tables};
use lar_arrangement::Arrangement;
use lar_core::{CellId, MassProperties};
use serde::Serialize;
use std::io::Write;
use std::str::FromStr;

/// Mass properties of the cells of the inputs' arrangement, of each input, and of all together.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "A cell of several inputs has the density of the last of them that has one of its own by NAME=D. \
                        Units are those of the files: a length cubed times the density is a mass.\n\n\
                        Examples:\n  \
                        lar measure part.stl --density 7.85e-6\n  \
                        lar measure steel=frame.stl wood=top.stl --density steel=7850 --density wood=600 --json -"
)]
pub(crate) struct Measure {
    #[command(flatten)]
    inputs: Inputs,
    /// Mass of a unit of volume, of all inputs or of the one called NAME.
    #[arg(long, value_name = "D | NAME=D", allow_hyphen_values = true)]
    density: Vec<Density>,
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    coplanarity: Coplanarity,
    #[command(flatten)]
    threads: Threads,
}

/// Of one input, or of all that have none of their own.
#[derive(Clone, Debug)]
struct Density {
    name: Option<String>,
    value: f64,
}

impl FromStr for Density {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (name, number) = match text.split_once('=') {
            Some((name, number)) => (Some(name.to_owned()), number),
            None => (None, text),
        };
        let value = number.parse().ok().filter(|x: &f64| x.is_finite() && 0.0 < *x);
        let value = value.ok_or("a density is a number above 0, or NAME= and a number above 0")?;
        Ok(Self { name, value })
    }
}

#[derive(Debug, Serialize)]
struct Report {
    /// Those inside at least one input.
    cells: Vec<Cell>,
    inputs: Vec<Input>,
    /// All cells together.
    total: Body,
    grid_step: f64,
    moved: Moves,
    threads: usize,
}

#[derive(Debug, Serialize)]
struct Cell {
    cell: u32,
    /// By input: 1 where the winding number is not zero.
    inside: Vec<u8>,
    density: f64,
    #[serde(flatten)]
    body: Body,
}

#[derive(Debug, Serialize)]
struct Input {
    name: String,
    file: String,
    #[serde(flatten)]
    body: Body,
}

/// Mass properties; moments are those of the mass about the centroid.
#[derive(Debug, Serialize)]
struct Body {
    volume: f64,
    mass: f64,
    /// `null` when there is no mass.
    centroid: Option<[f64; 3]>,
    /// Rows of the tensor in the axes of the file.
    inertia: Option<[[f64; 3]; 3]>,
    /// In rising order.
    principal_moments: Option<[f64; 3]>,
    /// Unit vectors in the order of the moments, right-handed.
    principal_axes: Option<[[f64; 3]; 3]>,
}

/// A cell: its number, where it is inside, its density, its volume with moments.
struct Part {
    cell: CellId,
    inside: Vec<u8>,
    density: f64,
    volume: MassProperties,
}

impl Measure {
    pub(crate) fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        self.json.check()?;
        let operands = self.inputs.read()?;
        let densities = self.densities(&operands)?;
        let (arrangement, _) = arrange(&operands.surfaces, self.threads, self.coplanarity)?;
        let parts = parts(&arrangement, &densities)?;
        let of = |solid: usize| Body::of(parts.iter().filter(move |part| part.inside[solid] == 1));
        let files = operands.surfaces.iter().zip(&operands.files).enumerate();
        let report = Report {
            cells: parts.iter().map(Cell::new).collect(),
            inputs: files
                .map(|(solid, (surface, file))| Input {
                    name: surface.name.clone(),
                    file: file.display().to_string(),
                    body: of(solid),
                })
                .collect(),
            total: Body::of(parts.iter()),
            grid_step: arrangement.stats().grid_step,
            moved: Moves::of(arrangement.stats()),
            threads: self.threads.count().get(),
        };
        self.json.deliver("measure", &report, out, |out| print(&report, out))
    }

    /// By input.
    fn densities(&self, operands: &Operands) -> Result<Vec<(bool, f64)>, CommandError> {
        let names = operands.names();
        let unknown = |d: &&Density| d.name.as_ref().is_some_and(|name| !names.contains(&name.as_str()));
        if let Some(Density { name: Some(name), .. }) = self.density.iter().find(unknown) {
            return Err(CommandError::Usage(format!(
                "a density for {name}, but the inputs are {}",
                names.join(", ")
            )));
        }
        let last = |name: Option<&str>| {
            self.density.iter().rev().find(|d| d.name.as_deref() == name).map(|d| d.value)
        };
        let all = last(None).unwrap_or(1.0);
        Ok(names.iter().map(|name| last(Some(name)).map_or((false, all), |own| (true, own))).collect())
    }
}

fn parts(arrangement: &Arrangement, densities: &[(bool, f64)]) -> Result<Vec<Part>, CommandError> {
    let volumes = arrangement.complex().mass_properties(3)?;
    let part = |(cell, volume): (usize, MassProperties)| {
        let inside: Vec<u8> = tables::inside(arrangement, cell).collect();
        let within =
            || densities.iter().zip(&inside).filter(|(_, bit)| **bit == 1).map(|(density, _)| density);
        let own = within().rfind(|(is_own, _)| *is_own);
        let density = own.or_else(|| within().next_back())?.1;
        Some(Part { cell: CellId(cell as u32), inside, density, volume })
    };
    Ok(volumes.into_iter().enumerate().skip(1).filter_map(part).collect())
}

impl Body {
    fn of<'a>(parts: impl Iterator<Item = &'a Part> + Clone) -> Self {
        let mass: MassProperties = parts.clone().map(|part| part.volume.times(part.density)).sum();
        let centroid = mass.centroid();
        let principal = mass.principal_axes();
        Self {
            volume: parts.map(|part| part.volume.mass()).sum::<f64>() + 0.0,
            mass: mass.mass() + 0.0,
            centroid,
            inertia: centroid.map(|point| mass.inertia_about(point)),
            principal_moments: principal.as_ref().map(|p| p.moments),
            principal_axes: principal.as_ref().map(|p| p.axes),
        }
    }
}

impl Cell {
    fn new(part: &Part) -> Self {
        let body = Body::of(std::iter::once(part));
        Self { cell: part.cell.0, inside: part.inside.clone(), density: part.density, body }
    }
}

/// A table: a row for each cell, for each input, and for all.
fn print(report: &Report, out: &mut dyn Write) -> Result<(), CommandError> {
    let names: Vec<&str> = report.inputs.iter().map(|input| input.name.as_str()).collect();
    let columns = ["volume", "mass", "x", "y", "z", "moment 1", "moment 2", "moment 3"];
    let bits = |inside: &[u8]| -> String {
        let texts =
            inside.iter().zip(&names).map(|(b, name)| format!("{b:<width$}", width = name.chars().count()));
        texts.collect::<Vec<_>>().join(" ")
    };
    let first = names.iter().map(|name| name.chars().count()).chain([5]).max().unwrap_or(5);
    let header: String = columns.iter().map(|name| format!("  {name:>13}")).collect();
    writeln!(out, "{:<first$}  {}{header}", "cell", names.join(" "))?;
    let width = names.join(" ").chars().count();
    for cell in &report.cells {
        let name = format!("c{}", cell.cell);
        writeln!(out, "{name:<first$}  {}{}", bits(&cell.inside), row(&cell.body))?;
    }
    let inputs = report.inputs.iter().map(|input| (input.name.as_str(), &input.body));
    for (name, body) in inputs.chain([("all", &report.total)]) {
        writeln!(out, "{name:<first$}  {:<width$}{}", "", row(body))?;
    }
    Ok(())
}

fn row(body: &Body) -> String {
    let three = |values: Option<[f64; 3]>| values.map_or([None; 3], |v| v.map(Some));
    let numbers = [Some(body.volume), Some(body.mass)].into_iter();
    let numbers = numbers.chain(three(body.centroid)).chain(three(body.principal_moments));
    let text = |number: Option<f64>| match number {
        Some(x) if x == 0.0 || (1e-4..1e7).contains(&x.abs()) => format!("  {x:>13.6}"),
        Some(x) => format!("  {x:>13.6e}"),
        None => format!("  {:>13}", "-"),
    };
    numbers.map(text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_on_the_command_line() {
        let found = |text: &str| text.parse::<Density>().ok().map(|d| (d.name, d.value));
        assert_eq!(found("2.5"), Some((None, 2.5)));
        assert_eq!(found("wood=600"), Some((Some("wood".to_owned()), 600.0)));
        for text in ["", "0", "-1", "NaN", "inf", "a=", "a=b"] {
            assert_eq!(found(text), None, "{text}");
        }
    }
}
