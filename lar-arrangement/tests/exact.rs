//! Exact positions as quotients of integers: the positions of the complex are the nearest numbers of 64 bits, in JSON and
//! back.

mod common;

use common::{Random, arranged, cuboid, moved, random_cubes, surfaces, three_cubes};
use dashu_int::IBig;
use lar_core::{ChainComplex, ExactPoints, Surface, rotation, t};

/// x as a multiple of 2^-1200.
fn fixed(x: f64) -> IBig {
    let bits = x.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i64;
    let mantissa = bits & ((1 << 52) - 1) | if exponent == 0 { 0 } else { 1 << 52 };
    let shift = exponent.max(1) - 1075 + 1200;
    let size = IBig::from(mantissa) << usize::try_from(shift).expect("numbers of the tests are not tiny");
    if x < 0.0 { -size } else { size }
}

/// Each coordinate of the complex is at most half a unit in the last place from origin + step · X / W.
#[track_caller]
fn check(input: &[Surface]) -> usize {
    let a = arranged(input);
    let exact = a.exact_points();
    let json = a.complex().to_json_exact(exact.clone()).expect("the complex is valid");
    let (complex, read) = ChainComplex::from_json_exact(&json).expect("as written");
    assert_eq!((&complex, read.as_ref()), (a.complex(), Some(&exact)));
    let ExactPoints { step, origin, points } = read.expect("it was written");
    let number = |text: &String| text.parse::<IBig>().expect("an integer");
    for (homogeneous, rounded) in points.iter().zip(complex.points().iter()) {
        let w = number(&homogeneous[3]);
        for k in 0..3 {
            let x = number(&homogeneous[k]) * fixed(step) + fixed(origin[k]) * &w;
            let difference = x - fixed(rounded[k]) * &w;
            let difference = if difference < IBig::ZERO { -difference } else { difference };
            let unit = fixed(rounded[k].abs().next_up()) - fixed(rounded[k].abs());
            assert!(difference * 2 <= unit * &w, "{homogeneous:?} is not {}", rounded[k]);
        }
    }
    points.iter().filter(|p| p[3] != "1").count()
}

#[test]
fn complexes_are_rounded_from_exact_points() {
    let turn = rotation([1.0, 2.0, 3.0], 0.7).expect("the axis is not zero");
    let pair = [cuboid([0.0; 3], [1.0; 3]), cuboid([0.5; 3], [1.5; 3])];
    // Quotients are not reduced: those of the six crossings are whole numbers, and have denominators all the same.
    assert_eq!(check(&pair), 6);
    assert!(check(&surfaces(&three_cubes())) >= 20);
    assert!(check(&moved(&pair, &turn)) >= 8);
    assert!(check(&moved(&moved(&pair, &turn), &t(&[1e8, 0.0, -3e5]))) >= 8);
    assert!(check(&random_cubes(8, &mut Random(3)).0) >= 20);
}
