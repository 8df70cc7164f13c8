//! Gift wrapping of one cell, step by step (Paoluzzi et al. 2019, Figure 2).

use crate::CellRef;
use lar_core::Chain;

/// One step of gift wrapping, as chains: what is wrapped so far, its boundary, and the corolla that comes next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrapStep {
    /// The 2-chain so far.
    pub chain: Chain,
    /// Its boundary, a 1-chain; zero when the cell is closed.
    pub boundary: Chain,
    /// The faces that the next step adds, one for each boundary edge.
    pub corolla: Chain,
}

/// A replay, and where it stands. Each step but the last has two pictures: the chain with its boundary, then the corolla
/// beside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replay {
    cell: CellRef,
    steps: Vec<WrapStep>,
    picture: usize,
}

impl Replay {
    /// The replay of a cell, at its beginning; `None` without steps.
    #[must_use]
    pub fn new(cell: CellRef, steps: Vec<WrapStep>) -> Option<Self> {
        (!steps.is_empty()).then_some(Self { cell, steps, picture: 0 })
    }

    /// The cell that is wrapped.
    #[must_use]
    pub fn cell(&self) -> CellRef {
        self.cell
    }

    /// The step that is shown.
    #[must_use]
    pub fn step(&self) -> &WrapStep {
        &self.steps[self.picture / 2]
    }

    /// Whether the corolla is shown.
    #[must_use]
    pub fn shows_corolla(&self) -> bool {
        self.picture % 2 == 1
    }

    /// Number of the picture, from 0.
    #[must_use]
    pub fn picture(&self) -> usize {
        self.picture
    }

    /// Number of pictures.
    #[must_use]
    pub fn n_pictures(&self) -> usize {
        2 * self.steps.len() - 1
    }

    /// Goes to a picture; the last one when there are not so many.
    pub fn go_to(&mut self, picture: usize) {
        self.picture = picture.min(self.n_pictures() - 1);
    }

    /// What is seen, in words.
    #[must_use]
    pub fn caption(&self) -> String {
        let step = self.step();
        let faces = step.chain.entries().len();
        let letter = char::from(b'a' + (self.picture % 26) as u8);
        let n = self.picture / 2;
        if self.shows_corolla() {
            format!("({letter}) corolla: {} faces around the boundary of c", step.corolla.entries().len())
        } else if step.boundary.is_zero() {
            format!("({letter}) value {n} of c: {faces} faces, ∂c = 0, closed")
        } else {
            format!(
                "({letter}) value {n} of c: {faces} faces, ∂c has {} edges",
                step.boundary.entries().len()
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_alternate_between_chain_and_corolla() {
        let chain = |dim, cells: &[u32]| Chain::new(dim, 6, cells.iter().map(|&c| (c, 1))).unwrap();
        let steps = vec![
            WrapStep { chain: chain(2, &[0]), boundary: chain(1, &[0, 1, 2]), corolla: chain(2, &[1, 2, 3]) },
            WrapStep { chain: chain(2, &[0, 1, 2, 3]), boundary: chain(1, &[]), corolla: chain(2, &[]) },
        ];
        let cell = CellRef { dim: 3, index: 1 };
        assert_eq!(Replay::new(cell, vec![]), None);
        let mut replay = Replay::new(cell, steps).unwrap();
        let mut captions = Vec::new();
        for picture in 0..replay.n_pictures() {
            replay.go_to(picture);
            captions.push(replay.caption());
        }
        assert_eq!(
            captions,
            [
                "(a) value 0 of c: 1 faces, ∂c has 3 edges",
                "(b) corolla: 3 faces around the boundary of c",
                "(c) value 1 of c: 4 faces, ∂c = 0, closed",
            ]
        );
        replay.go_to(99);
        assert_eq!((replay.picture(), replay.shows_corolla()), (2, false));
    }
}
