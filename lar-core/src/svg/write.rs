//! Writing complexes of the plane as SVG.

use super::{SvgError, SvgStyle, SvgWriter};
use crate::measure::loop_area_2d;
use crate::{ChainComplex, atomic_write};
use std::path::Path;

impl ChainComplex {
    /// Writes the faces and edges of a complex of the plane as an SVG file, whole or not at all. O(size).
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
        let [lo, hi] = view_box(self);
        let mut svg = SvgWriter::new(lo, hi);
        if dim == 2 {
            (0..self.n_cells(2)).for_each(|f| push_face(self, f, &mut svg));
        }
        let width = (hi[0] - lo[0]).max(hi[1] - lo[1]) / 400.;
        let style = SvgStyle { id: "edges", fill: None, stroke: Some(("#222", width)), opacity: None };
        let edges = (0..self.n_cells(1)).filter_map(|e| self.edge_ends(e));
        svg.path(&style, edges.map(|ends| (run(self, &ends), false)));
        Ok(svg.finish())
    }
}

/// The box of the points with a margin of 2 %; 1 × 1 where there is no extent.
fn view_box(complex: &ChainComplex) -> [[f64; 2]; 2] {
    let (lo, hi) = complex.points().bounds().unwrap_or((vec![0.; 2], vec![0.; 2]));
    let size = (hi[0] - lo[0]).max(hi[1] - lo[1]);
    let margin = if size > 0. { size / 50. } else { 0.5 };
    [[lo[0] - margin, lo[1] - margin], [hi[0] + margin, hi[1] + margin]]
}

/// A face of negative area is the exterior: it is not drawn.
fn push_face(complex: &ChainComplex, f: usize, svg: &mut SvgWriter) {
    /// Hues a golden angle apart: any few in a row differ.
    const GOLDEN_ANGLE: f64 = 137.50776405003785;
    let loops = complex.face_loops(f);
    let area: f64 = loops.iter().map(|cycle| loop_area_2d(complex.points(), cycle)).sum();
    if area >= 0. {
        let (id, hue) = (format!("f{f}"), (f as f64 * GOLDEN_ANGLE % 360.) as u32);
        let fill = format!("hsl({hue} 65% 72%)");
        let style = SvgStyle { id: &id, fill: Some(&fill), ..SvgStyle::default() };
        svg.path(&style, loops.iter().map(|cycle| (run(complex, cycle), true)));
    }
}

fn run(complex: &ChainComplex, vertices: &[u32]) -> Vec<[f64; 2]> {
    let at = |&v: &u32| [0, 1].map(|k| complex.points().point(v as usize)[k]);
    vertices.iter().map(at).collect()
}
