//! Polygons, a checker of all laws, and a small random generator, shared by the tests.
#![allow(dead_code, reason = "each test file uses some of these")]

use lar_core::Points;
use lar_triangle::{Quality, Triangulator, check_laws};

/// A polygon with holes: 2D positions, and loops of indices into them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Polygon {
    pub(crate) xy: Vec<[f64; 2]>,
    pub(crate) loops: Vec<Vec<u32>>,
}

impl Polygon {
    /// Appends a loop with its own points.
    pub(crate) fn with(mut self, cycle: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let first = self.xy.len() as u32;
        self.xy.extend(cycle);
        self.loops.push((first..self.xy.len() as u32).collect());
        self
    }

    pub(crate) fn points(&self) -> Points {
        Points::from_columns(2, self.xy.as_flattened().to_vec())
    }

    pub(crate) fn loop_slices(&self) -> Vec<&[u32]> {
        self.loops.iter().map(Vec::as_slice).collect()
    }

    /// Signed area of the loops.
    pub(crate) fn area(&self) -> f64 {
        let cross = |a: [f64; 2], b: [f64; 2]| (a[0] * b[1] - a[1] * b[0]) / 2.0;
        let of_loop = |l: &Vec<u32>| -> f64 {
            (0..l.len()).map(|i| cross(self.xy[l[i] as usize], self.xy[l[(i + 1) % l.len()] as usize])).sum()
        };
        self.loops.iter().map(of_loop).sum()
    }

    /// The same polygon moved in the plane and laid into space by a rotation of no special angles.
    pub(crate) fn lifted(&self, offset: f64) -> Points {
        let (s, c) = 0.7f64.sin_cos();
        let (u, v) = (1.1f64.sin(), 1.1f64.cos());
        let place = |p: &[f64; 2]| {
            let (x, y) = (p[0] * c - p[1] * s, p[0] * s + p[1] * c);
            [x + offset, y * u - offset, y * v + 2.0 * offset]
        };
        Points::from_xyz(&self.xy.iter().map(place).collect::<Vec<_>>())
    }
}

/// Points on a closed curve around `centre`, radius by angle.
pub(crate) fn radial(
    n: usize,
    centre: [f64; 2],
    clockwise: bool,
    radius: impl Fn(usize) -> f64,
) -> Vec<[f64; 2]> {
    let sign = if clockwise { -1.0 } else { 1.0 };
    let at = |i: usize| {
        let (s, c) = (sign * std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
        [centre[0] + radius(i) * c, centre[1] + radius(i) * s]
    };
    (0..n).map(at).collect()
}

pub(crate) fn triangle_area(points: &Points, [a, b, c]: [u32; 3]) -> f64 {
    let at = |i: u32| points.point(i as usize);
    let (a, b, c) = (at(a), at(b), at(c));
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
}

/// Triangulates a planar polygon and checks everything that must hold of a proper triangulation.
#[track_caller]
pub(crate) fn check_proper(polygon: &Polygon) -> Vec<[u32; 3]> {
    let points = polygon.points();
    let mut triangles = Vec::new();
    let quality = Triangulator::new().face(&points, polygon.loop_slices(), &mut triangles);
    assert_eq!(quality, Ok(Quality::Proper));
    assert_eq!(check_laws(polygon.loop_slices(), &triangles), Ok(()));
    let areas: Vec<f64> = triangles.iter().map(|&t| triangle_area(&points, t)).collect();
    let scale: f64 = areas.iter().map(|a| a.abs()).sum();
    let sum: f64 = areas.iter().sum();
    assert!((sum - polygon.area()).abs() <= 1e-9 * scale, "areas {sum}, polygon {}", polygon.area());
    assert!(areas.iter().all(|&a| a > -1e-12 * scale), "a triangle is turned over");
    triangles
}

/// Triangulates loops over any points and checks the combinatorial laws.
#[track_caller]
pub(crate) fn check_combinatorial(points: &Points, loops: &[&[u32]]) -> Quality {
    let mut triangles = Vec::new();
    let quality = Triangulator::new().face(points, loops.iter().copied(), &mut triangles);
    assert_eq!(check_laws(loops.iter().copied(), &triangles), Ok(()), "{triangles:?}");
    quality.expect("well-formed loops are never refused")
}

/// A xorshift generator.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A comb: `teeth` thin teeth that point up.
pub(crate) fn comb(teeth: usize) -> Polygon {
    let mut outline = vec![[teeth as f64 * 2.0, -1.0]];
    for t in (0..teeth).rev() {
        let x = 2.0 * t as f64;
        outline.extend([[x + 1.9, 0.0], [x + 1.0, 100.0], [x + 0.1, 0.0]]);
    }
    outline.push([0.0, -1.0]);
    Polygon::default().with(outline)
}

/// A band that winds `turns` times, `per_turn` corners a turn on each side.
pub(crate) fn spiral(turns: usize, per_turn: usize) -> Polygon {
    let n = turns * per_turn;
    let at = |i: usize, extra: f64| {
        let angle = std::f64::consts::TAU * i as f64 / per_turn as f64;
        let r = 1.0 + angle + extra;
        [r * angle.cos(), r * angle.sin()]
    };
    let outer = (0..n).map(|i| at(i, 3.0));
    let inner = (0..n).rev().map(|i| at(i, 0.0));
    Polygon::default().with(outer.chain(inner))
}

/// A square with k × k square holes.
pub(crate) fn sieve(k: usize) -> Polygon {
    let side = 2.0 * k as f64 + 1.0;
    let mut sieve = Polygon::default().with([[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]);
    for i in 0..k * k {
        let (x, y) = (2.0 * (i % k) as f64 + 1.0, 2.0 * (i / k) as f64 + 1.0);
        sieve = sieve.with([[x, y], [x, y + 1.0], [x + 1.0, y + 1.0], [x + 1.0, y]]);
    }
    sieve
}
