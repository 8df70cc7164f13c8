//! Stage 6b: Boolean expressions. Every 3-cell has a bit for each solid; the expression is evaluated on the bits,
//! and the cells where it holds are a 3-chain whose boundary ∂3 · chain is the surface of the result.

use crate::arrangement::Arrangement;
use crate::error::ArrangementError;
use crate::evaluator::Evaluator;
use crate::expression::Expression;
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::stats::Stats;
use crate::winding::Closure;
use lar_core::{CellId, Chain, FaceId};

/// How a winding number makes a point inside or outside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FillRule {
    /// Inside where the winding number is odd.
    EvenOdd,
    /// Inside where it is not zero.
    #[default]
    NonZero,
    /// Inside where it is above zero: surfaces turned inside out bound nothing.
    Positive,
}

impl FillRule {
    /// Whether a winding number means inside.
    #[must_use]
    pub fn is_inside(self, winding: i32) -> bool {
        match self {
            FillRule::EvenOdd => winding % 2 != 0,
            FillRule::NonZero => winding != 0,
            FillRule::Positive => winding > 0,
        }
    }
}

/// Why a Boolean was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BooleanError {
    /// An operand that bounds nothing.
    #[error(
        "{solid}: the surface is open, it bounds no solid: {n_edges} boundary edges, one of them from ({}) to ({})",
        join(&.edge[0]), join(&.edge[1])
    )]
    Open {
        /// Name of the operand.
        solid: String,
        /// Number of boundary edges in the arrangement.
        n_edges: usize,
        /// Ends of one of them.
        edge: [[f64; 3]; 2],
    },
    /// A region of a drawing whose outline is open.
    #[error("{region}: the outline is open, it bounds no region")]
    OpenOutline {
        /// Name of the region.
        region: String,
    },
    /// An operand whose faces are not oriented consistently, with a fill rule that needs it.
    #[error(
        "{solid}: the boundary is not oriented consistently, only the even-odd fill rule can tell its inside"
    )]
    Unoriented {
        /// Name of the operand.
        solid: String,
    },
    /// An expression that names more solids than there are.
    #[error("the expression names solid number {solid}, there are {n_solids}")]
    NoSuchSolid {
        /// Number of the solid, from 0.
        solid: usize,
        /// How many there are.
        n_solids: usize,
    },
    /// Surfaces that cannot be arranged.
    #[error(transparent)]
    Arrangement(ArrangementError),
    /// It was asked to stop ([`Cancel`](crate::Cancel)).
    #[error("cancelled")]
    Cancelled,
}

impl From<ArrangementError> for BooleanError {
    fn from(error: ArrangementError) -> Self {
        match error {
            ArrangementError::Cancelled => Self::Cancelled,
            other => Self::Arrangement(other),
        }
    }
}

impl From<Cancelled> for BooleanError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Steps of an expression that are evaluated between two looks at a request to stop.
const STEPS_A_CHUNK: usize = 1 << 14;

/// Cells that an expression is evaluated for at once, a bit each.
const WORD: usize = 64;

fn join(p: &[f64; 3]) -> String {
    format!("{}, {}, {}", p[0], p[1], p[2])
}

/// A union of 3-cells of an arrangement.
#[derive(Clone, Debug)]
pub struct Solid<'a> {
    pub(crate) arrangement: &'a Arrangement,
    inside: Vec<bool>,
    cells: Vec<CellId>,
}

impl Arrangement {
    /// Whether a cell is inside an input solid. Never for open surfaces.
    #[must_use]
    pub fn is_inside(&self, cell: CellId, solid: usize, rule: FillRule) -> bool {
        rule.is_inside(self.winding(cell, solid))
    }

