//! Stage 6, for one Boolean only: the faces of its surface, without the cells.
//!
//! Where only contacts near the surface were looked for (module `live`), faces far from it may cross each other, so there are
//! no cells. But a face with a point of the surface in its inside lies in live boxes as a whole, and all that is around its
//! edges was found. Hence a face belongs to the surface as a whole or not at all, and:
//!
//! * Two faces alone at an edge are both of the surface, or neither is. Faces joined in that way form a *patch*.
//! * From a patch of the surface winding numbers are right all around its edges; they settle the patches there.
//! * A ray from the middle of an edge through the whole input settles the patches around it: where winding numbers are
//!   not right the expression does not change, and neither is on the surface.
//!
//! So patches are settled from one to the next along the surface, and one ray is needed for each of its components and
//! for each patch that is not near it.

use crate::boolean::FillRule;
use crate::circuit::{Circuit, Value};
use crate::counting::sorted_by_place;
use crate::dissolve::crossed;
use crate::live::Live;
use crate::progress::{Cancelled, Course};
use crate::rays::Rays;
use crate::soup::Soup;
use crate::union_find::UnionFind;
use crate::wrap;

/// For each side of a face whether it looks at the result; for a face that is not of the surface, `false` on both.
pub(crate) fn sides_of_result(
    rays: &Rays<'_>,
    soup: &Soup,
    live: &Live,
    (circuit, rule): (Circuit, FillRule),
    course: &Course,
) -> Result<Vec<bool>, Cancelled> {
    let n_faces = rays.skeleton.n_faces();
    let patches = Patches::new(rays, n_faces);
    let mut search = Search {
        rays,
        soup,
        state: vec![State::Open; patches.n as usize],
        is_done: vec![false; rays.skeleton.edges.len()],
        waiting: Vec::new(),
        here: Place::outside(circuit, rule, soup.coefficients.len()),
        patches,
    };
    for face in 0..n_faces as u32 {
        if search.state[search.patches.of_face[face as usize] as usize] == State::Open {
            let at = |h: u32| rays.skeleton.vertices[rays.skeleton.ends(h)[0] as usize].at;
            // A corner where the expression does not change is not on the surface.
            if rays.skeleton.half_edges(face).any(|h| live.is_dead(at(h))) {
                continue;
            }
            course.go_on()?;
            search.shoot(face);
            search.spread();
        }
    }
    let looks_at_result = |(patch, side): (u32, &u32)| search.state[patch as usize] == State::Visible(*side);
    let patch_of_side = search.patches.of_face.iter().flat_map(|&patch| [patch; 2]);
    Ok(patch_of_side.zip(&search.patches.of_side).map(looks_at_result).collect())
}

/// Faces joined along edges that are theirs alone.
struct Patches {
    n: u32,
    of_face: Vec<u32>,
    /// The side of its patch that each side of a face is part of.
    of_side: Vec<u32>,
    /// The faces of each patch: those of patch p are `faces[offsets[p]..offsets[p + 1]]`.
    offsets: Vec<u32>,
    faces: Vec<u32>,
}

impl Patches {
    /// O(n α(n)).
    fn new(rays: &Rays<'_>, n_faces: usize) -> Self {
        let mut sides = UnionFind::new(2 * n_faces);
        for ring in rays.rings.iter() {
            if let &[a, b] = ring
                && a / 2 != b / 2
            {
                sides.union(a, b ^ 1);
                sides.union(b, a ^ 1);
            }
        }
        let (of_side, n_sides) = sides.labels();
        let (patch_of_side, n) = wrap::components(of_side.as_chunks::<2>().0.iter().copied(), n_sides);
        let of_face: Vec<u32> = of_side.iter().step_by(2).map(|&side| patch_of_side[side as usize]).collect();
        let all: Vec<u32> = (0..n_faces as u32).collect();
        let (offsets, faces) = sorted_by_place(n as usize, &all, |&f| of_face[f as usize] as usize);
        Self { n, of_face, of_side, offsets, faces }
    }

    fn faces(&self, patch: u32) -> &[u32] {
        &self.faces[self.offsets[patch as usize] as usize..self.offsets[patch as usize + 1] as usize]
    }
}

/// What is known of a patch.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Open,
    /// Not of the surface.
    Hidden,
    /// Of the surface; with the side of it that looks at the result.
    Visible(u32),
}

/// A patch of the surface whose edges have not been looked at.
struct Waiting {
    patch: u32,
    /// One of its sides.
    side: u32,
    /// Solids and their winding numbers there, where these are not zero.
    row: Vec<(u32, i32)>,
}

struct Search<'a> {
    rays: &'a Rays<'a>,
    soup: &'a Soup,
    patches: Patches,
    state: Vec<State>,
    /// Edges around which all is known.
    is_done: Vec<bool>,
    waiting: Vec<Waiting>,
    here: Place,
}

