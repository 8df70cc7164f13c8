//! The bodies of the fuzz targets on mutations of good input; the same bodies run under cargo-fuzz for long.
//!
//! `LAR_SCENES` sets the number of mutations for each seed text, `LAR_SEED` the first of their seeds.

#[path = "../fuzz/src/lib.rs"]
#[allow(unreachable_pub, reason = "it is the library of the targets")]
mod targets;

use lar_core::{ChainComplex, MeshFormat, PolygonMesh, Struct, cuboid_grid, icosphere, r, t};
use std::fs;
use std::path::Path;

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    }
}

/// What readers stumble over.
const WORDS: [&[u8]; 16] = [
    b"4294967295",
    b"-1",
    b"0",
    b"1e999",
    b"nan",
    b"1e-320",
    b"99999999999999999999",
    b"\n",
    b" ",
    b"\\\n",
    b"#",
    b"\"",
    b"((((",
    b"/",
    b"\xff",
    b"\0\0\0\x80",
];

fn mutated(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(4) {
        let at = random.below(bytes.len() + 1);
        let end = at + random.below(bytes.len() - at + 1).min(random.below(40));
        match random.below(6) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let part = bytes[at..end].to_vec();
                let place = random.below(bytes.len() + 1);
                bytes.splice(place..place, part);
            }
            3 => drop(bytes.splice(at..at, WORDS[random.below(WORDS.len())].iter().copied())),
            4 => drop(bytes.splice(at..end, WORDS[random.below(WORDS.len())].iter().copied())),
            _ => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << random.below(8);
                }
            }
        }
    }
    bytes
}

/// The body on each seed text as it is, and on `count` mutations of it.
fn check(body: fn(&[u8]), seeds: &[Vec<u8>], count: u64) {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let first = number("LAR_SEED").unwrap_or(0);
    for (index, seed) in seeds.iter().enumerate() {
        body(seed);
        for round in first..first + number("LAR_SCENES").unwrap_or(count) {
            let bytes = mutated(seed, &mut Random(round));
            let outcome = std::panic::catch_unwind(|| body(&bytes));
            assert!(
                outcome.is_ok(),
                "seed text {index}, LAR_SEED={round}: {:?}",
                bytes.escape_ascii().to_string()
            );
        }
    }
}

fn fixture(name: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures").join(name)).expect("a fixture")
}

fn ball(format: MeshFormat) -> Vec<u8> {
    icosphere(0).to_bytes(format).expect("the ball fits all formats")
}

#[test]
fn readers_of_surfaces() {
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng a\nf 1//1 2/2/2 -2\nf 1 2 \\\n 4\n".to_vec();
    check(targets::obj, &[ball(MeshFormat::Obj), obj], 6000);
    let stl = [ball(MeshFormat::StlText), ball(MeshFormat::StlBinary), fixture("two_solids.stl")];
    check(targets::stl, &stl, 4000);
    let ply = [MeshFormat::PlyText, MeshFormat::PlyLittleEndian].map(ball);
    check(targets::ply, &[&ply[..], &[fixture("cube_extras.ply")]].concat(), 4000);
    check(targets::off, &[ball(MeshFormat::Off), fixture("cube_colours.off")], 6000);
}

#[test]
fn readers_of_drawings_and_models() {
    let path = b"<svg><path transform='rotate(30)' d='M0 0h4v3l-2-1q1 2 3 4a2 1 0 0 1 5 5z'/></svg>".to_vec();
    check(targets::svg, &[fixture("plan.svg"), path], 1500);
    let grid = cuboid_grid(&[2, 1, 1]);
    check(targets::model, &[grid.to_json().expect("a valid model").into_bytes()], 3000);
    let scene = Struct::new("a").with(t(&[1.0; 3])).with(grid.clone()).with(r([0.0, 1.0, 0.0])).with(grid);
    let scene = Struct::new("b").with(scene.clone()).with(t(&[0.5; 3])).with(scene);
    check(targets::structure, &[scene.to_json().expect("a valid scene").into_bytes()], 2000);
    let surface = cuboid_grid(&[1, 1, 1]).to_surface("cube").expect("it has faces");
    let complex: ChainComplex = lar_arrangement::arrange(&[surface]).expect("finite").complex().clone();
    check(targets::complex, &[complex.to_json().expect("a valid complex").into_bytes()], 2000);
}

#[test]
fn expressions() {
    let seeds = ["A - (B | !C) ^ A & B", "((((A))))", "!!!A|B"].map(|s| s.as_bytes().to_vec());
    check(targets::expression, &seeds, 5000);
}

#[test]
fn arrangements() {
    let bytes = |n: usize| -> Vec<u8> {
        let mut random = Random(n as u64);
        (0..n).map(|_| random.below(256) as u8).collect()
    };
    check(targets::arrangement, &[bytes(60), bytes(120), bytes(240)], 400);
    check(targets::planar, &[bytes(20), bytes(60), bytes(100)], 1500);
}
