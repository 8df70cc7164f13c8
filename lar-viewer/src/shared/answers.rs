//! Answers that an arrangement gave, for places where the arrangement itself is not.

use crate::session::{NOT_WRAPPED, WrapStep};
use crate::{CellData, CellRef};
use lar_core::Chain;

/// The gift wrapping of a cell: for each of its shells, one after the other, what each step adds to the chain.
pub type Wrapping = Vec<Vec<Vec<(u32, i32)>>>;

/// What an arrangement knows beyond its complex, written down: why solids cannot be operands, and how cells were wrapped.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Answers {
    /// For each solid why it cannot be the operand of a Boolean, if it cannot; empty where all can.
    pub refusals: Vec<Option<String>>,
    /// For each cell of the highest dimension how it was wrapped, empty where that is not written down; no entries where
    /// nothing was wrapped. What all steps of all cells add are the entries of ∂3.
    pub wrappings: Vec<Wrapping>,
}

impl Answers {
    /// The steps of gift wrapping one cell, written down. O(faces in all chains).
    #[must_use]
    pub fn recorded(steps: &[WrapStep]) -> Wrapping {
        let mut shells = vec![Vec::new()];
        let mut before: &[(u32, i32)] = &[];
        for step in steps {
            let now = step.chain.entries();
            shells.last_mut().into_iter().for_each(|shell| shell.push(difference(now, before)));
            if step.corolla.is_zero() {
                shells.push(Vec::new());
            }
            before = now;
        }
        shells.retain(|shell| !shell.is_empty());
        shells
    }

    /// The cells of the highest dimension where an expression over the solids holds: `holds` is given, for each cell,
    /// which solids it is inside of. O(cells · length of the expression).
    ///
    /// # Errors
    /// Why one of the operands is none, in words.
    pub fn cells_where(
        &self,
        data: &CellData,
        operands: &[usize],
        holds: impl Fn(&dyn Fn(usize) -> bool) -> bool,
    ) -> Result<Chain, String> {
        if let Some(refused) = operands.iter().find_map(|&solid| self.refusals.get(solid)?.as_ref()) {
            return Err(refused.clone());
        }
        let n_cells = data.n_cells(data.dim());
        let inside = (0..n_cells as u32).filter(|&index| {
            let solids = data.solids_of(CellRef { dim: data.dim(), index });
            holds(&|solid| u32::try_from(solid).is_ok_and(|solid| solids.contains(&solid)))
        });
        Chain::new(usize::from(data.dim()), n_cells, inside.map(|cell| (cell, 1))).map_err(|e| e.to_string())
    }

    /// The steps of gift wrapping a cell of the highest dimension. O(faces in all chains).
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn wrapping(&self, data: &CellData, cell: u32) -> Result<Vec<WrapStep>, String> {
        if self.wrappings.is_empty() {
            return Err(NOT_WRAPPED.to_owned());
        }
        let shells = self.wrappings.get(cell as usize).filter(|shells| !shells.is_empty());
        let shells =
            shells.ok_or_else(|| format!("the gift wrapping of c{cell} is not written down here"))?;
        let chain =
            |terms: &[(u32, i32)]| data.complex().chain(2, terms.iter().copied()).map_err(|e| e.to_string());
        let (mut wrapped, mut steps) = (Vec::new(), Vec::new());
        for shell in shells {
            for (i, added) in shell.iter().enumerate() {
                wrapped.extend(added);
                let all = chain(&wrapped)?;
                let boundary = data.boundary_of(&all).map_err(|e| e.to_string())?;
                let corolla = chain(shell.get(i + 1).map_or(&[][..], Vec::as_slice))?;
                steps.push(WrapStep { chain: all, boundary, corolla });
            }
        }
        Ok(steps)
    }
}

/// The terms of `now` − `before`; both are in rising order.
fn difference(now: &[(u32, i32)], before: &[(u32, i32)]) -> Vec<(u32, i32)> {
    let of = |chain: &[(u32, i32)], face: u32| {
        chain.binary_search_by_key(&face, |entry| entry.0).map_or(0, |at| chain[at].1)
    };
    let grown = now.iter().map(|&(face, factor)| (face, factor - of(before, face)));
    let gone = before.iter().filter(|&&(face, _)| of(now, face) == 0).map(|&(face, factor)| (face, -factor));
    let mut terms: Vec<(u32, i32)> = grown.chain(gone).filter(|term| term.1 != 0).collect();
    terms.sort_unstable();
    terms
}
