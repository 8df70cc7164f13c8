//! The twelve colours by which cells are told apart.
//!
//! Code 1 is white, 2 to 12 are the hues; every other code is taken modulo 12, so that a running index gives
//! neighbours different colours. The hues are spread over the circle with alternating lightness and are light
//! enough to keep their tint under flat shading and at an opacity of a few tenths.

/// Red, green, blue between 0 and 1, as displayed (sRGB values; nothing is linearised).
pub type Rgb = [f32; 3];

/// The twelve colours, code 1 first.
///
/// ```
/// assert_eq!(lar_viewer::PALETTE[0], [1.0, 1.0, 1.0]);
/// ```
#[doc(alias = "COLORS")]
pub const PALETTE: [Rgb; 12] = [
    [1.00, 1.00, 1.00], // white
    [0.93, 0.33, 0.28], // vermilion
    [0.27, 0.70, 0.43], // green
    [0.26, 0.52, 0.90], // blue
    [0.98, 0.78, 0.22], // yellow
    [0.72, 0.42, 0.84], // violet
    [0.20, 0.75, 0.80], // cyan
    [0.98, 0.56, 0.20], // orange
    [0.95, 0.50, 0.68], // pink
    [0.65, 0.82, 0.30], // lime
    [0.46, 0.46, 0.82], // indigo
    [0.76, 0.60, 0.42], // tan
];

/// Slate grey, the default background.
pub const SLATE: Rgb = [0.3, 0.4, 0.5];

/// White, a background for print.
pub const WHITE: Rgb = [1.0, 1.0, 1.0];

/// Near-black, the colour of cell edges.
pub const INK: Rgb = [0.08, 0.09, 0.11];

/// How the cells of a family get their colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coloring {
    /// Cell i gets code 2, 3, …, 12, 2, … in turn: the hues without white.
    Cyclic,
    /// All cells get the palette's colour of this code; see [`palette_color`].
    Code(u32),
    /// All cells get this colour.
    Fixed(Rgb),
}

impl Coloring {
    /// The meaning of a colour code for a family of cells: 1 to 12 name a colour for all, any other code asks for
    /// cyclic colours.
    ///
    /// ```
    /// use lar_viewer::Coloring;
    /// assert_eq!(Coloring::from_code(1), Coloring::Code(1));
    /// assert_eq!(Coloring::from_code(99), Coloring::Cyclic);
    /// ```
    #[must_use]
    pub fn from_code(code: u32) -> Self {
        if (1..=PALETTE.len() as u32).contains(&code) { Self::Code(code) } else { Self::Cyclic }
    }

    /// The colour of the cell with this index in its family.
    ///
    /// ```
    /// use lar_viewer::{Coloring, PALETTE};
    /// assert_eq!(Coloring::Cyclic.color(0), PALETTE[1]);
    /// assert_eq!(Coloring::Cyclic.color(11), PALETTE[1]);
    /// assert_eq!(Coloring::Code(1).color(5), PALETTE[0]);
    /// ```
    #[must_use]
    pub fn color(self, index: usize) -> Rgb {
        match self {
            Self::Cyclic => PALETTE[1 + index % (PALETTE.len() - 1)],
            Self::Code(code) => palette_color(code),
            Self::Fixed(color) => color,
        }
    }
}

/// The colour of a code: 1 is white, 2 to 12 the hues, any other code cycles (13 is white again, 0 is code 12).
///
/// ```
/// use lar_viewer::{PALETTE, palette_color};
/// assert_eq!(palette_color(1), PALETTE[0]);
/// assert_eq!(palette_color(14), PALETTE[1]);
/// assert_eq!(palette_color(0), PALETTE[11]);
/// ```
#[must_use]
pub fn palette_color(code: u32) -> Rgb {
    PALETTE[(code as usize + PALETTE.len() - 1) % PALETTE.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_colors_can_be_told_apart() {
        for (i, a) in PALETTE.iter().enumerate() {
            for b in &PALETTE[i + 1..] {
                let apart: f32 = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f32>().sqrt();
                assert!(apart > 0.2, "{a:?} and {b:?} are only {apart} apart");
            }
        }
    }

    #[test]
    fn cyclic_colors_never_give_neighbours_the_same_one() {
        for i in 0..100 {
            assert_ne!(Coloring::Cyclic.color(i), Coloring::Cyclic.color(i + 1));
            assert_ne!(Coloring::Cyclic.color(i), WHITE);
        }
    }
}