    /// The cells where an expression holds: bits of 64 cells at once. O(cells / 64 · length of the expression + solids around
    /// all cells).
    ///
    /// ```
    /// use lar_arrangement::{arrange, Expression, FillRule};
    /// use lar_core::{cuboid_grid, t, Struct};
    /// let cube = cuboid_grid(&[1, 1, 1]);
    /// let scene = Struct::new("two cubes").with(cube.clone()).with(t(&[0.5, 0.5, 0.5])).with(cube);
    /// let surfaces: Vec<_> = scene.eval_struct()?.iter().map(|m| m.to_surface()).collect::<Result<_, _>>()?;
    /// let arrangement = arrange(&surfaces)?;
    /// let difference = arrangement.boolean(&Expression::parse("A - B", &["A", "B"])?, FillRule::NonZero)?;
    /// assert!((difference.volume() - 0.875).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// An operand of the expression that is open, or not oriented with a rule that needs it, or does not exist.
    #[doc(alias = "bool3d")]
    pub fn boolean(&self, expression: &Expression, rule: FillRule) -> Result<Solid<'_>, BooleanError> {
        Evaluator::new().fill(rule).solid(self, expression)
    }

    pub(crate) fn solid_where(
        &self,
        expression: &Expression,
        rule: FillRule,
        course: &Course,
        stats: &mut Stats,
    ) -> Result<Solid<'_>, BooleanError> {
        course.begin("cells", stats)?;
        for solid in expression.operands() {
            self.check_operand(solid, rule)?;
        }
        let (mut stack, mut bits) = (Vec::new(), vec![0u64; self.n_solids()]);
        let mut inside = Vec::with_capacity(self.n_cells());
        let words_a_chunk = STEPS_A_CHUNK / expression.len() + 1;
        course.walk(self.n_cells().div_ceil(WORD), words_a_chunk, |word| {
            let cells = word * WORD..((word + 1) * WORD).min(self.n_cells());
            let windings = || {
                cells
                    .clone()
                    .zip(0..)
                    .flat_map(|(cell, bit)| self.windings.of_cell(cell).iter().map(move |w| (w, bit)))
            };
            for (&(solid, winding), bit) in windings() {
                bits[solid as usize] |= u64::from(rule.is_inside(winding)) << bit;
            }
            let holds = expression.evaluate_bits(&mut stack, |solid| bits[solid]);
            inside.extend((0..cells.len()).map(|bit| holds >> bit & 1 == 1));
            windings().for_each(|(&(solid, _), _)| bits[solid as usize] = 0);
        })?;
        course.go_on()?;
        Ok(self.solid(inside))
    }

    fn check_operand(&self, solid: usize, rule: FillRule) -> Result<(), BooleanError> {
        if solid >= self.n_solids() {
            return Err(BooleanError::NoSuchSolid { solid, n_solids: self.n_solids() });
        }
        let name = || self.solid_name(solid).to_owned();
        match self.closure(solid) {
            Closure::Closed => Ok(()),
            Closure::Unoriented if rule == FillRule::EvenOdd => Ok(()),
            Closure::Unoriented => Err(BooleanError::Unoriented { solid: name() }),
            Closure::Open => {
                let edges = self.open_edges(solid);
                let at = |v: lar_core::VertexId| self.complex.points().xyz(v.index());
                let edge = edges.first().map_or([[f64::NAN; 3]; 2], |&e| self.edge(e).map(at));
                Err(BooleanError::Open { solid: name(), n_edges: edges.len(), edge })
            }
        }
    }

    /// The union of some cells; cells that do not exist are left out. O(cells).
    ///
    /// ```
    /// use lar_arrangement::arrange;
    /// use lar_core::{CellId, cuboid_grid};
    /// let bar = arrange(&[cuboid_grid(&[3, 1, 1]).to_surface("bar")?])?;
    /// let ends = bar.union_of_cells([CellId(1), CellId(3)]);
    /// assert_eq!((ends.cells().len(), ends.volume(), ends.area()), (2, 2.0, 12.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn union_of_cells(&self, cells: impl IntoIterator<Item = CellId>) -> Solid<'_> {
        let mut inside = vec![false; self.n_cells()];
        for cell in cells {
            inside.get_mut(cell.index()).into_iter().for_each(|bit| *bit = true);
        }
        self.solid(inside)
    }

    /// The union of the cells for which `inside` holds.
    fn solid(&self, inside: Vec<bool>) -> Solid<'_> {
        let cells = (0..).map(CellId).zip(&inside).filter(|(_, inside)| **inside).map(|(c, _)| c).collect();
        Solid { arrangement: self, inside, cells }
    }
}

impl Solid<'_> {
    /// The cells.
    #[must_use]
    pub fn cells(&self) -> &[CellId] {
        &self.cells
    }

    /// Whether the exterior is not part of it.
    #[must_use]
    pub fn is_bounded(&self) -> bool {
        !self.inside.first().is_some_and(|exterior| *exterior)
    }

    /// The cells as a chain. O(cells).
    #[must_use]
    pub fn chain(&self) -> Chain {
        let n = self.inside.len();
        Chain::new(3, n, self.cells.iter().map(|c| (c.0, 1))).expect("the cells are those of the arrangement")
    }

    /// The faces of its surface: ∂3 · chain. The sign is +1 where the face's normal points out of it. O(faces).
    pub fn boundary(&self) -> impl Iterator<Item = (FaceId, i8)> + '_ {
        let signed = |face: FaceId| (face, self.sign_of(face));
        (0..self.arrangement.n_faces() as u32).map(FaceId).map(signed).filter(|(_, sign)| *sign != 0)
    }

    /// As [`boundary`](Self::boundary), by all threads.
    pub(crate) fn boundary_faces(&self) -> Vec<(FaceId, i8)> {
        let faces = parallel::select(self.arrangement.n_faces(), |face| self.sign_of(FaceId(face)) != 0);
        let signed = |face: FaceId| (face, self.sign_of(face));
        parallel::map_light(faces.len(), |i| signed(FaceId(faces[i])))
    }

    /// The coefficient of a face in the boundary.
    fn sign_of(&self, face: FaceId) -> i8 {
        let [front, back] = self.arrangement.cells_of_face[face.index()];
        i8::from(self.inside[back as usize]) - i8::from(self.inside[front as usize])
    }

    /// Volume; infinite when the exterior is part of it. O(size of the arrangement).
    #[must_use]
    pub fn volume(&self) -> f64 {
        if !self.is_bounded() {
            return f64::INFINITY;
        }
        let volumes = self.arrangement.volumes();
        self.cells.iter().map(|c| volumes[c.index()]).sum()
    }

    /// Area of its surface. O(size of the surface).
    #[must_use]
    pub fn area(&self) -> f64 {
        self.boundary().map(|(face, _)| self.arrangement.area(face)).sum()
    }
}
