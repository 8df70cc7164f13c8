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

use check::{check, verdict};
use common::Random;

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
