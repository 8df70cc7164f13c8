//! The panels around the picture. Each reads a session and answers with commands.

mod algebra;
mod explode;
mod help;
mod inspector;
mod section;
mod show;
mod toolbar;
mod tree;

pub(crate) use algebra::algebra;
pub(crate) use explode::{explode, explode_plain};
pub(crate) use help::help;
pub(crate) use inspector::inspector;
pub(crate) use section::section;
pub(crate) use show::{show, show_plain, solids};
pub(crate) use toolbar::{Capture, Tools, toolbar};
pub(crate) use tree::tree;

/// Texts that are being written, and what was said to them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Texts {
    pub(crate) search: String,
    pub(crate) search_error: Option<String>,
    pub(crate) expression: String,
    pub(crate) expression_result: Option<Result<String, String>>,
}
