//! What a chain complex alone does not tell.

use super::WrapStep;
use lar_core::Chain;

/// What is said of a complex whose cells were not wrapped.
pub(crate) const NOT_WRAPPED: &str = "this complex was not made by gift wrapping";

/// Questions that a chain complex alone does not answer.
pub trait Queries: Send {
    /// The cells of the highest dimension where a Boolean expression over the solids holds.
    ///
    /// # Errors
    /// What is wrong with the expression, in words.
    fn boolean(&self, expression: &str) -> Result<Chain, String>;

    /// The steps of gift wrapping a cell of the highest dimension.
    ///
    /// # Errors
    /// Why there are none, in words.
    fn wrapping(&self, cell: u32) -> Result<Vec<WrapStep>, String>;
}

/// No answers: for complexes that come from no arrangement.
#[derive(Clone, Copy, Debug)]
pub struct NoQueries;

impl Queries for NoQueries {
    fn boolean(&self, _: &str) -> Result<Chain, String> {
        Err("this complex has no solids to combine".to_owned())
    }

    fn wrapping(&self, _: u32) -> Result<Vec<WrapStep>, String> {
        Err(NOT_WRAPPED.to_owned())
    }
}
