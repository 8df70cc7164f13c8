//! Random drawings of the paper's planar figures. The same seed gives the same drawing.

use crate::random::Random;
use lar_arrangement::planar::Drawing;
use lar_core::Points;
use std::f64::consts::TAU;

/// Steps of the additive recurrence that spreads points over the unit square: 1/p and 1/p² for the plastic number p
/// (M. Roberts, *The unreasonable effectiveness of quasirandom sequences*, 2018).
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// Sides of the polygon that stands for a circle.
const CIRCLE: usize = 64;

/// A closed polygon by its corners.
pub type Outline = Vec<[f64; 2]>;

/// Places spread over the unit square more evenly than random ones, which leave gaps.
fn places(random: &mut Random) -> impl Iterator<Item = [f64; 2]> + use<> {
    let start = [random.unit(), random.unit()];
    (0..).map(move |k| [0, 1].map(|i| (start[i] + f64::from(k) * STEPS[i]).fract()))
}

/// The outlines of `n` circles and as many regular polygons of three to eight sides, in the unit square or a little
/// beyond it.
#[must_use]
pub fn circles_and_polygons(n: usize, seed: u64) -> Vec<Outline> {
    let mut random = Random::new(seed);
    let places = places(&mut random);
    let mut shape = |(k, [x, y]): (usize, [f64; 2])| {
        let [size, turn, sides] = [(); 3].map(|()| random.unit());
        let sides = if k % 2 == 0 { CIRCLE } else { 3 + (6.0 * sides) as usize };
        let radius = 0.05 + 0.15 * size;
        let corner = |k: usize| {
            let (sin, cos) = (TAU * (turn + k as f64 / sides as f64)).sin_cos();
            [x + radius * cos, y + radius * sin]
        };
        (0..sides).map(corner).collect()
    };
    places.take(2 * n).enumerate().map(&mut shape).collect()
}

/// The outlines of `n` rectangles, each turned by an angle of its own, in the unit square or a little beyond it.
#[must_use]
pub fn rectangles(n: usize, seed: u64) -> Vec<Outline> {
    let mut random = Random::new(seed);
    let places = places(&mut random);
    let mut rectangle = |[x, y]: [f64; 2]| {
        let [width, height, turn] = [(); 3].map(|()| random.unit());
        let (sin, cos) = (TAU * turn).sin_cos();
        let [w, h] = [width, height].map(|side| 0.07 + 0.27 * side);
        let corner = |[u, v]: [f64; 2]| [x + w * u * cos - h * v * sin, y + w * u * sin + h * v * cos];
        [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(corner).to_vec()
    };
    places.take(n).map(&mut rectangle).collect()
}

/// The segments of outlines, one after the other.
#[must_use]
pub fn drawing(outlines: &[Outline]) -> Drawing {
    let mut out = Drawing::new(Points::new(2));
    for outline in outlines {
        let corners: Vec<u32> = outline.iter().map(|&corner| out.push_point(corner)).collect();
        let next = corners.iter().skip(1).chain(corners.first());
        corners.iter().zip(next).for_each(|(&a, &b)| out.push_segment([a, b]));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_repeat() {
        assert_eq!(circles_and_polygons(9, 3), circles_and_polygons(9, 3));
        assert_ne!(rectangles(9, 3), rectangles(9, 4));
        let all = circles_and_polygons(9, 3);
        assert!(all.iter().step_by(2).all(|outline| outline.len() == CIRCLE));
        assert!(all.iter().skip(1).step_by(2).all(|outline| (3..=8).contains(&outline.len())));
        assert_eq!(drawing(&rectangles(7, 1)).n_segments(), 28);
    }
}
