//! `three_cubes`: the workflow of Paoluzzi et al. 2019, §6.2, from the scene to the pictures.
//!
//! ```
//! use lar_arrangement::{Expression, FillRule, arrange};
//! use lar_examples::scenes;
//!
//! let surfaces = scenes::surfaces(&scenes::three_cubes())?;
//! let arrangement = arrange(&surfaces)?;
//! let union = Expression::parse("A | B | C", &["A", "B", "C"])?;
//! let union = arrangement.boolean(&union, FillRule::NonZero)?;
//! assert_eq!((union.cells().len(), union.boundary().count()), (7, 21));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::size::Size;
use crate::{CommandError, program, scenes, tables};
use clap::Parser;
use lar_arrangement::{Arrangement, Expression, FillRule, arrange};
use lar_core::Surface;
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

/// Three cubes in general position: their arrangement as a chain complex, their truth table, Booleans, pictures.
#[derive(Debug, Parser)]
#[command(name = "three_cubes", version)]
struct Arguments {
    /// Write the four panels of Figure 6 as figure6a.png … figure6d.png into this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Open a window on the exploded 3-cells.
    #[arg(long)]
    view: bool,
    /// Width and height of the pictures in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x800")]
    size: Size,
}

/// Runs the program: `args` begin with its name, the numbers go to `out`, an error is one line on `err`. Returns the
/// exit code: 0 done, 2 bad usage or an output that cannot be written, 3 no graphics adapter or display; the numbers
/// are printed in any case.
pub fn run(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    program::run(args, out, err, |arguments: Arguments, out| {
        let surfaces = scenes::surfaces(&scenes::three_cubes())?;
        let arrangement = arrange(&surfaces)?;
        print(&arrangement, out)?;
        out.flush()?;
        pictures(&arguments, &arrangement, &surfaces, out)
    })
}

fn print(arrangement: &Arrangement, out: &mut dyn Write) -> Result<(), CommandError> {
    let [vertices, edges, faces, cells] = [0, 1, 2, 3].map(|p| arrangement.complex().n_cells(p));
    writeln!(out, "f-vector: {vertices} vertices, {edges} edges, {faces} faces, {cells} cells")?;
    writeln!(out, "\n∂3, a row for each cell, a column for each face; c0 is the exterior")?;
    write!(out, "{}", tables::boundary_3(arrangement))?;
    writeln!(out, "\nwhich cell is inside which cube")?;
    write!(out, "{}", tables::truth_table(arrangement, usize::MAX))?;
    writeln!(out)?;
    for (name, text) in [("union", "A | B | C"), ("intersection", "A & B & C"), ("difference", "A - B - C")] {
        let solid = arrangement.boolean(&Expression::parse(text, &["A", "B", "C"])?, FillRule::NonZero)?;
        let (faces, volume) = (solid.boundary().count(), solid.volume());
        writeln!(out, "{name:<12}  {text}  {faces:>2} faces, volume {volume:.6}")?;
    }
    Ok(())
}

#[cfg(feature = "viewer")]
fn pictures(
    arguments: &Arguments,
    arrangement: &Arrangement,
    surfaces: &[Surface],
    out: &mut dyn Write,
) -> Result<(), CommandError> {
    if arguments.out.is_none() && !arguments.view {
        return Ok(());
    }
    let size = [arguments.size.width, arguments.size.height];
    let figures = crate::figures::panels(arrangement, surfaces, size)?;
    if let Some(dir) = &arguments.out {
        let adapter = crate::figures::write_figures(&figures, dir)?;
        writeln!(out, "\ndrawn by {adapter}")?;
        for figure in &figures {
            writeln!(out, "{}  {}", dir.join(format!("{}.png", figure.name)).display(), figure.title)?;
        }
        out.flush()?;
    }
    let [.., cells] = figures;
    if arguments.view { program::show(cells.scene, cells.view, "three cubes") } else { Ok(()) }
}

#[cfg(not(feature = "viewer"))]
fn pictures(
    arguments: &Arguments,
    _: &Arrangement,
    _: &[Surface],
    _: &mut dyn Write,
) -> Result<(), CommandError> {
    let wanted = arguments.out.is_some() || arguments.view;
    if wanted { Err(CommandError::NotBuilt { feature: "viewer" }) } else { Ok(()) }
}
