//! Scenes with known arrangements, and families of scenes of any size.

mod refectory;

pub use refectory::{refectory, setting};

use crate::random::Random;
use lar_core::mapper::{MapError, Rod};
use lar_core::{
    AffineError, GridError, Model, ModelError, Node, Points, ProductError, SimplexError, Struct, StructError,
    Surface, cuboid_grid, icosphere, r, s, simplex, t, triangular_prism,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Why a scene gives no surfaces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The hierarchy cannot be evaluated.
    #[error(transparent)]
    Struct(#[from] StructError),
    /// A model has no surface.
    #[error("{path}: {source}")]
    Model {
        /// Path of the model in its scene.
        path: String,
        /// What is wrong with it.
        source: ModelError,
    },
    /// A model is malformed.
    #[error(transparent)]
    Complex(#[from] ModelError),
    /// A shape of the mapper has a parameter out of its range.
    #[error(transparent)]
    Shape(#[from] MapError),
    /// A product cannot be built.
    #[error(transparent)]
    Product(#[from] ProductError),
    /// Simplices cannot be built.
    #[error(transparent)]
    Simplices(#[from] SimplexError),
    /// A complex on the line cannot be built.
    #[error(transparent)]
    Line(#[from] GridError),
    /// A transformation is of another space.
    #[error(transparent)]
    Affine(#[from] AffineError),
}

/// The placed models of a scene as surfaces, each called by the last part of its path.
///
/// # Errors
/// When the hierarchy cannot be evaluated or a model has no surface; the path is named.
pub fn surfaces(scene: &Struct) -> Result<Vec<Surface>, SceneError> {
    let surface = |placed: lar_core::PlacedModel| {
        let found = placed.model.to_surface(placed.name());
        found.map_err(|source| SceneError::Model { path: placed.path.clone(), source })
    };
    scene.eval_struct()?.into_iter().map(surface).collect()
}

/// The unit cube with one corner at the origin.
#[must_use]
pub fn cube() -> Model {
    cuboid_grid(&[1, 1, 1])
}

/// Three unit cubes A, B, C in general position (Paoluzzi et al. 2019, §6.2): 49 vertices, 88 edges, 47 faces and,
/// with the exterior, 8 cells, one for each row of the truth table of three solids.
#[must_use]
pub fn three_cubes() -> Struct {
    Struct::new("three cubes")
        .with(("A", cube()))
        .with(t(&[0.3, 0.4, 0.25]))
        .with(r([PI / 5.0, 0.0, 0.0]))
        .with(r([0.0, 0.0, PI / 12.0]))
        .with(("B", cube()))
        .with(t(&[-0.2, 0.4, -0.2]))
        .with(r([0.0, PI / 5.0, 0.0]))
        .with(r([0.0, PI / 12.0, 0.0]))
        .with(("C", cube()))
}

/// Two unit cubes A and B, the second moved by (½, ½, ½).
#[must_use]
pub fn offset_cubes() -> Struct {
    Struct::new("offset cubes").with(("A", cube())).with(t(&[0.5; 3])).with(("B", cube()))
}

/// Two unit cubes A and B, the second turned by 60° about z and raised by ½.
#[must_use]
pub fn turned_cubes() -> Struct {
    let place = [Node::from(t(&[0.0, 0.0, 0.5])), r([0.0, 0.0, PI / 3.0]).into()];
    pair("turned cubes", place)
}

/// A cube A and a cube B of half its size in its middle.
#[must_use]
pub fn nested_cubes() -> Struct {
    pair("nested cubes", [t(&[0.25; 3]).into(), s(&[0.5; 3]).into()])
}

/// Two unit cubes A and B that share half a face.
#[must_use]
pub fn touching_cubes() -> Struct {
    pair("touching cubes", [t(&[1.0, 0.5, 0.0]).into()])
}

fn pair(name: &str, place: impl IntoIterator<Item = Node>) -> Struct {
    let nodes = std::iter::once(Node::from(("A", cube()))).chain(place).chain([Node::from(("B", cube()))]);
    Struct::from_nodes(name, nodes)
}

/// Two standard tetrahedra A and B, the second moved by (¼, ¼, ¼): one face gets a triangular hole.
#[must_use]
pub fn two_simplices() -> Struct {
    Struct::new("two simplices").with(("A", simplex(3))).with(t(&[0.25; 3])).with(("B", simplex(3)))
}

/// Three prisms A, B, C of height 2 over an equilateral triangle, through each other at right angles.
#[must_use]
pub fn three_prisms() -> Struct {
    let prism = equilateral_prism();
    Struct::new("three prisms")
        .with(("A", prism.clone()))
        .with(r([FRAC_PI_2, 0.0, 0.0]))
        .with(("B", prism.clone()))
        .with(r([0.0, FRAC_PI_2, 0.0]))
        .with(("C", prism))
}

/// The prism of height 2 over the equilateral triangle in the unit circle.
fn equilateral_prism() -> Model {
    let (_, cells) = triangular_prism().into_parts();
    let corner = |i: u32| {
        let (y, x) = (TAU * f64::from(i % 3) / 3.0).sin_cos();
        [x, y, if i < 3 { 0.0 } else { 2.0 }]
    };
    Model::new(Points::from_xyz(&(0..6).map(corner).collect::<Vec<_>>()), cells)
}

/// Two spheres A and B of radius 1 and 20 · 4^`level` triangles each; B is turned, so that no two triangles are
/// parallel, and moved by `offset` along a skew direction.
///
/// # Errors
/// When `offset` is not finite.
///
/// # Panics
/// When `level` is above 13, as [`icosphere`].
pub fn two_spheres(level: u32, offset: f64) -> Result<[Surface; 2], AffineError> {
    let sphere = icosphere(level);
    let place = t(&[0.36 * offset, 0.48 * offset, 0.8 * offset]).compose(&r([0.3, 0.2, 0.5]))?;
    let moved = sphere.transformed(&place)?;
    Ok([Surface::from_triangles("A", &sphere), Surface::from_triangles("B", &moved)])
}

/// `n` cubes A, B, … with edges of 0.5 to 1, turned at random, their centres in a box that grows with n so that each meets a
/// few others. The same seed gives the same scene everywhere.
#[must_use]
pub fn random_cubes(n: usize, seed: u64) -> Struct {
    let mut random = Random::new(seed);
    let side = 0.8 * (n as f64).cbrt();
    let nodes = lar_arrangement::operand_names(n).into_iter().map(|name| {
        let place = [(); 3].map(|()| side * random.unit());
        let turn = [(); 3].map(|()| PI * random.unit());
        let size = 0.5 + 0.5 * random.unit();
        let one = Struct::new("cube").with(t(&place)).with(r(turn)).with(s(&[size; 3])).with(t(&[-0.5; 3]));
        Node::from(one.with((name, cube())))
    });
    Struct::from_nodes("random cubes", nodes.collect::<Vec<_>>())
}

/// Two unit cubes A and B that cross: the middle of B lies in A, near a corner, and B is turned at random.
#[must_use]
pub fn crossing_cubes(seed: u64) -> Struct {
    let mut random = Random::new(seed);
    let turn = [(); 3].map(|()| PI * random.unit());
    pair("crossing cubes", [t(&[0.8, 0.7, 0.85]).into(), r(turn).into(), t(&[-0.5; 3]).into()])
}

/// Two grids A and B of `side`³ unit cubes about one middle, the second turned by angles of 30°, 20° and 10° about x,
/// y and z. Inner walls divide space but bound nothing: a cube of A is a cell of its own.
#[must_use]
pub fn cube_grids(side: usize) -> Struct {
    let grid = cuboid_grid(&[side; 3]);
    let middle = t(&[-0.5 * side as f64; 3]);
    let turn = |axis: [f64; 3], degrees: f64| r(axis.map(|x| x * PI * degrees / 180.0));
    let b = Struct::new("turned")
        .with(turn([1.0, 0.0, 0.0], 30.0))
        .with(turn([0.0, 1.0, 0.0], 20.0))
        .with(turn([0.0, 0.0, 1.0], 10.0))
        .with(middle.clone())
        .with(("B", grid.clone()));
    Struct::new("cube grids").with(Struct::new("upright").with(middle).with(("A", grid))).with(b)
}

/// Three cylinders A, B, C of radius 1 and height 4 with so many sides, along z, y and x, through each other about the
/// origin.
///
/// # Errors
/// When `sides` is below 3.
pub fn three_rods(sides: usize) -> Result<Struct, SceneError> {
    let rod = Rod { height: 4.0, shape: sides, ..Rod::default() }.model()?;
    let lying = |name: &str, turn: [f64; 3]| {
        Struct::new("rod").with(r(turn)).with(t(&[0.0, 0.0, -2.0])).with((name, rod.clone()))
    };
    Ok(Struct::new("three rods")
        .with(lying("A", [0.0; 3]))
        .with(lying("B", [FRAC_PI_2, 0.0, 0.0]))
        .with(lying("C", [0.0, FRAC_PI_2, 0.0])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::parents_ok;
    use lar_arrangement::arrange;

    /// f-vector with the exterior, and volumes of the bounded cells in rising order.
    #[track_caller]
    fn check(scene: &Struct, f_vector: [usize; 4], volumes: &[f64]) {
        let surfaces = surfaces(scene).unwrap();
        let arrangement = arrange(&surfaces).unwrap();
        assert_eq!(arrangement.complex().f_vector(), f_vector);
        assert_eq!(arrangement.euler(), 0);
        assert!(parents_ok(&arrangement, &surfaces));
        let mut found = arrangement.volumes().split_off(1);
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), volumes.len(), "{found:?}");
        let near = found.iter().zip(volumes).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near, "{found:?} are not {volumes:?}");
    }

    #[test]
    fn known_arrangements() {
        let three = [0.046873, 0.054026, 0.059034, 0.296879, 0.590061, 0.597214, 0.840067];
        check(&three_cubes(), [49, 88, 47, 8], &three);
        check(&offset_cubes(), [22, 36, 18, 4], &[0.125, 0.875, 0.875]);
        check(&turned_cubes(), [20, 34, 18, 4], &[0.133975, 0.866025, 0.866025]);
        check(&nested_cubes(), [16, 24, 12, 3], &[0.125, 0.875]);
        check(&touching_cubes(), [16, 26, 13, 3], &[1.0, 1.0]);
        check(&two_simplices(), [11, 18, 12, 4], &[0.002604, 0.164063, 0.164063]);
        let prisms = arrange(&surfaces(&three_prisms()).unwrap()).unwrap();
        assert_eq!(prisms.complex().f_vector(), [32, 63, 39, 8]);
    }

    #[test]
    fn names_are_those_of_the_models() {
        let names: Vec<String> = surfaces(&three_cubes()).unwrap().into_iter().map(|s| s.name).collect();
        assert_eq!(names, ["A", "B", "C"]);
    }

    #[test]
    fn random_scenes_repeat() {
        assert_eq!(random_cubes(5, 1), random_cubes(5, 1));
        assert_ne!(random_cubes(5, 1), random_cubes(5, 2));
        assert_eq!(surfaces(&random_cubes(5, 1)).unwrap().len(), 5);
    }

    #[test]
    fn a_scene_without_faces_is_refused_with_its_path() {
        let scene = Struct::new("scene").with(("rod", cuboid_grid(&[1, 0, 0])));
        assert!(surfaces(&scene).unwrap_err().to_string().starts_with("scene/rod: "));
    }
}
