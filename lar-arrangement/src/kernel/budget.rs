//! The bit budget of the module's header, on the inputs that reach its bounds.

use super::geometry::Geometry;
use super::point::{HPointOf, PlaneOf};
use super::tests::{LIMIT, Random};
use super::*;

/// The largest magnitudes over all inputs. The quantities are affine in every single coordinate of the input, so
/// they are largest at the corners of the cube of side 2^41; there, in units of 2^40, everything is a small integer.
struct Maxima {
    normal: i128,
    side: i128,
    line: [i128; 2],
    direction: i128,
    planes: [i128; 2],
    planes_side: i128,
}

fn maxima() -> Maxima {
    let corners: Vec<[i64; 3]> = (0..8).map(|c| [0, 1, 2].map(|k| 1 - 2 * (c >> k & 1))).collect();
    let mut planes: Vec<Plane> = Vec::new();
    for (a, b, c) in (0..512).map(|i| (corners[i / 64], corners[i / 8 % 8], corners[i % 8])) {
        let plane = Plane::through(a, b, c);
        if !planes.contains(&plane) {
            planes.push(plane);
        }
    }
    let mut out = Maxima { normal: 0, side: 0, line: [0; 2], direction: 0, planes: [0; 2], planes_side: 0 };
    let raise = |best: &mut i128, x: i128| *best = (*best).max(x.abs());
    let det = |r: [[i128; 3]; 3]| {
        let minor = |u: usize, v: usize| r[1][u] * r[2][v] - r[1][v] * r[2][u];
        r[0][0] * minor(1, 2) + r[0][1] * minor(2, 0) + r[0][2] * minor(0, 1)
    };
    for p in &planes {
        p.n.iter().for_each(|&n| raise(&mut out.normal, n));
        for &a in &corners {
            raise(&mut out.side, p.side(a).abs().max(p.d.abs()));
            for &b in &corners {
                let (at_a, at_b) = (p.side(a), p.side(b));
                raise(&mut out.line[1], at_a - at_b);
                (0..3).for_each(|k| {
                    raise(&mut out.line[0], i128::from(b[k]) * at_a - i128::from(a[k]) * at_b);
                });
            }
        }
        for q in &planes {
            for k in 0..3 {
                let (u, v) = ((k + 1) % 3, (k + 2) % 3);
                raise(&mut out.direction, p.n[u] * q.n[v] - p.n[v] * q.n[u]);
            }
            for r in &planes {
                raise(&mut out.planes[1], det([p.n, q.n, r.n]));
                let x = [0, 1, 2].map(|k| {
                    det([p, q, r].map(|plane| {
                        let mut row = plane.n;
                        row[k] = plane.d;
                        row
                    }))
                });
                x.iter().for_each(|&x| raise(&mut out.planes[0], x));
                let w = det([p.n, q.n, r.n]);
                for s in &planes {
                    raise(&mut out.planes_side, (0..3).map(|k| s.n[k] * x[k]).sum::<i128>() - s.d * w);
                }
            }
        }
    }
    out
}

/// Bits of `units` · 2^(40 · degree).
fn bits(units: i128, degree: u32) -> u32 {
    40 * degree + (128 - units.leading_zeros())
}

/// The table of the module's header, and the widths in limbs that the predicates take.
#[test]
fn bit_budget_holds_at_the_extremes() {
    let m = maxima();
    let [x, w] = m.planes;
    assert_eq!(bits(m.normal, 2), 83);
    assert_eq!(bits(m.side, 3), 125);
    assert_eq!([bits(m.line[0], 4), bits(m.line[1], 3)], [165, 125]);
    assert_eq!(bits(m.direction, 4), 166);
    assert_eq!([bits(x, 7), bits(w, 6)], [289, 249]);
    assert_eq!(bits(m.planes_side, 9), 373);
    // Sums of products: each is bounded by the product of the bounds.
    let [order, orientation, of_midpoint] =
        [bits(2 * x * w, 13), bits(6 * x * x * w, 20), bits(12 * x * x * w * w, 26)];
    assert_eq!([order, orientation, of_midpoint], [538, 827, 1076]);
    // The widths that hold them: i128, then `Int` of 3, 5, 6, 9 and 18 limbs.
    assert!(bits(m.side, 3) < 127 && bits(m.direction, 4) <= 3 * 64);
    assert!(bits(x, 7) <= 5 * 64 && bits(m.planes_side, 9) <= 6 * 64);
    assert!(order <= 9 * 64 && of_midpoint <= 18 * 64);
}

