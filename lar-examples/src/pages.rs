//! The programs on the pages of docs/figures are compiled and run with the tests.

macro_rules! pages {
    ($($name:ident $page:literal)*) => {
        $(#[doc = include_str!(concat!("../../docs/figures/", $page, ".md"))] struct $name;)*
    };
}

pages! {
    Index "README"
    Figure1 "figure1"
    Figure2 "figure2"
    Figure3 "figure3"
    Figure4 "figure4"
    Figure5 "figure5"
    Figure6 "figure6"
    Refectory "refectory"
    CubeGrids "cube_grids"
    NumberedGrid "numbered_grid"
    Mapper "mapper"
    SimplicialGrids "simplicial_grids"
    FloorPlan "floor_plan"
    Products "products"
    Rods "rods"
}
