//! Colour maps: numbers as colours, with equal steps looking equal.
//!
//! Both maps are straight in Oklab (Björn Ottosson, *A perceptual color space for image processing*, 2020), where distances
//! are those that are seen: the sequential one is a helix about its grey axis, with lightness and hue linear and chroma
//! constant, so that each step is as long as any other; the diverging one goes from blue over light grey to orange.

use crate::Rgb;

/// Lightness of the sequential map at 0 and at 1.
const LIGHTNESS: [f64; 2] = [0.30, 0.93];
/// Hue of the sequential map at 0 and at 1, in degrees: from violet over blue and green to yellow.
const HUES: [f64; 2] = [295.0, 105.0];
/// Its chroma; all of the helix lies in sRGB.
const CHROMA: f64 = 0.095;
/// The diverging map: lightness in the middle and at the ends, hues and chroma of the ends.
const DIVERGING: ([f64; 2], [f64; 2], f64) = ([0.95, 0.55], [255.0, 50.0], 0.13);

/// A way from the numbers 0 to 1 to colours.
///
/// ```
/// use lar_viewer::ColorMap;
/// let dark = ColorMap::Sequential.color(0.0);
/// let light = ColorMap::Sequential.color(1.0);
/// assert!(dark.iter().sum::<f32>() < light.iter().sum::<f32>());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColorMap {
    /// Dark violet to light yellow, for amounts.
    #[default]
    Sequential,
    /// Blue to orange with light grey in the middle, for numbers about 0.
    Diverging,
}

impl ColorMap {
    /// The colour of a number; numbers beyond 0 and 1 count as these, NaN as 0.
    #[must_use]
    pub fn color(self, value: f64) -> Rgb {
        let t = if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) };
        let between = |[a, b]: [f64; 2], t: f64| a + t * (b - a);
        match self {
            Self::Sequential => oklch(between(LIGHTNESS, t), CHROMA, between(HUES, t)),
            Self::Diverging => {
                let (lightness, hues, chroma) = DIVERGING;
                let out = (2.0 * t - 1.0).abs();
                oklch(between(lightness, out), chroma * out, hues[usize::from(0.5 < t)])
            }
        }
    }
}

/// The sRGB colour of lightness, chroma and hue (in degrees) of Oklab.
fn oklch(lightness: f64, chroma: f64, hue: f64) -> Rgb {
    let (sin, cos) = hue.to_radians().sin_cos();
    let (a, b) = (chroma * cos, chroma * sin);
    // Both matrices are those of the publication.
    let l = (lightness + 0.3963377774 * a + 0.2158037573 * b).powi(3);
    let m = (lightness - 0.1055613458 * a - 0.0638541728 * b).powi(3);
    let s = (lightness - 0.0894841775 * a - 1.2914855480 * b).powi(3);
    let linear = [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
    ];
    linear.map(|c| displayed(c).clamp(0.0, 1.0) as f32)
}

/// An amount of light as an sRGB value (IEC 61966-2-1).
fn displayed(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oklab of an sRGB colour, by the inverse matrices of the publication.
    fn oklab(color: Rgb) -> [f64; 3] {
        let linear = color
            .map(f64::from)
            .map(|c| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) });
        let [r, g, b] = linear;
        let l = (0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b).cbrt();
        let m = (0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b).cbrt();
        let s = (0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b).cbrt();
        [
            0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
        ]
    }

    #[test]
    fn equal_steps_look_equal() {
        let colors: Vec<[f64; 3]> =
            (0..=64).map(|i| oklab(ColorMap::Sequential.color(f64::from(i) / 64.0))).collect();
        let step = |w: &[[f64; 3]]| (0..3).map(|k| (w[1][k] - w[0][k]).powi(2)).sum::<f64>().sqrt();
        let steps: Vec<f64> = colors.windows(2).map(step).collect();
        let (least, most) = steps.iter().fold((f64::MAX, 0.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
        assert!(most < 1.05 * least, "{least} to {most}: a colour outside of sRGB is cut");
        assert!(colors.windows(2).all(|w| w[0][0] < w[1][0]), "lightness rises");
    }

    #[test]
    fn the_diverging_map_is_even_about_its_middle() {
        let lightness = |t: f64| oklab(ColorMap::Diverging.color(t))[0];
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            assert!((lightness(t) - lightness(1.0 - t)).abs() < 0.02, "{t}");
        }
        assert_eq!(ColorMap::Diverging.color(f64::NAN), ColorMap::Diverging.color(-3.0));
    }
}
