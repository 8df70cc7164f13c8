//! Model types of the Linear Algebraic Representation (LAR).
//!
//! A *model* is a set of points plus cells of dimension 0..d; a *chain complex* is the list of its sparse
//! boundary operators ∂p : Cp → Cp−1 with entries −1, 0, +1. Every other crate of the workspace meets in
//! these types and in nothing else.
//!
//! * Build: [`cuboid_grid`], [`simplex_grid`], [`product`], [`simplex`], the shapes of [`mapper`]; read with
//!   [`read_surface`]; place with [`t`], [`s`], [`r`] inside a [`Struct`].
//! * Arrange: [`Model::to_surface`] turns a placed model into the [`Surface`] that an arrangement takes.
//! * Ask: a [`ChainComplex`] holds the operators; [`Chain`]s are what they act on.
//! * Locate: [`locate_in_polygon`], [`SolidLocator`].
//! * Keep: [`ChainComplex::to_json`], [`Struct::to_json`], [`write_mesh`], [`write_gltf`],
//!   [`ChainComplex::to_svg`], all through [`atomic_write()`].
//!
//! Broken input is data: `validate` methods list every violation. Functions that can refuse return an error
//! that names the cells and values concerned. Nothing here prints.
//!
//! ```
//! use lar_core::{ChainComplex, Struct, cuboid_grid, r, t};
//! let cube = cuboid_grid(&[1, 1, 1]);
//! let (by, turn) = (t(&[2., 0., 0.]), r([0.1, 0., 0.]));
//! let scene = Struct::new("scene").with(cube.clone()).with(by).with(turn).with(cube);
//! let complex = ChainComplex::from_model(&scene.struct2lar()?)?;
//! assert_eq!(complex.f_vector(), [16, 24, 12, 2]);
//! assert_eq!(complex.connected_components().n, 2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod affine;
mod atomic_write;
mod boundary_cells;
mod cells;
mod chain;
mod complex;
mod conversions;
mod embed;
mod exterior;
mod face_edges;
mod face_loops;
mod files;
mod from_model;
mod generators;
mod graph;
mod grid;
mod grid_1d;
mod homology;
mod ids;
mod incidence;
mod integrate;
mod json;
mod listing;
mod locate;
pub mod mapper;
mod measure;
mod merge;
mod mesh;
mod model;
mod model_faces;
mod model_json;
mod multi_index;
mod obj;
mod orbits;
mod orient;
mod points;
mod product;
mod relations;
mod simplex_facets;
mod simplicial;
mod structure;
mod surface;
mod surface_check;
mod svg;
mod temporary;
mod topology;
mod triangulated;
mod validate;

/// Dense matrices, in signatures of this crate.
pub use nalgebra;
/// JSON; its errors are inside [`JsonError`] and [`ModelJsonError`].
pub use serde_json;
/// Sparse matrices: [`Operator`] is one.
pub use sprs;

pub use affine::{Affine, AffineError, RotationVector, r, rotation, s, t};
pub use atomic_write::{FileError, atomic_write};
pub use cells::Cells;
pub use chain::{Chain, ChainError};
pub use complex::{ChainComplex, Operator};
pub use files::{
    GltfNode, MeshFileError, MeshFormat, Place, PolygonMesh, Precision, Problem, SurfaceFile, Weld,
    parse_segments, parse_surface, read_segments, read_surface, to_glb, to_gltf, write_gltf, write_mesh,
};
pub use generators::{icosphere, simplex, triangular_prism};
pub use graph::{Biconnected, DepthFirst, Graph, GraphError};
pub use grid::{cuboid_grid, grid_points, grid_skeleton};
pub use grid_1d::{GridError, grid_0, grid_1, grid_1d, grid_1d_repeated};
pub use homology::HomologyError;
pub use ids::{CellId, EdgeId, FaceId, VertexId};
pub use incidence::{cells_of_matrix, characteristic_matrix, shared_vertices};
pub use integrate::{IntegrationError, MAX_DEGREE, MassProperties, PrincipalAxes, triangle_moment};
pub use json::{ExactPoints, JsonError};
pub use locate::{LocateError, Location, SolidLocator, locate_in_polygon};
pub use mesh::TriangleMesh;
pub use model::{Model, ModelViolation};
pub use model_faces::ModelError;
pub use model_json::ModelJsonError;
pub use multi_index::{masks_of_order, row_major_index};
pub use obj::{ObjError, ObjGrouping, parse_obj, read_obj};
pub use orbits::{PermutationError, permutation_orbits};
pub use points::Points;
pub use product::{ProductError, product, product_all, product_cells, product_points};
pub use relations::Incidence;
pub use simplex_facets::{orient_simplices, simplex_boundary, simplex_facets, simplicial_boundary};
pub use simplicial::{
    SimplexError, extrude_simplicial, quads_to_triangles, simplex_grid, simplicial_complex,
};
pub use structure::{Corners, Instance, Node, PlacedModel, Struct, StructError, Visit};
pub use surface::Surface;
pub use surface_check::{BoundaryEdge, SurfaceViolation};
pub use svg::{Drawing, NamedShapes, Polyline, SvgError, SvgStyle, SvgWriter};
#[cfg(feature = "svg")]
pub use svg::{parse_svg, read_svg};
pub use temporary::{NoTemporaries, Temporary, remove_temporaries};
pub use topology::{CellComponents, Components};
pub use validate::Violation;
