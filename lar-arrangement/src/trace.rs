//! Topological gift wrapping, step by step, for one cell: the form in which the papers tell it (Paoluzzi 2019,
//! §3.1 and Figure 2). The pipeline itself uses the linear form of stage 4; both give the same shells.

use crate::arrangement::Arrangement;
use lar_core::FaceId;

/// A side of a face: the one its normal points to, or the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FaceSide {
    /// The face.
    pub face: FaceId,
    /// Whether it is the side from which the normal points away.
    pub back: bool,
}

impl FaceSide {
    fn code(self) -> u32 {
        2 * self.face.0 + u32::from(self.back)
    }

    fn from_code(code: u32) -> Self {
        Self { face: FaceId(code / 2), back: code % 2 == 1 }
    }
}

/// One step: the chain so far, its boundary, and the corolla, the faces that the next step adds, one for each
/// boundary edge: the first face met when turning about the edge from the chain's side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrapStep {
    /// Faces of the chain with their signs in the cell's column of ∂3.
    pub chain: Vec<(FaceId, i8)>,
    /// Edges of the chain's boundary with their signs; empty in the last step.
    pub boundary: Vec<(lar_core::EdgeId, i8)>,
    /// Sides of faces that are added next; empty in the last step.
    pub corolla: Vec<FaceSide>,
}

impl Arrangement {
    /// Wraps the shell that contains a side of a face. The last step's chain is the shell, its boundary is empty.
    /// O(steps · size of the shell).
    #[doc(alias = "minimal_3cycles")]
    #[must_use]
    pub fn wrap(&self, start: FaceSide) -> Vec<WrapStep> {
        let mut in_chain = vec![start.code()];
        let mut steps = Vec::new();
        loop {
            let corolla = self.corolla(&in_chain);
            let chain: Vec<(FaceId, i8)> = in_chain
                .iter()
                .map(|&c| FaceSide::from_code(c))
                // A cell lies in front of its faces with sign −1 and behind those with sign +1.
                .map(|side| (side.face, if side.back { 1 } else { -1 }))
                .collect();
            let boundary = self.chain_boundary(&chain);
            let done = corolla.is_empty();
            let sides = corolla.iter().map(|&c| FaceSide::from_code(c)).collect();
            steps.push(WrapStep { chain, boundary, corolla: sides });
            if done {
                return steps;
            }
            in_chain.extend(corolla);
            in_chain.sort_unstable();
        }
    }

    /// The sides next to those of the chain around their edges that are not in the chain yet.
    fn corolla(&self, in_chain: &[u32]) -> Vec<u32> {
        let mut next: Vec<u32> = in_chain
            .iter()
            .flat_map(|&side| {
                let face = FaceId(side / 2);
                self.face_loops(face).flatten().map(move |h| (side, h)).collect::<Vec<_>>()
            })
            .map(|(side, h)| {
                let ring = &self.rings[h.edge.index()];
                let entry = 2 * (side / 2) + u32::from(h.reversed);
                let at =
                    ring.iter().position(|&e| e == entry).expect("faces stand in the rings of their edges");
                // The entry's own code is the side that comes next, counter-clockwise.
                if side == entry {
                    ring[(at + 1) % ring.len()] ^ 1
                } else {
                    ring[(at + ring.len() - 1) % ring.len()]
                }
            })
            .filter(|side| in_chain.binary_search(side).is_err())
            .collect();
        next.sort_unstable();
        next.dedup();
        next
    }

    fn chain_boundary(&self, chain: &[(FaceId, i8)]) -> Vec<(lar_core::EdgeId, i8)> {
        let mut sums: Vec<(lar_core::EdgeId, i8)> = chain
            .iter()
            .flat_map(|&(face, sign)| {
                self.face_loops(face)
                    .flatten()
                    .map(move |h| (h.edge, if h.reversed { -sign } else { sign }))
                    .collect::<Vec<_>>()
            })
            .collect();
        sums.sort_unstable();
        let mut out: Vec<(lar_core::EdgeId, i8)> = sums
            .chunk_by(|a, b| a.0 == b.0)
            .map(|same| (same[0].0, same.iter().map(|s| s.1).sum()))
            .collect();
        out.retain(|&(_, sum)| sum != 0);
        out
    }
}
