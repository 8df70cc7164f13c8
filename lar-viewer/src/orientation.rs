//! Directions of sight: a unit quaternion, and how a mouse turns it.
//!
//! The quaternion takes the camera's axes (x to the right, y up, z back towards the eye) to the world's. It is of
//! unit length by construction and after every turn, so no pole, roll or long drag ever yields NaN.

use crate::ViewerError;
use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Turning angle per pixel of mouse motion: a drag over 400 pixels is half a turn.
const RADIANS_PER_PIXEL: f64 = PI / 400.0;

/// Sine of the smallest angle between the line of sight and the upward direction that still tells what is up.
const LEAST_SINE: f64 = 1e-9;

/// How a camera is turned: which way is right, up, and back to the eye. Always a rotation.
///
/// ```
/// use lar_viewer::Orientation;
/// let front = Orientation::turntable(-std::f64::consts::FRAC_PI_2, 0.0);
/// let [right, up, back] = front.axes();
/// assert!((right[0] - 1.0).abs() < 1e-12 && (up[2] - 1.0).abs() < 1e-12 && (back[1] + 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation(DQuat);

impl Default for Orientation {
    /// A three-quarter view: x to the right and towards the eye, z up.
    fn default() -> Self {
        Self::turntable(-1.05, 0.42)
    }
}

impl Orientation {
    /// Seen from the direction given by `azimuth` (about z, from x towards y) and `elevation` (above the xy plane),
    /// in radians, with z up. Angles that are not finite count as 0; an elevation beyond ±π/2 is upside down.
    #[must_use]
    pub fn turntable(azimuth: f64, elevation: f64) -> Self {
        let [azimuth, elevation] = [azimuth, elevation].map(|a| if a.is_finite() { a } else { 0.0 });
        let about_z = DQuat::from_rotation_z(azimuth + FRAC_PI_2);
        Self((about_z * DQuat::from_rotation_x(FRAC_PI_2 - elevation)).normalize())
    }

    /// Seen from the direction `back`, with `up` as far upwards as that allows.
    ///
    /// # Errors
    /// `InvalidView` when `back` has no direction or `up` is parallel to it.
    pub fn facing(back: [f64; 3], up: [f64; 3]) -> Result<Self, ViewerError> {
        let refused = |parameter, value, expected| ViewerError::InvalidView { parameter, value, expected };
        let direction = |v: [f64; 3]| {
            // Scaled by its largest coordinate first, so that no square overflows.
            let largest = v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let finite = v.iter().all(|x| x.is_finite());
            (finite && 0.0 < largest).then(|| (DVec3::from(v) / largest).normalize())
        };
        let back = direction(back).ok_or_else(|| {
            refused("the distance from eye to target", DVec3::from(back).length(), "above 0 and finite")
        })?;
        let up = direction(up).ok_or_else(|| {
            refused("the length of the upward direction", DVec3::from(up).length(), "above 0")
        })?;
        let across = up.cross(back);
        if across.length() < LEAST_SINE {
            let expected = "above 1e-9: up must not be parallel to the line of sight";
            return Err(refused("the sine between up and the line of sight", across.length(), expected));
        }
        let right = across.normalize();
        Ok(Self(DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back)).normalize()))
    }

    /// The camera's axes in the world: right, up, and back; orthonormal and right-handed.
    #[must_use]
    pub fn axes(self) -> [[f64; 3]; 3] {
        self.basis().map(|v| v.to_array())
    }

    pub(crate) fn basis(self) -> [DVec3; 3] {
        let m = DMat3::from_quat(self.0);
        [m.x_axis, m.y_axis, m.z_axis]
    }

    /// Turned by a mouse motion of this many pixels, x to the right and y down, as a turntable: sideways about the
    /// world's z axis, up and down about the screen's horizontal, no farther than straight down or up.
    #[must_use]
    pub fn orbit(self, pixels: [f64; 2]) -> Self {
        let [yaw, pitch] = angles(pixels);
        let [_, up, back] = self.basis();
        // Pitching turns the pair (up.z, back.z) about the origin; an upside-down view stays as far over as it is.
        let elevation = back.z.atan2(up.z);
        let limit = FRAC_PI_2.max(elevation.abs());
        let pitch = (elevation + pitch).clamp(-limit, limit) - elevation;
        Self((DQuat::from_rotation_z(-yaw) * self.0 * DQuat::from_rotation_x(-pitch)).normalize())
    }

    /// Turned about the world's z axis by this angle in radians, from x towards y.
    #[must_use]
    pub fn turned(self, angle: f64) -> Self {
        let angle = if angle.is_finite() { angle } else { 0.0 };
        Self((DQuat::from_rotation_z(angle) * self.0).normalize())
    }

    /// Turned by a mouse motion as a trackball: about the screen's own axes, without any limit.
    #[must_use]
    pub fn tumble(self, pixels: [f64; 2]) -> Self {
        let [yaw, pitch] = angles(pixels);
        Self((self.0 * DQuat::from_euler(glam::EulerRot::YXZ, -yaw, -pitch, 0.0)).normalize())
    }
}

/// Turning angles of a mouse motion; a motion that is not finite turns nothing.
fn angles(pixels: [f64; 2]) -> [f64; 2] {
    pixels.map(|p| if p.is_finite() { (p * RADIANS_PER_PIXEL) % std::f64::consts::TAU } else { 0.0 })
}

/// The views along the axes, and the isometric one.
///
/// ```
/// use lar_viewer::StandardView;
/// let [right, up, _] = StandardView::Top.orientation().axes();
/// assert!((right[0] - 1.0).abs() < 1e-12 && (up[1] - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandardView {
    /// From −y, x to the right.
    Front,
    /// From +y.
    Back,
    /// From +x, y to the right.
    Right,
    /// From −x.
    Left,
    /// From +z, x to the right and y up.
    Top,
    /// From −z, x to the right.
    Bottom,
    /// From the corner (1, −1, 1) of a cube.
    Isometric,
}

