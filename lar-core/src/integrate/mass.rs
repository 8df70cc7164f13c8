//! Mass, centroid, moments and principal axes of bodies of unit density.

use super::pieces::Piece;
use crate::measure::{Vec3, cross};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Mass, first and second moments of a body. Of a solid of unit density the mass is the volume, of a shell
/// the area, of a wire the length. Moments are kept about a point near the body, so that a body far from the
/// origin keeps its digits.
///
/// Bodies add up: `sum()` over an iterator of them is the body of all together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    mass: f64,
    about: Vector3<f64>,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

/// The axes about which a body turns freely, and the moments of inertia about them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalAxes {
    /// The moments of inertia about the three axes, rising.
    pub moments: [f64; 3],
    /// The unit axes in the same order, a right-handed frame. The first two have their largest coordinate
    /// positive.
    pub axes: [[f64; 3]; 3],
}

impl MassProperties {
    /// The body without mass.
    pub(super) fn zero() -> Self {
        let zero = Vector3::zeros();
        Self { mass: 0., about: zero, first: zero, second: Matrix3::zeros() }
    }

    /// Sums over simplices. For k + 1 vertices p_i relative to one point and s their sum, a k-simplex of
    /// measure m has first moments m·s/(k+1) and second moments m·(Σ p_i p_iᵀ + s sᵀ)/((k+1)(k+2)).
    pub(super) fn of_pieces(pieces: &[Piece]) -> Self {
        let mut body = Self::zero();
        let Some(about) = pieces.first().map(|piece| Vector3::from(piece.vertices()[0])) else { return body };
        body.about = about;
        for piece in pieces {
            let (mut sum, mut squares, mut n) = (Vector3::zeros(), Matrix3::zeros(), 0.);
            for p in piece.vertices().iter().map(|&p| Vector3::from(p) - about) {
                sum += p;
                squares += p * p.transpose();
                n += 1.;
            }
            body.mass += piece.measure;
            body.first += sum * (piece.measure / n);
            body.second += (squares + sum * sum.transpose()) * (piece.measure / (n * (n + 1.)));
        }
        body
    }

    /// The body with its density multiplied by `factor`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        let Self { mass, about, first, second } = *self;
        Self { mass: factor * mass, about, first: first * factor, second: second * factor }
    }

    /// Volume, area or length, negative when counted so.
    #[doc(alias("volume", "surface"))]
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The centre of mass; `None` when the mass is zero or not finite.
    #[must_use]
    pub fn centroid(&self) -> Option<[f64; 3]> {
        let offset = self.first / self.mass;
        (self.mass != 0. && offset.iter().all(|x| x.is_finite())).then(|| (self.about + offset).into())
    }

    /// ∫x, ∫y, ∫z.
    #[doc(alias = "firstMoment")]
    #[must_use]
    pub fn first_moments(&self) -> [f64; 3] {
        self.moved_to([0.; 3]).first.into()
    }

    /// ∫x², ∫y², ∫z².
    #[doc(alias = "secondMoment")]
    #[must_use]
    pub fn second_moments(&self) -> [f64; 3] {
        self.moved_to([0.; 3]).second.diagonal().into()
    }

    /// ∫yz, ∫zx, ∫xy.
    #[doc(alias = "inertiaProduct")]
    #[must_use]
    pub fn inertia_products(&self) -> [f64; 3] {
        let second = self.moved_to([0.; 3]).second;
        [second[(1, 2)], second[(2, 0)], second[(0, 1)]]
    }

    /// The moments of inertia about the coordinate axes: ∫(y² + z²), ∫(z² + x²), ∫(x² + y²).
    #[doc(alias = "inertiaMoment")]
    #[must_use]
    pub fn inertia_moments(&self) -> [f64; 3] {
        let [xx, yy, zz] = self.second_moments();
        [yy + zz, zz + xx, xx + yy]
    }

    /// The inertia tensor about a point: ∫ (|q|² − q qᵀ) for q relative to it; symmetric.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// let cube = ChainComplex::from_model(&cuboid_grid(&[1, 1, 1])).unwrap();
    /// let tensor = cube.mass_properties(3).unwrap()[0].inertia_about([0.5; 3]);
    /// assert!((tensor[0][0] - 1. / 6.).abs() < 1e-15 && tensor[0][1].abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn inertia_about(&self, point: [f64; 3]) -> [[f64; 3]; 3] {
        let second = self.moved_to(point).second;
        (Matrix3::identity() * second.trace() - second).into()
    }

    /// The principal axes through the centroid; `None` when there is no centroid or a moment is not finite.
    /// Where two moments are equal any axes across the third are principal, and one choice is returned.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid, s};
    /// let board = cuboid_grid(&[1, 1, 1]).transformed(&s(&[2., 5., 1.])).unwrap();
    /// let board = ChainComplex::from_model(&board).unwrap().mass_properties(3).unwrap()[0];
    /// let principal = board.principal_axes().unwrap();
    /// assert_eq!(principal.axes, [[0., 1., 0.], [1., 0., 0.], [0., 0., -1.]]);
    /// assert!((principal.moments[0] - 10. * (4. + 1.) / 12.).abs() < 1e-13);
    /// ```
    #[must_use]
    pub fn principal_axes(&self) -> Option<PrincipalAxes> {
        let tensor = Matrix3::from(self.inertia_about(self.centroid()?));
        if tensor.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let found = SymmetricEigen::try_new(tensor, f64::EPSILON, EIGEN_STEPS)?;
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| found.eigenvalues[i].total_cmp(&found.eigenvalues[j]));
        let [a, b] = [order[0], order[1]].map(|i| positive(found.eigenvectors.column(i).into_owned()));
        let axes = [a, b, cross(a, b)].map(|axis| axis.map(|x| x + 0.));
        Some(PrincipalAxes { moments: order.map(|i| found.eigenvalues[i]), axes })
    }

    /// The same body with its moments about another point.
    fn moved_to(&self, point: Vec3) -> Self {
        let Self { mass, about, first, second } = *self;
        let by = about - Vector3::from(point);
        let mixed = first * by.transpose();
        Self {
            mass,
            about: point.into(),
            first: first + by * mass,
            second: second + mixed + mixed.transpose() + by * by.transpose() * mass,
        }
    }
}

/// Steps of the eigenvalue iteration, which needs a few for a 3 × 3 matrix.
const EIGEN_STEPS: usize = 1000;

/// The axis or its opposite, so that its largest coordinate is positive.
fn positive(axis: Vector3<f64>) -> Vec3 {
    let axis = if axis[axis.iamax()] < 0. { -axis } else { axis };
    axis.into()
}

impl std::iter::Sum for MassProperties {
    /// All bodies as one, with moments about the point of the first.
    fn sum<I: Iterator<Item = Self>>(bodies: I) -> Self {
        let plus = |sum: Self, body: Self| {
            let body = body.moved_to(sum.about.into());
            Self {
                mass: sum.mass + body.mass,
                first: sum.first + body.first,
                second: sum.second + body.second,
                ..sum
            }
        };
        bodies.reduce(plus).unwrap_or_else(Self::zero)
    }
}
