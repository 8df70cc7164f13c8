//! The programs in the README, in the guide and on the pages of the figures are compiled and run with the tests.

macro_rules! pages {
    ($($name:ident $path:literal)*) => { $(#[doc = include_str!(concat!("../../", $path))] struct $name;)* };
}

pages! {
    Readme "README.md"
    Introduction "docs/README.md"
    Tutorial "docs/guide/tutorial.md"
    Theory "docs/guide/theory.md"
    Exactness "docs/guide/exactness.md"
    Convert "docs/guide/convert.md"
    Several "docs/guide/several.md"
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

#[cfg(feature = "viewer")]
pages! {
    Figures "docs/figures/README.md"
    Figure1 "docs/figures/figure1.md"
    Figure2 "docs/figures/figure2.md"
    Figure3 "docs/figures/figure3.md"
    Figure4 "docs/figures/figure4.md"
    Figure5 "docs/figures/figure5.md"
    Figure6 "docs/figures/figure6.md"
    Refectory "docs/figures/refectory.md"
    CubeGrids "docs/figures/cube_grids.md"
    NumberedGrid "docs/figures/numbered_grid.md"
    Mapper "docs/figures/mapper.md"
    SimplicialGrids "docs/figures/simplicial_grids.md"
    FloorPlanFigure "docs/figures/floor_plan.md"
    Products "docs/figures/products.md"
    Rods "docs/figures/rods.md"
}
