//! Operands: surface files, named A, B, C, … in order, or by `name=path`.

use crate::CommandError;
use lar_arrangement::{BooleanError, operand_names};
use lar_core::{Surface, read_surface};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The operands of a command.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct Inputs {
    /// OBJ, STL, PLY or OFF files, each one operand: named A, B, C, … in order, or NAME=PATH.
    #[arg(value_name = "INPUT", required = true)]
    inputs: Vec<PathBuf>,
}

/// What was read.
#[derive(Clone, Debug)]
pub(crate) struct Operands {
    /// One surface an operand, called by its name.
    pub surfaces: Vec<Surface>,
    /// The file of each.
    pub files: Vec<PathBuf>,
    /// Time that reading took.
    pub read: Duration,
}

impl Operands {
    pub(crate) fn names(&self) -> Vec<&str> {
        self.surfaces.iter().map(|s| s.name.as_str()).collect()
    }

    /// The file of the operand that an error is about.
    pub(crate) fn file_of(&self, error: &BooleanError) -> Option<PathBuf> {
        let (BooleanError::Open { solid, .. } | BooleanError::Unoriented { solid }) = error else {
            return None;
        };
        self.surfaces.iter().zip(&self.files).find(|(s, _)| s.name == *solid).map(|(_, file)| file.clone())
    }
}

/// The operands' names and files. Names are settled before any file is read.
pub(crate) fn named(inputs: &[PathBuf]) -> Result<Vec<(String, PathBuf)>, CommandError> {
    let defaults = operand_names(inputs.len());
    let named = |(input, default): (&PathBuf, String)| match split(input) {
        Some((name, path)) => (name.to_owned(), path),
        None => (default, input.clone()),
    };
    let all: Vec<(String, PathBuf)> = inputs.iter().zip(defaults).map(named).collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by_key(|&i| &all[i].0);
    match order.windows(2).find(|w| all[w[0]].0 == all[w[1]].0) {
        None => Ok(all),
        Some(w) => Err(CommandError::SameName {
            name: all[w[0]].0.clone(),
            files: [all[w[0]].1.clone(), all[w[1]].1.clone()],
        }),
    }
}

impl Inputs {
    /// The operands' names and files.
    #[cfg(feature = "viewer")]
    pub(crate) fn named(&self) -> Result<Vec<(String, PathBuf)>, CommandError> {
        named(&self.inputs)
    }

    /// Reads all operands.
    pub(crate) fn read(&self) -> Result<Operands, CommandError> {
        operands(&self.inputs)
    }
}

/// Reads all operands.
pub(crate) fn operands(inputs: &[PathBuf]) -> Result<Operands, CommandError> {
    let named = named(inputs)?;
    let start = Instant::now();
    let surfaces = named.iter().map(|(name, path)| read(name, path)).collect::<Result<_, _>>()?;
    let files = named.into_iter().map(|(_, path)| path).collect();
    Ok(Operands { surfaces, files, read: start.elapsed() })
}

/// The name and the path of `name=path`; `None` when there is no name before a `=`, or the whole is an existing file.
pub(crate) fn split(input: &Path) -> Option<(&str, PathBuf)> {
    let (name, path) = input.to_str()?.split_once('=')?;
    let mut letters = name.chars();
    let starts = letters.next().is_some_and(|c| c.is_alphabetic() || c == '_');
    let is_name = starts && letters.all(|c| c.is_alphanumeric() || c == '_' || c == '.');
    (is_name && !input.exists()).then(|| (name, path.into()))
}

/// Reads one file as a surface of this name.
pub(crate) fn read(name: &str, path: &Path) -> Result<Surface, CommandError> {
    if is_json(path) {
        return Err(CommandError::NotASurface { path: path.to_owned() });
    }
    let mut surface = read_surface(path)?.surface;
    name.clone_into(&mut surface.name);
    Ok(surface)
}

pub(crate) fn is_json(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(inputs: &[&str], expected: Result<&[(&str, &str)], &str>) {
        let inputs: Vec<PathBuf> = inputs.iter().map(PathBuf::from).collect();
        let found = named(&inputs).map_err(|e| e.to_string());
        let expected: Result<Vec<_>, _> = match expected {
            Ok(pairs) => Ok(pairs.iter().map(|&(n, p)| (n.to_owned(), PathBuf::from(p))).collect()),
            Err(message) => Err(message.to_owned()),
        };
        assert_eq!(found, expected);
    }

    #[test]
    fn names() {
        check(&["x.obj", "y.obj"], Ok(&[("A", "x.obj"), ("B", "y.obj")]));
        check(&["x.obj", "hole=y.obj", "z"], Ok(&[("A", "x.obj"), ("hole", "y.obj"), ("C", "z")]));
        check(&["a=b=c"], Ok(&[("a", "b=c")]));
        check(&["1=b", "./a=c", "=d"], Ok(&[("A", "1=b"), ("B", "./a=c"), ("C", "=d")]));
        check(&["B=x.obj", "y.obj"], Err("two operands are named B: x.obj and y.obj"));
    }
}
