//! Line drawings as SVG documents.

use super::InkLine;
use crate::Rgb;
use lar_core::{SvgStyle, SvgWriter};
use std::collections::{BTreeMap, BTreeSet};

/// Steps of coordinates in a pixel.
const STEPS: f64 = 100.0;

/// Ends of a piece in steps, the smaller first, so that what two cells share is drawn once.
type Piece = [[i64; 2]; 2];

/// One path for each colour and width, thin ones first.
pub(super) fn document(lines: &[InkLine], size: [u32; 2], background: Option<Rgb>) -> String {
    let [x, y] = size.map(|side| 0.5 * f64::from(side));
    let mut svg = SvgWriter::new([-x, -y], [x, y]);
    if let Some(color) = background {
        let fill = Some(hexadecimal(color));
        let style = SvgStyle { id: "background", fill: fill.as_deref(), stroke: None };
        svg.path(&style, [(&[[-x, -y], [x, -y], [x, y], [-x, y]], true)]);
    }
    // Widths are not negative: their bits are in their order.
    let mut pieces: BTreeMap<(u64, String), BTreeSet<Piece>> = BTreeMap::new();
    for line in lines {
        let mut ends = line.ends.map(|p| p.map(|c| (STEPS * c).round() as i64));
        ends.sort_unstable();
        pieces.entry((line.width.to_bits(), hexadecimal(line.color))).or_default().insert(ends);
    }
    for ((width, color), pieces) in &pieces {
        let style = SvgStyle { id: "", fill: None, stroke: Some((color.as_str(), f64::from_bits(*width))) };
        let run = |piece: &Piece| {
            let [a, b] = piece.map(|p| p.map(|c| c as f64 / STEPS));
            (if a == b { vec![a] } else { vec![a, b] }, false)
        };
        svg.path(&style, pieces.iter().map(run));
    }
    svg.finish()
}

fn hexadecimal(color: Rgb) -> String {
    let [r, g, b] = color.map(|c| (255.0 * c).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