impl StandardView {
    /// All seven, in the order of the keys 1 to 7.
    pub const ALL: [Self; 7] =
        [Self::Front, Self::Back, Self::Right, Self::Left, Self::Top, Self::Bottom, Self::Isometric];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Right => "right",
            Self::Left => "left",
            Self::Top => "top",
            Self::Bottom => "bottom",
            Self::Isometric => "isometric",
        }
    }

    /// Where it is seen from.
    #[must_use]
    pub fn orientation(self) -> Orientation {
        let isometric = (1.0 / 3.0_f64.sqrt()).asin();
        let (azimuth, elevation) = match self {
            Self::Front => (-FRAC_PI_2, 0.0),
            Self::Back => (FRAC_PI_2, 0.0),
            Self::Right => (0.0, 0.0),
            Self::Left => (PI, 0.0),
            Self::Top => (-FRAC_PI_2, FRAC_PI_2),
            Self::Bottom => (-FRAC_PI_2, -FRAC_PI_2),
            Self::Isometric => (-0.5 * FRAC_PI_2, isometric),
        };
        Orientation::turntable(azimuth, elevation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn is_rotation(orientation: Orientation) -> bool {
        let [r, u, b] = orientation.basis();
        let m = DMat3::from_cols(r, u, b);
        (m * m.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-12) && (m.determinant() - 1.0).abs() < 1e-12
    }

    fn any_f64() -> impl Strategy<Value = f64> {
        prop_oneof![-1e9..1e9_f64, -10.0..10.0_f64, Just(f64::NAN), Just(f64::INFINITY), Just(0.0)]
    }

    proptest! {
        #[test]
        fn every_turn_is_a_rotation(
            start in [any_f64(), any_f64()],
            turns in prop::collection::vec((any::<bool>(), [any_f64(), any_f64()]), 0..40),
        ) {
            let start = Orientation::turntable(start[0], start[1]);
            let turn = |o: Orientation, (free, pixels)| if free { o.tumble(pixels) } else { o.orbit(pixels) };
            prop_assert!(is_rotation(turns.into_iter().fold(start, turn)));
        }

        #[test]
        fn a_turntable_keeps_z_up(
            azimuth in -7.0..7.0_f64,
            elevation in -FRAC_PI_2..=FRAC_PI_2,
            drags in prop::collection::vec([-2000.0..2000.0_f64, -2000.0..2000.0_f64], 0..20),
        ) {
            let end = drags.into_iter().fold(Orientation::turntable(azimuth, elevation), Orientation::orbit);
            let [right, up, _] = end.basis();
            prop_assert!(right.z.abs() < 1e-9 && -1e-9 < up.z, "{right} {up}");
        }

        #[test]
        fn facing_finds_the_axes_again(azimuth in -7.0..7.0_f64, elevation in -3.0..3.0_f64, size in 1e-200..1e200_f64) {
            let expected = Orientation::turntable(azimuth, elevation).basis();
            let [_, up, back] = expected;
            let found = Orientation::facing((back * size).to_array(), (up + 0.3 * back).to_array()).unwrap();
            for (a, b) in found.basis().into_iter().zip(expected) {
                prop_assert!(a.abs_diff_eq(b, 1e-9), "{a} {b}");
            }
        }
    }

    #[test]
    fn a_trackball_passes_the_pole() {
        let top = StandardView::Top.orientation();
        let [_, up, _] = top.tumble([0.0, 100.0]).basis();
        assert!(up.z < -0.5, "{up}");
        assert!(top.orbit([0.0, 100.0]).basis()[1].abs_diff_eq(top.basis()[1], 1e-9), "a turntable does not");
    }

    #[track_caller]
    fn check_refused(back: [f64; 3], up: [f64; 3], expected: &str) {
        assert_eq!(Orientation::facing(back, up).unwrap_err().to_string(), expected);
    }

    #[test]
    fn directions_that_say_nothing_are_refused() {
        let z = [0.0, 0.0, 1.0];
        check_refused(
            [0.0; 3],
            z,
            "view: the distance from eye to target is 0; it must be above 0 and finite",
        );
        check_refused(
            [f64::NAN, 0.0, 0.0],
            z,
            "view: the distance from eye to target is NaN; it must be above 0 and finite",
        );
        check_refused(z, [0.0; 3], "view: the length of the upward direction is 0; it must be above 0");
        let parallel = Orientation::facing(z, [0.0, 0.0, -2.0]).unwrap_err().to_string();
        assert!(parallel.ends_with("up must not be parallel to the line of sight"), "{parallel}");
    }

    #[test]
    fn standard_views_look_along_their_axes() {
        let expected = [
            [[1., 0., 0.], [0., 0., 1.], [0., -1., 0.]],
            [[-1., 0., 0.], [0., 0., 1.], [0., 1., 0.]],
            [[0., 1., 0.], [0., 0., 1.], [1., 0., 0.]],
            [[0., -1., 0.], [0., 0., 1.], [-1., 0., 0.]],
            [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
            [[1., 0., 0.], [0., -1., 0.], [0., 0., -1.]],
        ];
        for (view, axes) in StandardView::ALL.into_iter().zip(expected) {
            for (found, expected) in view.orientation().basis().into_iter().zip(axes) {
                assert!(found.abs_diff_eq(DVec3::from(expected), 1e-12), "{}: {found}", view.name());
            }
        }
        let [_, _, back] = StandardView::Isometric.orientation().basis();
        assert!(back.abs_diff_eq(DVec3::new(1.0, -1.0, 1.0).normalize(), 1e-12), "{back}");
    }
}
