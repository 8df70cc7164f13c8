//! Example scenes, the figures drawn from them, and the programs: `lar`, `three_cubes`, `figure1` … `figure5`,
//! `floor_plan`, and `figures`, which makes all figures.
//!
//! The programs are functions of this library with thin mains, so that tests and other programs call the same
//! code: [`command::run`] is `lar`, [`three_cubes::run`] is `three_cubes`, [`plane`] has those of the plane, `figures`
//! (with the feature `viewer`) the others. None prints except to the writers that it is given.
//!
//! ```
//! use lar_examples::scenes;
//! let surfaces = scenes::surfaces(&scenes::three_cubes())?;
//! let arrangement = lar_arrangement::arrange(&surfaces)?;
//! assert_eq!(arrangement.complex().f_vector(), [49, 88, 47, 8]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Features: `viewer` (default) draws pictures off-screen, `window` (default) opens windows. Without them no graphics
//! crate is built, and the commands that need one say so.

mod bar;
pub mod checks;
pub mod command;
mod error;
#[cfg(feature = "viewer")]
#[cfg_attr(not(feature = "window"), allow(dead_code, reason = "much of it only windows ask"))]
mod exploration;
#[cfg(feature = "viewer")]
pub mod figures;
#[cfg(doctest)]
mod guide;
mod mesh;
mod output;
#[cfg(feature = "viewer")]
mod page;
pub mod plane;
#[cfg(feature = "viewer")]
pub mod primitives;
mod program;
mod random;
pub mod scenes;
#[cfg(feature = "viewer")]
mod shapes;
mod size;
pub mod tables;
pub mod three_cubes;

pub use error::CommandError;
pub use program::main;
