//! Planar arrangements against exact fractions, the reference values, and counts in closed form.

mod booleans;
mod check;
#[path = "../common/mod.rs"]
mod common;
mod fraction;
mod inputs;
mod large;
mod location;
mod oracle;
mod parts;
mod reference;

use check::{arranged, check, compare, drawing, verdict};
use common::Random;
use lar_arrangement::planar::Dangling;
use oracle::{Oracle, Segment};

#[test]
fn random_drawings_are_what_the_definition_says() {
    let random = &mut Random(1);
    for _ in 0..6000 {
        check(&inputs::segments(random), |segments| verdict(segments, 1.0));
    }
}

#[test]
fn exact_motions_and_scales_change_nothing_else() {
    let random = &mut Random(2);
    for _ in 0..300 {
        let segments = inputs::segments(random);
        for (name, moved) in inputs::variants(&segments, random) {
            check(&moved, |segments| verdict(segments, 1.0).map_err(|e| format!("{name}: {e}")));
        }
        for scale in [0.5, 1024.0, 2f64.powi(-300), 2f64.powi(300)] {
            check(&segments, |segments| verdict(segments, scale));
        }
    }
}

#[test]
fn bundles_that_cross_each_other() {
    let random = &mut Random(3);
    for (n_stars, n_rays, side, cases) in [(2, 12, 9, 100), (3, 20, 13, 12), (8, 25, 41, 1)] {
        for _ in 0..cases {
            check(&inputs::stars(random, n_stars, n_rays, side), |segments| {
                compare(&arranged(&drawing(segments, 1.0), Dangling::Keep), &Oracle::new(segments, true), 1.0)
            });
        }
    }
}

/// Up to nine bits, as far as the oracle goes: crossings with large denominators, angles that differ by little.
#[test]
fn random_drawings_with_large_numbers() {
    let random = &mut Random(4);
    for _ in 0..300 {
        let n = 3 + random.below(12);
        let side = 1 << (3 + random.below(7));
        let mut coordinate = || random.below(side) as i64;
        let segments: Vec<Segment> = (0..n).map(|_| [(); 4].map(|()| coordinate())).collect();
        check(&segments, |segments| verdict(segments, 1.0));
    }
}
