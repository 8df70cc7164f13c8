//! Families of degenerate scenes with a parameter, by counts and volumes in closed form: as built, in exact numbers, and
//! at random rigid positions, where rounding has moved every coordinate.

mod common;

use common::{
    Random, arranged, assert_close, counts, cuboid, flipped, mapped, moved, prism, sorted_volumes, surface,
};
use lar_arrangement::{
    Arrangement, Arranger, Checks, Detail, Expression, FillRule, Planes, Solid, operand_names,
};
use lar_core::{Affine, Surface, icosphere, rotation, t};
use std::f64::consts::{PI, TAU};

/// What a family keeps at random rigid positions.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Moved {
    /// All counts: whatever meets, meets in points that are input points, or at an angle.
    Counts,
    /// Counts need facets that are nearly coplanar to be made coplanar, or edges that are nearly collinear.
    CountsOnceCoplanar,
    /// What passes through one line passes through a bundle of nearby lines then: laws and volumes only.
    Volumes,
}

struct Family {
    name: String,
    surfaces: Vec<Surface>,
    /// Vertices, edges, faces, cells with the exterior.
    counts: [usize; 4],
    /// Of all bounded cells together.
    volume: f64,
    moved: Moved,
}

fn family(
    name: impl Into<String>,
    surfaces: Vec<Surface>,
    counts: [usize; 4],
    volume: f64,
    moved: Moved,
) -> Family {
    Family { name: name.into(), surfaces, counts, volume, moved }
}

fn unit_at(x: f64, y: f64, z: f64) -> Surface {
    cuboid([x, y, z], [x + 1.0, y + 1.0, z + 1.0])
}

fn two_boxes() -> Vec<Family> {
    let with = |name: &str, other: Surface, counts: [usize; 4], volume: f64, moved: Moved| {
        family(name, vec![unit_at(0.0, 0.0, 0.0), other], counts, volume, moved)
    };
    vec![
        with("a common face", unit_at(1.0, 0.0, 0.0), [12, 20, 11, 3], 2.0, Moved::CountsOnceCoplanar),
        with("half a common face", unit_at(1.0, 0.5, 0.0), [16, 26, 13, 3], 2.0, Moved::CountsOnceCoplanar),
        with(
            "part of a face",
            cuboid([1.0, 0.25, 0.25], [2.0, 0.75, 0.75]),
            [16, 24, 12, 3],
            1.25,
            Moved::CountsOnceCoplanar,
        ),
        with("coplanar sides", unit_at(0.5, 0.0, 0.0), [16, 28, 16, 4], 1.5, Moved::CountsOnceCoplanar),
        with("a common edge", unit_at(1.0, 1.0, 0.0), [14, 23, 12, 3], 2.0, Moved::Counts),
        with("part of an edge", unit_at(1.0, 1.0, 0.5), [16, 25, 12, 3], 2.0, Moved::CountsOnceCoplanar),
        with("a common vertex", unit_at(1.0, 1.0, 1.0), [15, 24, 12, 3], 2.0, Moved::Counts),
        with("at an angle", unit_at(0.5, 0.5, 0.5), [22, 36, 18, 4], 1.875, Moved::Counts),
    ]
}

/// n slabs one way, n the other, aligned at one corner and overlapping in half the height: a piece of each slab, and
/// the n² crossings.
fn crossing_walls(n: usize) -> Family {
    let (length, at) = (2.0 * n as f64 - 1.0, |i: usize| 2.0 * i as f64);
    let one_way = (0..n).map(|i| cuboid([at(i), 0.0, 0.0], [at(i) + 1.0, length, 2.0]));
    let other_way = (0..n).map(|i| cuboid([0.0, at(i), 1.0], [length, at(i) + 1.0, 3.0]));
    let surfaces: Vec<Surface> = one_way.chain(other_way).collect();
    let volume = 4.0 * n as f64 * length - (n * n) as f64;
    let square = n * n;
    let counts = [8 * square + 8 * n, 16 * square + 12 * n, 8 * square + 8 * n, (n + 1) * (n + 1)];
    family(format!("{n} walls each way"), surfaces, counts, volume, Moved::CountsOnceCoplanar)
}

