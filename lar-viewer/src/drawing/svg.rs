//! Line drawings as SVG documents.

use super::{InkArea, InkLine};
use crate::Rgb;
use lar_core::{SvgStyle, SvgWriter};
use std::collections::{BTreeMap, BTreeSet};

/// Steps of coordinates in a pixel.
const STEPS: f64 = 100.0;

/// Ends of a piece in steps, the smaller first, so that what two cells share is drawn once.
type Piece = [[i64; 2]; 2];

/// A path for each area, then one for each colour, opacity and width of lines, thin ones first.
pub(super) fn document(
    areas: &[InkArea],
    lines: &[InkLine],
    size: [u32; 2],
    background: Option<Rgb>,
) -> String {
    let [x, y] = size.map(|side| 0.5 * f64::from(side));
    let mut svg = SvgWriter::new([-x, -y], [x, y]);
    if let Some(color) = background {
        let fill = Some(hexadecimal(color));
        let style = SvgStyle { id: "background", fill: fill.as_deref(), ..SvgStyle::default() };
        svg.path(&style, [(&[[-x, -y], [x, -y], [x, y], [-x, y]], true)]);
    }
    for area in areas {
        let fill = hexadecimal(area.color);
        let style = SvgStyle { fill: Some(&fill), opacity: translucent(area.opacity), ..SvgStyle::default() };
        svg.path(&style, area.loops.iter().map(|cycle| (cycle, true)));
    }
    // Widths and opacities are not negative: their bits are in their order.
    let mut pieces: BTreeMap<(u64, u64, String), BTreeSet<Piece>> = BTreeMap::new();
    for line in lines {
        let mut ends = line.ends.map(|p| p.map(|c| (STEPS * c).round() as i64));
        ends.sort_unstable();
        let style = (line.width.to_bits(), line.opacity.to_bits(), hexadecimal(line.color));
        pieces.entry(style).or_default().insert(ends);
    }
    for ((width, opacity, color), pieces) in &pieces {
        let stroke = Some((color.as_str(), f64::from_bits(*width)));
        let style =
            SvgStyle { stroke, opacity: translucent(f64::from_bits(*opacity)), ..SvgStyle::default() };
        let run = |piece: &Piece| {
            let [a, b] = piece.map(|p| p.map(|c| c as f64 / STEPS));
            (if a == b { vec![a] } else { vec![a, b] }, false)
        };
        svg.path(&style, pieces.iter().map(run));
    }
    svg.finish()
}

/// An opacity that is worth writing, to a thousandth.
fn translucent(opacity: f64) -> Option<f64> {
    (opacity < 1.0).then(|| (1e3 * opacity).round() / 1e3)
}

fn hexadecimal(color: Rgb) -> String {
    let [r, g, b] = color.map(|c| (255.0 * c).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
