//! Writing complexes of the plane as SVG.

use super::SvgError;
use crate::measure::loop_area_2d;
use crate::obj::write_number;
use crate::{ChainComplex, atomic_write};
use std::io::{self, Write};
use std::path::Path;

impl ChainComplex {
    /// Writes the faces and edges of a complex of the plane as an SVG file, whole or not at all.
    ///
    /// # Errors
    /// As [`to_svg`](Self::to_svg), and when the file cannot be written.
    #[doc(alias = "lar2svg")]
    pub fn write_svg(&self, path: impl AsRef<Path>) -> Result<(), SvgError> {
        let text = self.to_svg()?;
        atomic_write(path, |out| out.write_all(text.as_bytes()))?;
        Ok(())
    }

    /// The faces and edges of a complex of the plane as the text of an SVG file: a `path` of id `f0`, `f1`, …
    /// for each bounded face, holes left out of it, neighbours in different colours as a rule, and above them
    /// one `path` of id `edges`. Coordinates are those of the points, y negated, in the shortest form that
    /// reads back exactly. O(size).
    ///
    /// # Errors
    /// When the dimension is not 1 or 2, the points have not two coordinates, or the complex breaks a law of
    /// [`validate`](Self::validate).
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let grid = ChainComplex::from_model(&cuboid_grid(&[2, 1])).unwrap();
    /// let text = grid.to_svg()?;
    /// assert!(text.contains("<path id=\"f1\" fill=\"hsl(137 65% 72%)\" d=\"M1 0L2 0L2 -1L1 -1Z\"/>"));
    /// # Ok::<(), lar_core::SvgError>(())
    /// ```
    pub fn to_svg(&self) -> Result<String, SvgError> {
        let (dim, space) = (self.dim(), self.points().dim());
        if !matches!(dim, 1 | 2) || space != 2 {
            return Err(SvgError::NotPlanar { dim, space });
        }
        let violations = self.validate();
        if !violations.is_empty() {
            return Err(SvgError::Invalid(violations));
        }
        let mut bytes = Vec::new();
        write_document(self, &mut bytes).expect("writing to memory does not fail");
        Ok(String::from_utf8(bytes).expect("numbers and letters are UTF-8"))
    }
}

fn write_document(complex: &ChainComplex, out: &mut dyn Write) -> io::Result<()> {
    let (x, y, w, h) = view_box(complex);
    out.write_all(b"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"")?;
    for (number, after) in [(x, b" "), (y, b" "), (w, b" "), (h, b"\"")] {
        write_number(out, number)?;
        out.write_all(after)?;
    }
    out.write_all(b" fill-rule=\"evenodd\">\n")?;
    if complex.dim() == 2 {
        (0..complex.n_cells(2)).try_for_each(|f| write_face(complex, f, out))?;
    }
    write_edges(complex, w.max(h), out)?;
    out.write_all(b"</svg>\n")
}

/// The box of the points with a margin of 2 %, y downwards; 1 × 1 where there is no extent.
fn view_box(complex: &ChainComplex) -> (f64, f64, f64, f64) {
    let (lo, hi) = complex.points().bounds().unwrap_or((vec![0.; 2], vec![0.; 2]));
    let size = (hi[0] - lo[0]).max(hi[1] - lo[1]);
    let margin = if size > 0. { size / 50. } else { 0.5 };
    let extent = |k: usize| hi[k] - lo[k] + 2. * margin;
    (lo[0] - margin, -hi[1] - margin, extent(0), extent(1))
}

/// A face of negative area is the exterior: it is not drawn.
fn write_face(complex: &ChainComplex, f: usize, out: &mut dyn Write) -> io::Result<()> {
    /// Hues a golden angle apart: any few in a row differ.
    const GOLDEN_ANGLE: f64 = 137.50776405003785;
    let loops = complex.face_loops(f);
    let area: f64 = loops.iter().map(|cycle| loop_area_2d(complex.points(), cycle)).sum();
    if area < 0. {
        return Ok(());
    }
    let hue = (f as f64 * GOLDEN_ANGLE % 360.) as u32;
    write!(out, "<path id=\"f{f}\" fill=\"hsl({hue} 65% 72%)\" d=\"")?;
    for cycle in &loops {
        write_run(complex, cycle, out)?;
        out.write_all(b"Z")?;
    }
    out.write_all(b"\"/>\n")
}

fn write_edges(complex: &ChainComplex, size: f64, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(
        b"<path id=\"edges\" fill=\"none\" stroke=\"#222\" stroke-linecap=\"round\" stroke-width=\"",
    )?;
    write_number(out, size / 400.)?;
    out.write_all(b"\" d=\"")?;
    for ends in (0..complex.n_cells(1)).filter_map(|e| complex.edge_ends(e)) {
        write_run(complex, &ends, out)?;
    }
    out.write_all(b"\"/>\n")
}

fn write_run(complex: &ChainComplex, vertices: &[u32], out: &mut dyn Write) -> io::Result<()> {
    for (i, &v) in vertices.iter().enumerate() {
        let p = complex.points().point(v as usize);
        out.write_all(if i == 0 { b"M" } else { b"L" })?;
        // Adding zero makes minus zero plain.
        write_number(out, p[0] + 0.)?;
        out.write_all(b" ")?;
        write_number(out, 0. - p[1])?;
    }
    Ok(())
}
