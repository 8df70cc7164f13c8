//! One Boolean without the arrangement: stages 1 to 4 where its surface can be, then the faces that are of it.

use crate::arrangement::Arrangement;
use crate::assemble::{Operators, Shells, assemble};
use crate::boolean::{BooleanError, FillRule};
use crate::circuit::Circuit;
use crate::error::ArrangementError;
use crate::expression::Expression;
use crate::fragment::Extent;
use crate::live::Live;
use crate::meeting::Meeting;
use crate::pipeline::Arranger;
use crate::progress::{Course, Plan};
use crate::rays::Rays;
use crate::simplify::{self, Detail};
use crate::solid_complex::SolidComplex;
use crate::soup::Soup;
use crate::stats::Stats;
use crate::visible;
use lar_core::{CellId, Surface};

#[cfg(test)]
mod tests;

/// The stages, and their usual shares in the time; without a share those of an arrangement with all cells.
const PLAN: &Plan = &[
    ("soup", 8),
    ("pairs", 16),
    ("planes", 24),
    ("live boxes", 6),
    ("contacts", 14),
    ("fragmentation", 8),
    ("congruence", 6),
    ("gift wrapping", 3),
    ("nesting", 0),
    ("membership", 0),
    ("visibility", 4),
    ("complex", 4),
    ("cells", 0),
    ("surface", 3),
    ("coplanar faces", 2),
    ("straight edges", 1),
    ("loops", 1),
];

/// The cell that is the result of a Boolean, where there is only one other.
const RESULT: CellId = CellId(1);

/// Space is divided into live and dead boxes when the boxes of so many pairs of facets meet, for each facet: below that cutting
/// everything takes no longer.
const PAIRS_WORTH_DIVIDING: usize = 48;

/// What is asked for.
#[derive(Clone, Copy)]
struct Question<'a> {
    expression: &'a Expression,
    rule: FillRule,
    detail: Detail,
    /// So many pairs a facet are cut everywhere.
    pairs_a_facet: usize,
}

impl Arranger<'_> {
    /// The surface of one Boolean, without the cells of the arrangement: the same as that of
    /// [`Evaluator::surface`](crate::Evaluator::surface) for the arrangement of the surfaces, and what it cost. Where many
    /// solids overlap this takes a fraction of the time: parts of facets where the expression is decided by solids whose
    /// surfaces are elsewhere are not cut. Where few overlap, or an operand is not closed edge by edge, all cells are
    /// computed all the same.
    /// O((n + k + m) log) time for n facets, k pairs of facets that meet and m pieces out of the k near the result.
    ///
    /// ```
    /// use lar_arrangement::{Arranger, Detail, Expression, FillRule};
    /// use lar_core::{cuboid_grid, t, Struct};
    /// let cube = cuboid_grid(&[1, 1, 1]);
    /// let scene = Struct::new("two cubes").with(cube.clone()).with(t(&[0.5, 0.5, 0.5])).with(cube);
    /// let surfaces: Vec<_> = scene.eval_struct()?.iter().map(|m| m.to_surface()).collect::<Result<_, _>>()?;
    /// let union = Expression::union_of(2);
    /// let (surface, _) = Arranger::new().boolean(&surfaces, &union, FillRule::NonZero, Detail::Simplified)?;
    /// assert_eq!((surface.n_faces(), surface.is_closed()), (12, true));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`arrange`](Self::arrange), and of [`Arrangement::boolean`].
    pub fn boolean(
        &self,
        surfaces: &[Surface],
        expression: &Expression,
        rule: FillRule,
        detail: Detail,
    ) -> Result<(SolidComplex, Stats), BooleanError> {
        let pairs_a_facet = PAIRS_WORTH_DIVIDING;
        self.solid_surface(surfaces, Question { expression, rule, detail, pairs_a_facet })
    }

    fn solid_surface(
        &self,
        surfaces: &[Surface],
        question: Question<'_>,
    ) -> Result<(SolidComplex, Stats), BooleanError> {
        let Question { expression, rule, detail, pairs_a_facet } = question;
        let operands = expression.operands();
        if let Some(&solid) = operands.iter().find(|&&solid| solid >= surfaces.len()) {
            return Err(BooleanError::NoSuchSolid { solid, n_solids: surfaces.len() });
        }
        self.with_pairs(surfaces, PLAN, |soup, meeting, stats, course| {
            let is_direct =
                meeting.pairs.len() > pairs_a_facet * soup.n_facets() && soup.are_cycles(&operands);
            let mut arrangement = if is_direct {
                self.result_alone(surfaces, soup, meeting, question, (stats, course))?
            } else {
                self.arranged(surfaces, soup, meeting, Operators::Edges, (stats, course))?
            };
            let mut stats = std::mem::take(&mut arrangement.stats);
            let solid = if is_direct {
                arrangement.union_of_cells([RESULT])
            } else {
                arrangement.solid_where(expression, rule, course, &mut stats)?
            };
            let mut surface = simplify::surface(&solid, detail, course, &mut stats)?;
            // The arrangement is not the caller's.
            surface.pieces = Vec::new();
            course.finish(&mut stats);
            Ok((surface, stats))
        })
    }

    /// An arrangement of two cells: the result, and everything else. Faces that are not between the two have the latter on
    /// both sides, and may cross each other.
    fn result_alone(
        &self,
        surfaces: &[Surface],
        mut soup: Soup,
        mut meeting: Meeting,
        Question { expression, rule, .. }: Question<'_>,
        (mut stats, course): (Stats, &Course),
    ) -> Result<Arrangement, ArrangementError> {
        course.begin("live boxes", &mut stats)?;
        let circuit = Circuit::new(expression, surfaces.len());
        let live =
            Live::new(&soup, (meeting.boxes(&soup).tree(), &meeting.pairs), circuit.clone(), rule, course)?;
        meeting.pairs.retain(|&pair| live.share(pair));
        let (mut skeleton, rings) =
            self.skeleton(&mut soup, (&meeting.pairs, Extent::NearResult), &mut stats, course)?;
        course.begin("visibility", &mut stats)?;
        let rays = Rays {
            skeleton: &skeleton,
            geometry: &soup.geometry,
            rings: &rings,
            boxes: meeting.boxes(&soup),
        };
        let is_inside = visible::sides_of_result(&rays, &soup, &live, (circuit, rule), course)?;
        let dissolved = self.dissolved(&mut skeleton, rings, &soup);
        let cell_of_side: Vec<u32> = is_inside.into_iter().map(u32::from).collect();
        let shells = Shells { of_side: &cell_of_side, n: 2, cell_of: &[0, RESULT.0], n_cells: 2 };
        Ok(assemble(surfaces, soup, skeleton, dissolved, &shells, Operators::Edges, (stats, course))?)
    }
}
