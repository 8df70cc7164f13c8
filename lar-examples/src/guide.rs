//! The programs in the README and in the guide are compiled and run with the tests.

macro_rules! pages {
    ($($name:ident $path:literal)*) => { $(#[doc = include_str!(concat!("../../", $path))] struct $name;)* };
}

pages! {
    Readme "README.md"
    Introduction "docs/guide/introduction.md"
    Tutorial "docs/guide/tutorial.md"
    Theory "docs/guide/theory.md"
    Exactness "docs/guide/exactness.md"
    Clean "docs/guide/clean.md"
    FloorPlan "docs/guide/floor-plan.md"
    Regions "docs/guide/regions.md"
    Mass "docs/guide/mass.md"
    Drawing "docs/guide/drawing.md"
    Interoperability "docs/guide/interoperability.md"
    FromJulia "docs/guide/from-julia.md"
    FromCgal "docs/guide/from-cgal.md"
    FromManifold "docs/guide/from-manifold.md"
    Files "docs/guide/files.md"
}