/// Each standing on the one below, half a step further round: polygons of twice as many corners between them.
fn twisted_stack(n: u32, storeys: u32) -> Family {
    let storey = |k: u32| prism(n, 1.0, 0.5 * f64::from(k), [f64::from(k), f64::from(k + 1)]);
    let surfaces = (0..storeys).map(storey).collect();
    let (n, k) = (n as usize, storeys as usize);
    let between = k - 1;
    // Between two: 2n crossings, each of 2n edges in three pieces, 2n triangles around one polygon.
    let vertices = 2 * n * k + 2 * n * between;
    let edges = 3 * n * k + 4 * n * between;
    let faces = n * k + 2 + (2 * n + 1) * between;
    let area = n as f64 / 2.0 * (TAU / n as f64).sin();
    let counts = [vertices, edges, faces, k + 1];
    family(format!("{k} prisms of {n} sides"), surfaces, counts, area * k as f64, Moved::CountsOnceCoplanar)
}

/// n thin tetrahedra that have one corner in common, in directions spread over the sphere.
fn star(n: u32) -> Family {
    let needle = |i: u32| {
        let height = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(n);
        let (radius, angle) = ((1.0 - height * height).sqrt(), PI * (3.0 - 5f64.sqrt()) * f64::from(i));
        let tip = [radius * angle.cos(), radius * angle.sin(), height];
        let side = [-angle.sin(), angle.cos(), 0.0];
        let up = [-height * angle.cos(), -height * angle.sin(), radius];
        let at = |u: f64, v: f64| [0, 1, 2].map(|k| tip[k] + 0.01 * (u * side[k] + v * up[k]));
        let points = [[0.0; 3], at(1.0, 0.0), at(-0.5, 0.8), at(-0.5, -0.8)];
        surface(&points, &[&[0, 2, 1], &[0, 3, 2], &[0, 1, 3], &[1, 2, 3]])
    };
    let volume = 1.5 * 0.8 * 1e-4 / 3.0 * f64::from(n);
    let size = n as usize;
    let counts = [3 * size + 1, 6 * size, 4 * size, size + 1];
    family(format!("a star of {n}"), (0..n).map(needle).collect(), counts, volume, Moved::Counts)
}

/// n tetrahedra around a common edge, with gaps between them.
fn star_at_an_edge(n: u32) -> Family {
    let blade = |i: u32| {
        let corner = |turn: f64| {
            let angle = TAU * (f64::from(i) + turn) / f64::from(n);
            [angle.cos(), angle.sin(), 0.0]
        };
        let points = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], corner(0.0), corner(0.5)];
        surface(&points, &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]])
    };
    let volume = f64::from(n) * (PI / f64::from(n)).sin() / 3.0;
    let size = n as usize;
    let counts = [2 * size + 2, 5 * size + 1, 4 * size, size + 1];
    family(format!("{n} blades at an edge"), (0..n).map(blade).collect(), counts, volume, Moved::Counts)
}

/// n rectangles through one line in their middles.
fn pages(n: i32) -> Family {
    let page = |i: i32| {
        let (x, y) = (f64::from(n), f64::from(2 * i - n));
        let points = [[-x, -y, 0.0], [x, y, 0.0], [x, y, 5.0], [-x, -y, 5.0]];
        surface(&points, &[&[0, 1, 2, 3]])
    };
    let size = n as usize;
    let counts = [4 * size + 2, 6 * size + 1, 2 * size, 1];
    family(format!("{n} pages"), (0..n).map(page).collect(), counts, 0.0, Moved::Volumes)
}