impl Search<'_> {
    /// Settles the patches around an edge of a face by a ray.
    fn shoot(&mut self, face: u32) {
        let Self { rays, soup, .. } = *self;
        let edge = rays.skeleton.half_edges(face).next().expect("faces have edges") / 2;
        let start = rays.start(edge);
        self.here.leave();
        for facet in rays.candidates(std::slice::from_ref(&start)).concat() {
            let ends = |&code: &u32| soup.directed(code).map(|p| soup.geometry.point_vertex(p));
            if rays.is_hit(facet, soup.facet_edges[facet as usize].iter().map(ends), &start) {
                let sign = if rays.leaves_in_front(facet) { 1 } else { -1 };
                soup.parents(facet).iter().for_each(|p| self.here.change(p.solid, sign * soup.jump(p)));
            }
        }
        let sector = rays.sector(edge);
        let at = rays.rings[edge as usize].iter().position(|&entry| entry == sector);
        self.turn(edge, at.expect("the sector is one of the edge"));
    }

    /// Settles the patches around the edges of those of the surface that wait.
    fn spread(&mut self) {
        let rays = self.rays;
        while let Some(Waiting { patch, side, row }) = self.waiting.pop() {
            for i in 0..self.patches.faces(patch).len() {
                let face = self.patches.faces(patch)[i];
                for edge in rays.skeleton.half_edges(face).map(|h| h / 2) {
                    let ring = &rays.rings[edge as usize];
                    if ring.len() <= 2 || self.is_done[edge as usize] {
                        continue;
                    }
                    let at =
                        ring.iter().position(|entry| entry / 2 == face).expect("the face is at its edge");
                    // The sector after an entry is on the side of its code, the one before on the other side.
                    let is_after = self.patches.of_side[ring[at] as usize] == side;
                    self.here.leave();
                    row.iter().for_each(|&(solid, winding)| self.here.change(solid, winding));
                    self.turn(edge, if is_after { at } else { (at + ring.len() - 1) % ring.len() });
                }
            }
        }
    }

    /// Goes once around an edge, from the sector after an entry of its ring, and settles the patches that are passed.
    fn turn(&mut self, edge: u32, from: usize) {
        let ring = &self.rays.rings[edge as usize];
        self.is_done[edge as usize] = true;
        for i in 1..=ring.len() {
            let entry = ring[(from + i) % ring.len()];
            let before = self.here.is_inside();
            let sign = if entry.is_multiple_of(2) { -1 } else { 1 };
            for (solid, jump) in crossed(entry / 2, self.rays.skeleton, self.soup) {
                self.here.change(solid, sign * jump);
            }
            self.settle(entry, [before, self.here.is_inside()]);
        }
    }

    /// Notes whether the expression holds before and behind a face that is passed towards a side of it.
    fn settle(&mut self, towards: u32, holds: [bool; 2]) {
        let patch = self.patches.of_face[(towards / 2) as usize];
        if self.state[patch as usize] != State::Open {
            return;
        }
        let [before, beyond] = [towards ^ 1, towards].map(|side| self.patches.of_side[side as usize]);
        self.state[patch as usize] = match holds {
            [false, true] => State::Visible(beyond),
            [true, false] => State::Visible(before),
            _ => State::Hidden,
        };
        if holds[0] != holds[1] {
            self.waiting.push(Waiting { patch, side: beyond, row: self.here.row() });
        }
    }
}

/// The winding numbers at a place, and the expression there.
struct Place {
    windings: Vec<i32>,
    /// The solids whose winding number was changed.
    touched: Vec<u32>,
    circuit: Circuit,
    rule: FillRule,
}

impl Place {
    fn outside(mut circuit: Circuit, rule: FillRule, n_solids: usize) -> Self {
        (0..n_solids as u32).for_each(|solid| circuit.set(solid, rule.is_inside(0).into()));
        Self { windings: vec![0; n_solids], touched: Vec::new(), circuit, rule }
    }

    /// Goes outside of all solids.
    fn leave(&mut self) {
        for solid in self.touched.drain(..) {
            if std::mem::take(&mut self.windings[solid as usize]) != 0 {
                self.circuit.set(solid, self.rule.is_inside(0).into());
            }
        }
    }

    /// Adds to the winding number of a solid.
    fn change(&mut self, solid: u32, by: i32) {
        let winding = &mut self.windings[solid as usize];
        *winding += by;
        self.circuit.set(solid, self.rule.is_inside(*winding).into());
        self.touched.push(solid);
    }

    fn is_inside(&self) -> bool {
        self.circuit.value() == Value::True
    }

    /// Solids and their winding numbers, where these are not zero.
    fn row(&self) -> Vec<(u32, i32)> {
        let mut solids = self.touched.clone();
        solids.sort_unstable();
        solids.dedup();
        let with_winding = |solid: u32| (solid, self.windings[solid as usize]);
        solids.into_iter().map(with_winding).filter(|&(_, winding)| winding != 0).collect()
    }
}
