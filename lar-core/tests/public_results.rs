//! Snapshots of what users see: matrices, counts and figures through the public interface.

use lar_core::mapper::{
    Ball, Circle, Crown, Cylinder, Disk, Helicoid, Helix, HollowBall, HollowCylinder, MapError, Pizza, Ring,
    Rod, Sphere, Toroidal, Torus, cuboid,
};
use lar_core::{
    ChainComplex, Model, cuboid_grid, extrude_simplicial, grid_1d, product, simplex, simplex_grid,
    triangular_prism,
};
use std::fmt::Write as _;

/// One line for each column of an operator: its entries as signed row numbers.
fn operator(complex: &ChainComplex, p: usize) -> String {
    let columns = complex.boundary(p).outer_iterator().map(|column| {
        let entries: Vec<String> =
            column.iter().map(|(row, &sign)| format!("{}{row}", if sign < 0 { '-' } else { '+' })).collect();
        entries.join(" ")
    });
    columns.collect::<Vec<_>>().join("\n")
}

#[test]
fn boundary_operators_of_the_cube() {
    let complex = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).expect("a cube");
    let text: String = (1..=3).map(|p| format!("boundary {p}\n{}\n", operator(&complex, p))).collect();
    insta::assert_snapshot!(text);
}

#[test]
fn relations_of_the_cube() {
    let complex = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).expect("a cube");
    let mut text = String::new();
    for (p, q, name) in
        [(0, 0, "VV"), (0, 1, "VE"), (0, 2, "VF"), (1, 1, "EE"), (1, 2, "EF"), (2, 2, "FF"), (3, 2, "CF")]
    {
        writeln!(text, "{name}").expect("strings take everything");
        for cells in complex.relation(p, q).iter() {
            writeln!(text, "  {cells:?}").expect("strings take everything");
        }
    }
    insta::assert_snapshot!(text);
}

fn counts(name: &str, model: &Model) -> String {
    let (lo, hi) = model.points().bounds().expect("models have points");
    let rounded = |x: Vec<f64>| x.iter().map(|x| format!("{:.6}", x + 0.0)).collect::<Vec<_>>().join(" ");
    format!("{name}: {:?}, box {} to {}\n", model.f_vector(), rounded(lo), rounded(hi))
}

#[test]
fn generators() {
    let base = simplex_grid(&[2, 2]).expect("a small grid");
    let with_gaps = grid_1d(&[1.0, -1.0, 2.0]).expect("finite steps");
    let text = [
        counts("cuboid_grid 3 2 1", &cuboid_grid(&[3, 2, 1])),
        counts("cuboid_grid 1 1 1 1", &cuboid_grid(&[1, 1, 1, 1])),
        counts("simplex 4", &simplex(4)),
        counts("simplex_grid 2 3 4", &simplex_grid(&[2, 3, 4]).expect("a small grid")),
        counts("extrude_simplicial", &extrude_simplicial(&base, &[1.0, 2.0, -3.0]).expect("a small grid")),
        counts("grid_1d with a gap", &with_gaps),
        counts("product", &product(&with_gaps, &cuboid_grid(&[2, 2])).expect("small factors")),
        counts("prism", &triangular_prism()),
    ]
    .concat();
    insta::assert_snapshot!(text);
}

#[test]
fn mapper_gallery() -> Result<(), MapError> {
    let shapes: [(&str, Model); 16] = [
        ("circle", Circle::default().model()?),
        ("helix", Helix::default().model()?),
        ("disk", Disk::default().model()?),
        ("helicoid", Helicoid::default().model()?),
        ("ring", Ring::default().model()?),
        ("cylinder", Cylinder::default().model()?),
        ("sphere", Sphere::default().model()?),
        ("toroidal", Toroidal::default().model()?),
        ("crown", Crown::default().model()?),
        ("cuboid", cuboid(&[0.0; 3], &[1.0, 2.0, 3.0])?),
        ("ball", Ball::default().model()?),
        ("rod", Rod::default().model()?),
        ("hollow cylinder", HollowCylinder::default().model()?),
        ("hollow ball", HollowBall::default().model()?),
        ("torus", Torus::default().model()?),
        ("pizza", Pizza::default().model()?),
    ];
    insta::assert_snapshot!(shapes.iter().map(|(name, model)| counts(name, model)).collect::<String>());
    Ok(())
}

#[test]
fn mass_properties_of_the_cells_of_a_grid() {
    let complex = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).expect("two cubes");
    let mut text = String::new();
    for (cell, mass) in complex.mass_properties(3).expect("a valid complex").iter().enumerate() {
        let centroid = mass.centroid().expect("mass");
        writeln!(
            text,
            "cell {cell}: mass {:.9}, centroid {centroid:.9?}, first {:.9?}, second {:.9?}, products {:.9?}",
            mass.mass(),
            mass.first_moments(),
            mass.second_moments(),
            mass.inertia_products()
        )
        .expect("strings take everything");
    }
    let betti = complex.betti_numbers().expect("a valid complex");
    writeln!(text, "Betti numbers {betti:?}, Euler characteristic {}", complex.euler_characteristic())
        .expect("strings take everything");
    insta::assert_snapshot!(text);
}