/// A triangle through which n others are stuck, apart from each other.
fn pierced(n: usize) -> Family {
    let row = (n as f64).sqrt().ceil() as usize;
    let (size, mut points) = (2.0 * row as f64, Vec::new());
    for i in 0..n {
        let (x, y) = ((i % row) as f64 + 0.3, (i / row) as f64 + 0.3);
        points.extend([[x, y, 0.4], [x + 0.4, y + 0.1, 0.5], [x + 0.2, y + 0.3, -0.4]]);
    }
    let triangles: Vec<[u32; 3]> = (0..n as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let small = surface(&points, &triangles.iter().map(|t| &t[..]).collect::<Vec<_>>());
    let corners = [[-1.0, -1.0, 0.0], [size + 1.0, -1.0, 0.0], [-1.0, size + 1.0, 0.0]];
    let counts = [3 + 5 * n, 3 + 6 * n, 1 + 2 * n, 1];
    family(
        format!("pierced {n} times"),
        vec![surface(&corners, &[&[0, 1, 2]]), small],
        counts,
        0.0,
        Moved::Counts,
    )
}

fn nested_shells(n: u32) -> Family {
    let shell = |k: u32| cuboid([f64::from(k); 3], [f64::from(3 * n - k); 3]);
    let size = n as usize;
    let counts = [8 * size, 12 * size, 6 * size, size + 1];
    family(
        format!("{n} shells"),
        (0..n).map(shell).collect(),
        counts,
        (3.0 * f64::from(n)).powi(3),
        Moved::Counts,
    )
}

/// The same solid several times, the odd ones inside out.
fn repeated(n: usize) -> Family {
    let cube = cuboid([0.0; 3], [2.0; 3]);
    let copies = (0..n).map(|i| if i % 2 == 0 { cube.clone() } else { flipped(&cube) }).collect();
    family(format!("one cube {n} times"), copies, [8, 12, 6, 2], 8.0, Moved::Counts)
}

fn families() -> Vec<Family> {
    let mut all = two_boxes();
    all.extend([1, 2, 3, 6].map(crossing_walls));
    all.extend([(3, 2), (4, 3), (12, 4), (64, 2)].map(|(n, k)| twisted_stack(n, k)));
    all.extend([2, 7, 40].map(star));
    all.extend([2, 5, 16].map(star_at_an_edge));
    all.extend([2, 5, 12].map(pages));
    all.extend([1, 30, 10_000].map(pierced));
    all.extend([1, 3, 20].map(nested_shells));
    all.extend([2, 3, 6].map(repeated));
    all
}

fn rigid(random: &mut Random) -> Affine {
    let axis = [0; 3].map(|_| random.between(-1.0, 1.0));
    let turn = rotation(axis, random.between(0.1, 3.0)).expect("the axis is not zero");
    let by = [0; 3].map(|_| random.between(-3.0, 3.0));
    t(&by).compose(&turn).expect("both are maps of 3-space")
}

fn check_volume(f: &Family, a: &Arrangement) {
    let found: f64 = a.volumes()[1..].iter().sum();
    assert!(
        (found - f.volume).abs() <= 1e-9 * f.volume + 1e-12,
        "{}: volume {found}, not {}",
        f.name,
        f.volume
    );
}

/// Random positions of a family; large ones cost more and take fewer.
fn positions(f: &Family) -> Vec<Vec<Surface>> {
    let n = if f.surfaces.iter().map(Surface::n_faces).sum::<usize>() > 1000 { 2 } else { 20 };
    let random = &mut Random(11);
    (0..n).map(|_| moved(&f.surfaces, &rigid(random))).collect()
}

#[test]
fn as_built() {
    for f in families() {
        let a = arranged(&f.surfaces);
        assert_eq!(counts(&a), f.counts, "{}", f.name);
        check_volume(&f, &a);
    }
}

#[test]
fn at_random_rigid_positions() {
    for f in families() {
        for input in positions(&f) {
            let a = arranged(&input);
            check_volume(&f, &a);
            if f.moved == Moved::Counts {
                assert_eq!(counts(&a), f.counts, "{}", f.name);
            }
        }
    }
}

#[test]
fn at_random_rigid_positions_once_coplanar() {
    for f in families().iter().filter(|f| f.moved == Moved::CountsOnceCoplanar) {
        for input in positions(f) {
            assert_eq!(counts(&arranged(&input)), f.counts, "{}", f.name);
        }
    }
}

fn evaluated<'a>(a: &'a Arrangement, text: &str) -> Solid<'a> {
    let expression = Expression::parse(text, &operand_names(a.n_solids())).expect("well formed");
    a.boolean(&expression, FillRule::NonZero).expect("the operands are closed")
}

/// A solid without itself is nothing; without itself moved by one step of the grid it is nothing as well, or, as given, a
/// sheet one step thick.
#[test]
fn a_solid_without_itself() {
    let ball = Surface::from_triangles("ball", &icosphere(3));
    for turn in [Affine::identity(3), rigid(&mut Random(5))] {
        let solid = ball.transformed(&turn).expect("a map of 3-space");
        let same = arranged(&[solid.clone(), solid.clone()]);
        assert_eq!(counts(&same), counts(&arranged(std::slice::from_ref(&solid))));
        assert_eq!(evaluated(&same, "A - B").cells(), []);
        let step = same.stats().grid_step;
        for axis in 0..3 {
            let beside = mapped(&solid, |mut p| {
                p[axis] += step;
                p
            });
            let both = [solid.clone(), beside];
            let one = arranged(&both);
            assert_eq!(evaluated(&one, "A ^ B").cells(), []);
            assert!((0.9..1.1).contains(&(one.stats().farthest_move / step)));
            let as_given = Arranger::new().checks(Checks::EveryStage).planes(Planes::AsGiven);
            let a = as_given.arrange(&both).expect("a valid scene");
            let (left, right) = (evaluated(&a, "A - B"), evaluated(&a, "B - A"));
            // The disc that the ball covers along the axis, one step thick; vertices are rounded to grid steps.
            let expected = PI * step;
            for rest in [left.volume(), right.volume()] {
                assert!((rest - expected).abs() < 0.5 * expected, "{rest:e}, not {expected:e}");
            }
            assert!(left.to_complex(Detail::Simplified).is_closed());
        }
    }
}

