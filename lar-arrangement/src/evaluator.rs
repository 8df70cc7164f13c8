//! Stage 6: Booleans with options, under the eyes of a report and a request to stop.

use crate::arrangement::Arrangement;
use crate::boolean::{BooleanError, FillRule, Solid};
use crate::expression::Expression;
use crate::progress::{Cancel, Control, Course, Plan, Progress};
use crate::simplify::{self, Detail};
use crate::solid_complex::SolidComplex;
use crate::stats::Stats;

/// The only stage of an expression.
const CELLS: &Plan = &[("cells", 100)];

/// Options for Booleans: what is inside, how much of the arrangement a surface shows, who is told and who may stop it.
///
/// [`Arrangement::boolean`] and [`Solid::to_complex`] are the same without reports.
///
/// ```
/// use lar_arrangement::{arrange, BooleanError, Cancel, Evaluator, Expression};
/// use lar_core::{cuboid_grid, t, Struct};
/// let cube = cuboid_grid(&[1, 1, 1]);
/// let scene = Struct::new("two cubes").with(cube.clone()).with(t(&[0.5, 0.5, 0.5])).with(cube);
/// let surfaces: Vec<_> = scene.eval_struct()?.iter().map(|m| m.to_surface()).collect::<Result<_, _>>()?;
/// let (arrangement, union) = (arrange(&surfaces)?, Expression::parse("A | B", &["A", "B"])?);
/// let cancel = Cancel::new();
/// let evaluator = Evaluator::new().cancel(&cancel);
/// let solid = evaluator.solid(&arrangement, &union)?;
/// assert_eq!(evaluator.surface(&solid)?.n_faces(), 12);
/// cancel.request();
/// assert_eq!(evaluator.surface(&solid).unwrap_err(), BooleanError::Cancelled);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Evaluator<'a> {
    fill: FillRule,
    detail: Detail,
    control: Control<'a>,
}

impl<'a> Evaluator<'a> {
    /// The default options: inside is where the winding number is not zero, surfaces are simplified.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// What winding number means inside.
    #[must_use]
    pub fn fill(mut self, rule: FillRule) -> Self {
        self.fill = rule;
        self
    }

    /// How much of the arrangement a surface shows.
    #[must_use]
    pub fn detail(mut self, detail: Detail) -> Self {
        self.detail = detail;
        self
    }

    /// Calls `report` as the work goes on, from the caller's thread: for each solid and for each surface from 0 to 1.
    /// The result does not depend on it.
    #[must_use]
    pub fn progress(mut self, report: &'a (dyn Fn(Progress) + Sync)) -> Self {
        self.control.report = Some(report);
        self
    }

    /// Gives up with [`BooleanError::Cancelled`] soon after `cancel` is asked for.
    #[must_use]
    pub fn cancel(mut self, cancel: &'a Cancel) -> Self {
        self.control.cancel = Some(cancel);
        self
    }

    /// The cells where an expression holds. O(cells / 64 · length of the expression + solids around all cells).
    ///
    /// # Errors
    /// An operand of the expression that is open, or not oriented with a rule that needs it, or does not exist; when the
    /// work was cancelled.
    pub fn solid<'b>(
        &self,
        arrangement: &'b Arrangement,
        expression: &Expression,
    ) -> Result<Solid<'b>, BooleanError> {
        let (course, mut times) = (Course::new(self.control, CELLS), Stats::default());
        let solid = arrangement.solid_where(expression, self.fill, &course, &mut times)?;
        course.finish(&mut times);
        course.go_on()?;
        Ok(solid)
    }

    /// The surface of a solid as a 2-complex. O(size of the surface) expected, with O(size of the arrangement) memory.
    ///
    /// # Errors
    /// When the work was cancelled.
    pub fn surface(&self, solid: &Solid<'_>) -> Result<SolidComplex, BooleanError> {
        let (course, mut times) = (Course::new(self.control, simplify::PLAN), Stats::default());
        let surface = simplify::surface(solid, self.detail, &course, &mut times)?;
        course.finish(&mut times);
        Ok(surface)
    }
}
