//! SVG documents of paths.

use crate::atomic_write;
use crate::files::push_number;
use crate::svg::SvgError;
use std::io::Write;
use std::path::Path;

/// How a path is painted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SvgStyle<'a> {
    /// The `id` of its element; none when empty.
    pub id: &'a str,
    /// Colour of its inside, found by parity, as SVG writes colours.
    pub fill: Option<&'a str>,
    /// Colour and width of its lines.
    pub stroke: Option<(&'a str, f64)>,
    /// Opacity of the whole, 1 when not given.
    pub opacity: Option<f64>,
}

/// Writes paths, one over the other, as an SVG document. The y axis points up here and down there; coordinates are
/// otherwise those given, in the shortest form that reads back exactly.
///
/// ```
/// use lar_core::{SvgStyle, SvgWriter};
/// let mut svg = SvgWriter::new([0., 0.], [2., 1.]);
/// let style = SvgStyle { id: "roof", stroke: Some(("#222", 0.05)), ..SvgStyle::default() };
/// svg.path(&style, [(&[[0., 0.], [1., 1.], [2., 0.]], false)]);
/// assert!(svg.finish().contains("d=\"M0 0L1 -1L2 0\""));
/// ```
#[derive(Clone, Debug)]
pub struct SvgWriter {
    text: Vec<u8>,
}

/// Why writing to memory cannot fail.
const MEMORY: &str = "writing to memory does not fail";

impl SvgWriter {
    /// A document that shows the box from `lo` to `hi`.
    #[must_use]
    pub fn new(lo: [f64; 2], hi: [f64; 2]) -> Self {
        let mut out = Self { text: b"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"".to_vec() };
        for (number, after) in [(lo[0], " "), (-hi[1], " "), (hi[0] - lo[0], " "), (hi[1] - lo[1], "\"")] {
            // Adding zero makes minus zero plain.
            out.number(number + 0.);
            out.push(after);
        }
        out.push(" fill-rule=\"evenodd\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
        out
    }

    /// Adds a path of runs, each closed or not. A run of one point is a dot as wide as the stroke; empty ones are
    /// left out, and so is a path without runs. O(points).
    pub fn path<R: AsRef<[[f64; 2]]>>(
        &mut self,
        style: &SvgStyle<'_>,
        runs: impl IntoIterator<Item = (R, bool)>,
    ) {
        let before = self.text.len();
        self.push("<path");
        self.attribute("id", style.id);
        self.attribute("fill", style.fill.unwrap_or("none"));
        if let Some((color, width)) = style.stroke {
            self.attribute("stroke", color);
            self.push(" stroke-width=\"");
            self.number(width);
            self.push("\"");
        }
        if let Some(opacity) = style.opacity {
            self.push(" opacity=\"");
            self.number(opacity);
            self.push("\"");
        }
        self.push(" d=\"");
        let start = self.text.len();
        runs.into_iter().for_each(|(run, closed)| self.run(run.as_ref(), closed));
        if self.text.len() == start {
            self.text.truncate(before);
        } else {
            self.push("\"/>\n");
        }
    }

    fn run(&mut self, points: &[[f64; 2]], closed: bool) {
        for (i, &[x, y]) in points.iter().enumerate() {
            self.push(if i == 0 { "M" } else { "L" });
            self.number(x + 0.);
            self.push(" ");
            self.number(0. - y);
        }
        match points.len() {
            0 => {}
            1 => self.push("h0"),
            _ if closed => self.push("Z"),
            _ => {}
        }
    }

    /// The text of the document.
    #[must_use]
    pub fn finish(mut self) -> String {
        self.push("</svg>\n");
        String::from_utf8(self.text).expect("numbers and strings are UTF-8")
    }

    /// Writes the document as a file, whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(self, path: impl AsRef<Path>) -> Result<(), SvgError> {
        let text = self.finish();
        Ok(atomic_write(path, |out| out.write_all(text.as_bytes()))?)
    }

    fn attribute(&mut self, name: &str, value: &str) {
        if value.is_empty() {
            return;
        }
        write!(self.text, " {name}=\"").expect(MEMORY);
        for c in value.chars() {
            match c {
                '&' => self.push("&amp;"),
                '<' => self.push("&lt;"),
                '"' => self.push("&quot;"),
                c if c.is_control() => self.push(" "),
                c => write!(self.text, "{c}").expect(MEMORY),
            }
        }
        self.push("\"");
    }

    fn push(&mut self, text: &str) {
        self.text.extend_from_slice(text.as_bytes());
    }

    fn number(&mut self, x: f64) {
        push_number(&mut self.text, x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_in_order() {
        let mut svg = SvgWriter::new([-0.5, -1.], [1.5, 0.]);
        let edge = ("#102030", 0.25);
        let square: Vec<[f64; 2]> = vec![[0., 0.], [1., 0.], [1., -1.], [0., -1.]];
        svg.path(&SvgStyle { id: "a<\"&\n", fill: Some("red"), ..SvgStyle::default() }, [(square, true)]);
        svg.path(
            &SvgStyle { stroke: Some(edge), ..SvgStyle::default() },
            [(&[[0., 1e-9]][..], true), (&[], true)],
        );
        svg.path(&SvgStyle::default(), [(&[], false)]);
        let lines: Vec<String> = svg.finish().lines().map(str::to_owned).collect();
        assert_eq!(lines.len(), 4, "{lines:?}");
        assert!(lines[0].contains("viewBox=\"-0.5 0 2 1\""), "{}", lines[0]);
        assert_eq!(lines[1], "<path id=\"a&lt;&quot;&amp; \" fill=\"red\" d=\"M0 0L1 0L1 1L0 1Z\"/>");
        assert_eq!(
            lines[2],
            "<path fill=\"none\" stroke=\"#102030\" stroke-width=\"0.25\" d=\"M0 -1e-9h0\"/>"
        );
    }
}