/// The same through the fixed-width integers themselves, which assert that nothing overflows.
#[test]
fn nothing_overflows_at_the_extremes() {
    let mut reached = [0; 3];
    for seed in 0..3_000 {
        let random = &mut Random(seed);
        let points: Vec<[i64; 3]> =
            (0..9).map(|_| std::array::from_fn(|_| [-LIMIT, LIMIT][random.below(2)])).collect();
        let canonical = match seed % 3 {
            0 => CanonicalPoints::default(),
            _ => extreme(&points, random),
        };
        let mut geometry = Geometry::canonical(points, canonical);
        let mut n_facets = 0;
        for base in [[0, 1, 2], [3, 4, 5], [6, 7, 8], [0, 4, 8]] {
            let is_grid = base.iter().all(|&p| geometry.grid_point(p).is_some());
            if !geometry.are_collinear(base) && (is_grid || seed % 3 == 2) {
                geometry.push_facet(base);
                n_facets += 1;
            }
        }
        reached[geometry.reach() as usize] += 1;
        exercise(&geometry, n_facets);
    }
    assert!(reached.iter().all(|&n| n > 300), "{reached:?}");
}

/// Points on planes whose coefficients are all ±2^40 or zero.
fn extreme(points: &[[i64; 3]], random: &mut Random) -> CanonicalPoints {
    let mut out = CanonicalPoints::default();
    for _ in points {
        let planes: [PlaneOf<3>; 3] = std::array::from_fn(|_| {
            let mut n: [i128; 3] =
                std::array::from_fn(|_| i128::from([-LIMIT, LIMIT, LIMIT - 1][random.below(3)]));
            n[random.below(3)] = [0, 1 << 40][random.below(2)];
            let d = 3 * i128::from(LIMIT) * i128::from(LIMIT) * [-1, 1][random.below(2)];
            Plane { n, d }.widened()
        });
        let point = HPointOf::on_planes([&planes[0], &planes[1], &planes[2]]);
        out.rational.extend(point);
        out.positions.extend(point.map(|point| point.rounded()));
        out.entry.push(if point.is_some() { out.rational.len() as u32 } else { 0 });
    }
    out
}

/// Every exact predicate on some vertices of each kind.
fn exercise(geometry: &Geometry, n_facets: u32) {
    let facets: Vec<Support> = (0..n_facets).map(Support::Facet).collect();
    let vertical = (0..3).map(|axis| Support::Vertical { ends: [0, 3], axis });
    let mut defs = vec![VertexDef::Point(4)];
    for support in facets.iter().copied().chain(vertical) {
        let sides = [5, 7].map(|p| geometry.exact_side(&VertexDef::Point(p), support));
        if sides[0].times(sides[1]) == Sign::Negative {
            defs.push(VertexDef::EdgePlane { ends: [5, 7], support });
        }
    }
    if n_facets > 2 {
        let [a, b, c] = [0, 1, 2].map(|f| geometry.wide_plane::<30>(Support::Facet(f)));
        defs.extend(HPointOf::on_planes([&a, &b, &c]).map(|_| VertexDef::Facets([0, 1, 2])));
    }
    for p in &defs {
        assert!(geometry.exact_equality(p, p) && geometry.exact_order(p, p, 0).is_eq());
        geometry.moved_and_rounded(p, [1 << 93; 3]);
        for q in &defs {
            let middle = Midpoint { at: [0.0; 3], of: [*p, *q] };
            geometry.exact_orientation(p, q, &middle, 0, 1);
            geometry.exact_order_with_midpoint(p, &middle, 2);
            for f in 0..n_facets {
                geometry.exact_side(p, Support::Facet(f));
                geometry.exact_side_of_midpoint(&middle, Support::Facet(f));
                let hit = (0..n_facets)
                    .map(|g| geometry.exact_order_of_hits(&middle, Support::Facet(f), Support::Facet(g)));
                assert!(hit.count() == n_facets as usize);
            }
        }
    }
    let edges = [[0, 1], [2, 6]].map(Along::Edge).into_iter();
    let lines = (1..n_facets).map(|f| Along::Facets([0, f]));
    let directions: Vec<Direction> = edges.chain(lines).map(|along| geometry.direction(along)).collect();
    for d in &directions {
        geometry.exact_axis(d);
        (0..n_facets).for_each(|f| {
            assert_eq!(geometry.exact_turn_about(Support::Facet(f), Support::Facet(f), d), Sign::Zero);
        });
        for f in 1..n_facets {
            geometry.exact_turn_about(Support::Facet(0), Support::Facet(f), d);
        }
        assert_eq!(geometry.exact_turn(d, d, 0, 1), Sign::Zero);
        for e in &directions {
            geometry.exact_turn(d, e, 1, 2);
        }
    }
}