/// A cube of side 3^level without all the bars of a Menger sponge.
fn sponge(level: u32) -> Vec<Surface> {
    let side = 3f64.powi(level as i32);
    let mut out = vec![cuboid([0.0; 3], [side; 3])];
    for depth in 1..=level {
        let (n, width) = (3u32.pow(depth - 1), side / 3f64.powi(depth as i32));
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [u, v] = [i, j].map(|k| width * (3.0 * f64::from(k) + 1.0));
            for axis in 0..3 {
                let place = |mut p: [f64; 3]| {
                    p.rotate_right(axis);
                    p
                };
                out.push(cuboid(place([-1.0, u, v]), place([side + 1.0, u + width, v + width])));
            }
        }
    }
    out
}

#[track_caller]
fn check_sponge(level: u32, genus: i64) {
    let input = sponge(level);
    let text = operand_names(input.len()).join(" - ");
    let a = lar_arrangement::arrange(&input).expect("finite");
    let out = evaluated(&a, &text);
    let n = level as i32;
    assert_close(&[out.volume()], &[20f64.powi(n)], 1e-12 * 20f64.powi(n), "volume");
    let area = 2.0 * 20f64.powi(n) + 4.0 * 8f64.powi(n);
    assert!((out.area() - area).abs() < 1e-9 * area, "area {}, not {area}", out.area());
    let complex = out.to_complex(Detail::Simplified);
    assert!(complex.is_closed());
    assert_eq!((complex.euler(), complex.n_components()), (2 - 2 * genus, 1));
    let turned = lar_arrangement::arrange(&moved(&input, &rigid(&mut Random(3)))).expect("finite");
    let volume = evaluated(&turned, &text).volume();
    assert_close(&[volume], &[20f64.powi(n)], 1e-6, "turned");
}

#[test]
fn menger_sponges() {
    check_sponge(1, 5);
    check_sponge(2, 81);
    check_sponge(3, 1409);
}

/// Sizes from 10^-300 to 10^300 in one scene: what is smaller than the grid is a point, the rest stays.
#[test]
fn sizes_of_all_orders() {
    let sizes = [1e-300, 1.0, 1e300];
    let cubes: Vec<Surface> = sizes.map(|size| cuboid([-size; 3], [size; 3])).to_vec();
    let a = arranged(&cubes);
    assert_eq!((counts(&a), a.stats().degenerate_faces), ([8, 12, 6, 2], 12));
    let near: Vec<Surface> = [1e-3, 1.0, 1e3].map(|size| cuboid([-size; 3], [size; 3])).to_vec();
    assert_eq!(counts(&arranged(&near)), [24, 36, 18, 4]);
    assert_close(&sorted_volumes(&arranged(&near))[..1], &[8e-9], 1e-14, "the smallest");
}

/// Two needles, 10^9 times as long as they are wide, through each other in their middles: a thousand grid steps wide.
#[test]
fn needles() {
    let thin = 1e-9;
    let needle = |turned: bool| {
        let at = |x: f64, y: f64, z: f64| if turned { [-z * 0.9, x, y] } else { [x, y, z] };
        let points = [[-1.0, -thin, -thin], [-1.0, thin, -thin], [-1.0, 0.0, thin], [1.0, 0.1 * thin, 0.0]];
        let faces: [&[u32]; 4] = [&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]];
        surface(&points.map(|[x, y, z]| at(x, y, z)), &faces)
    };
    let both = [needle(false), needle(true)];
    let expected = counts(&arranged(&both));
    assert_eq!(expected[3], 4);
    let random = &mut Random(9);
    for _ in 0..20 {
        assert_eq!(counts(&arranged(&moved(&both, &rigid(random)))), expected);
    }
}

/// Tetrahedra through each other 10^8 times their size away from the origin, at random positions.
#[test]
fn far_from_the_origin() {
    let one = surface(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]],
    );
    let other = mapped(&one, |p| p.map(|x| 0.6 - x));
    let expected = counts(&arranged(&[one.clone(), other.clone()]));
    let random = &mut Random(8);
    for _ in 0..20 {
        let far = t(&[1e8, -1e8, 3e8]).compose(&rigid(random)).expect("maps of 3-space");
        let a = arranged(&moved(&[one.clone(), other.clone()], &far));
        assert_eq!(counts(&a), expected);
    }
}
