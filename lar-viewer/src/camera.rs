//! The camera: a target, an orientation, a distance, with perspective or orthographic projection.
//!
//! The eye sits at `distance` from `target`, backwards along the orientation's line of sight. No parameter that passes
//! [`Camera::validate`] yields NaN, and looking straight down is as good a view as any.
//!
//! The *target plane* passes through the target, parallel to the screen. Both projections show it at the same size,
//! pan and zoom keep its point under the cursor, so switching projection never loses the object.
//!
//! All lengths are world units in f64; the renderer rounds only the finished matrices, relative to the scene.

use crate::{Bounds, Orientation, ViewerError};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

/// Vertical opening angle when nothing else is asked for, in radians.
pub(crate) const DEFAULT_FOV: f64 = 0.45;

/// Opening angles that a camera may have, in radians.
const FOVS: std::ops::RangeInclusive<f64> = 1e-3..=3.0;

/// Part of the picture's half side left free around a fitted scene.
const FIT_MARGIN: f64 = 0.06;

/// A perspective eye stays before a fitted scene by at least this part of its depth.
const NEAREST: f64 = 0.1;

/// Zoom is refused beyond these distances, in world units, to keep every product finite in f64.
const DISTANCES: std::ops::RangeInclusive<f64> = 1e-90..=1e110;

/// How depth becomes size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// Near things are larger.
    #[default]
    Perspective,
    /// Parallel lines stay parallel.
    Orthographic,
}

/// Where the scene is seen from.
///
/// ```
/// use lar_viewer::{Bounds, Camera};
/// let cube = Bounds { min: [0.; 3], max: [1.; 3] };
/// let camera = Camera::default().fit(&cube, 16.0 / 9.0);
/// assert!(camera.project([1.; 3], 720.).is_some());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point that is turned about, in the middle of the picture.
    pub target: [f64; 3],
    /// From the target to the eye.
    pub distance: f64,
    /// Which way is right, up and back.
    pub orientation: Orientation,
    /// Vertical opening angle in radians.
    pub fov_y: f64,
    /// Perspective or orthographic.
    pub projection: Projection,
}

impl Default for Camera {
    /// A three-quarter view of the unit sphere: x to the right and towards the eye, z up.
    fn default() -> Self {
        Self {
            target: [0.0; 3],
            distance: 6.0,
            orientation: Orientation::default(),
            fov_y: DEFAULT_FOV,
            projection: Projection::Perspective,
        }
    }
}

impl Camera {
    /// Checks that all parameters are finite and in range.
    ///
    /// # Errors
    /// `InvalidView` with the parameter and its value.
    pub fn validate(&self) -> Result<(), ViewerError> {
        let within = |parameter, value: f64, ok: bool, expected| {
            if ok { Ok(()) } else { Err(ViewerError::InvalidView { parameter, value, expected }) }
        };
        for x in self.target {
            within("a camera target coordinate", x, x.abs() <= 1e108, "at most 1e108 in magnitude")?;
        }
        within("the camera distance", self.distance, DISTANCES.contains(&self.distance), "in 1e-90..=1e110")?;
        within("the field of view", self.fov_y, FOVS.contains(&self.fov_y), "in 0.001..=3 radians")
    }

    /// A perspective camera with its eye here, this target in the middle of the picture, and this direction as far
    /// upwards as that allows.
    ///
    /// ```
    /// let camera = lar_viewer::Camera::looking([3., 0., 0.], [0.; 3], [0., 0., 1.])?;
    /// assert_eq!(camera.distance, 3.0);
    /// # Ok::<(), lar_viewer::ViewerError>(())
    /// ```
    ///
    /// # Errors
    /// `InvalidView` when eye and target coincide, when up is parallel to the line of sight, or when a coordinate is
    /// not finite or too large.
    pub fn looking(eye: [f64; 3], target: [f64; 3], up: [f64; 3]) -> Result<Self, ViewerError> {
        let back = DVec3::from(eye) - DVec3::from(target);
        let orientation = Orientation::facing(back.to_array(), up)?;
        let camera = Self { target, distance: back.length(), orientation, ..Self::default() };
        camera.validate()?;
        Ok(camera)
    }

    /// The same camera with parallel projection, showing this height of the world.
    ///
    /// # Errors
    /// `InvalidView` when the height is not above zero and finite, or too large.
    pub fn orthographic(self, height: f64) -> Result<Self, ViewerError> {
        let distance = 0.5 * height / (0.5 * self.fov_y).tan();
        let camera = Self { distance, projection: Projection::Orthographic, ..self };
        camera.validate()?;
        Ok(camera)
    }

    /// Height of the world that the picture shows in the target plane.
    #[must_use]
    pub fn visible_height(&self) -> f64 {
        self.world_per_pixel(1.0)
    }

    /// The camera as arguments of `lar render`: `--eye`, `--target`, `--up`, and `--fov` in degrees or `--ortho` with
    /// the height that is shown. Coordinates have all their digits.
    ///
    /// ```
    /// let camera = lar_viewer::Camera::looking([3., 0., 0.], [0.; 3], [0., 0., 1.])?;
    /// assert!(camera.arguments().starts_with("--eye=3,0,0 --target=0,0,0 --up="));
    /// # Ok::<(), lar_viewer::ViewerError>(())
    /// ```
    #[must_use]
    pub fn arguments(&self) -> String {
        let list = |[x, y, z]: [f64; 3]| format!("{x},{y},{z}");
        let lens = match self.projection {
            Projection::Perspective => format!("--fov={}", self.fov_y.to_degrees()),
            Projection::Orthographic => format!("--ortho={}", self.visible_height()),
        };
        let [_, up, _] = self.axes();
        format!("--eye={} --target={} --up={} {lens}", list(self.eye()), list(self.target), list(up))
    }

    /// The camera's axes in the world: right, up, and back (from the target towards the eye); orthonormal and
    /// right-handed.
    #[must_use]
    pub fn axes(&self) -> [[f64; 3]; 3] {
        self.orientation.axes()
    }

    fn basis(&self) -> [DVec3; 3] {
        self.orientation.basis()
    }

    /// Where the eye is; for an orthographic camera the centre of the picture lies on the line from here to the target.
    #[must_use]
    pub fn eye(&self) -> [f64; 3] {
        (DVec3::from(self.target) + self.basis()[2] * self.distance).to_array()
    }

    /// The same view with the box in the middle and as large as fits in a picture of this aspect (width / height);
    /// see [`Camera::fit_points`].
    #[must_use]
    pub fn fit(self, bounds: &Bounds, aspect: f64) -> Self {
        self.fit_points(bounds.corners(), aspect)
    }

    /// The same direction of sight, from the nearest place that shows all points in a picture of this aspect
    /// (width / height), with a small margin; the target lies midway in depth. Points that are all equal are shown
    /// at unit size; without points the camera stays.
    ///
    /// Exact in one pass. With camera coordinates x, y (right, up) and z (back), and t the tangent of half the
    /// opening angle, the eye (ex, ez) sees x when |x − ex| ≤ t (ez − z). So ez + ex/t ≥ A = max(z + x/t) and
    /// ez − ex/t ≥ B = max(z − x/t), and the nearest eye has ez = (A + B)/2, ex = t (A − B)/2; the same with y, and
    /// the larger ez counts. An orthographic camera is the case z = 0.
    #[must_use]
    pub fn fit_points(self, points: impl IntoIterator<Item = [f64; 3]>, aspect: f64) -> Self {
        let tan_y = (0.5 * self.fov_y).tan() * (1.0 - FIT_MARGIN);
        let tan = DVec2::new(tan_y * aspect, tan_y);
        let [right, up, back] = self.basis();
        let mut reach: Option<Reach> = None;
        for point in points {
            let v = DVec3::from(point);
            let side = DVec2::new(v.dot(right), v.dot(up)) / tan;
            let seen = Reach::of_point(side, v.dot(back), self.projection);
            reach = Some(reach.map_or(seen, |r| r.union(seen)));
        }
        let Some(Reach { plus, minus, nearest, farthest }) = reach else { return self };
        let middle = 0.5 * (nearest + farthest);
        let eye = (0.5 * (plus + minus)).max_element();
        let away = match self.projection {
            Projection::Perspective => eye.max(nearest + NEAREST * (nearest - farthest)) - middle,
            Projection::Orthographic => eye,
        };
        let distance = if away <= *DISTANCES.start() { 1.0 / tan.min_element() } else { away };
        let side = 0.5 * tan * (plus - minus);
        let target = right * side.x + up * side.y + back * middle;
        Self { target: target.to_array(), distance: distance.min(*DISTANCES.end()), ..self }
    }

    /// Moved parallel to the screen by a mouse motion of this many pixels, x to the right and y down, in a picture
    /// `height` pixels high: the point of the target plane that was under the cursor stays under it. A motion that
    /// leaves the space of valid cameras (NaN, overflow) moves nothing.
    #[must_use]
    pub fn pan(self, pixels: [f64; 2], height: f64) -> Self {
        let [right, up, _] = self.basis();
        let scale = self.world_per_pixel(height);
        let shift = right * (-pixels[0] * scale) + up * (pixels[1] * scale);
        let target = (DVec3::from(self.target) + shift).to_array();
        let moved = Self { target, ..self };
        if moved.validate().is_ok() { moved } else { self }
    }

    /// Nearer by this factor (above 1 enlarges), keeping the point of the target plane under the cursor where it is.
    /// `cursor` is in pixels from the middle of the picture, x to the right and y down.
    #[must_use]
    pub fn zoom(self, factor: f64, cursor: [f64; 2], height: f64) -> Self {
        let distance = (self.distance / factor).clamp(*DISTANCES.start(), *DISTANCES.end());
        if distance.is_nan() {
            return self;
        }
        let kept = 1.0 - distance / self.distance;
        let nearer = self.pan(cursor.map(|c| -c * kept), height);
        Self { distance, ..nearer }
    }

    /// With the other projection; the target plane keeps its size.
    #[must_use]
    pub fn toggle_projection(self) -> Self {
        let projection = match self.projection {
            Projection::Perspective => Projection::Orthographic,
            Projection::Orthographic => Projection::Perspective,
        };
        Self { projection, ..self }
    }

    /// Length in the target plane that one pixel shows, in a picture `height` pixels high.
    #[must_use]
    pub fn world_per_pixel(&self, height: f64) -> f64 {
        2.0 * self.distance * (0.5 * self.fov_y).tan() / height
    }

    /// Where the point appears: pixels from the middle of the picture, x to the right and y down; `None` when it is
    /// not before the eye.
    #[must_use]
    pub fn project(&self, point: [f64; 3], height: f64) -> Option<[f64; 2]> {
        let [right, up, _] = self.basis();
        let v = DVec3::from(point) - DVec3::from(self.target);
        let shrink = match self.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective => self.distance / self.depth(point),
        };
        let scale = shrink / self.world_per_pixel(height);
        (0.0 < shrink && shrink.is_finite()).then(|| [v.dot(right) * scale, -v.dot(up) * scale])
    }

    /// The transformation from the world to camera axes with the eye at the origin and looking along −z.
    pub(crate) fn view_from_world(&self) -> DMat4 {
        let [right, up, back] = self.basis();
        let rotation = DMat3::from_cols(right, up, back).transpose();
        let target = rotation * DVec3::from(self.target);
        DMat4::from_mat3_translation(rotation, -target - DVec3::new(0.0, 0.0, self.distance))
    }

    /// The same camera for a world whose origin is `center` and whose unit of length is `unit`.
    pub(crate) fn relative_to(self, center: [f64; 3], unit: f64) -> Self {
        let target = std::array::from_fn(|k| (self.target[k] - center[k]) / unit);
        Self { target, distance: self.distance / unit, ..self }
    }

    /// How far the point lies before the eye, along the line of sight.
    pub(crate) fn depth(&self, point: [f64; 3]) -> f64 {
        self.distance - (DVec3::from(point) - DVec3::from(self.target)).dot(self.basis()[2])
    }

    /// The projection to clip space (depth 0 at `near` to 1 at `far`) in a picture of this aspect.
    pub(crate) fn clip_from_view(&self, aspect: f64, near: f64, far: f64) -> DMat4 {
        let cot = 1.0 / (0.5 * self.fov_y).tan();
        match self.projection {
            Projection::Perspective => {
                let z = far / (near - far);
                DMat4::from_cols(
                    DVec4::new(cot / aspect, 0.0, 0.0, 0.0),
                    DVec4::new(0.0, cot, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, z, -1.0),
                    DVec4::new(0.0, 0.0, near * z, 0.0),
                )
            }
            Projection::Orthographic => {
                let scale = cot / self.distance;
                let z = 1.0 / (near - far);
                DMat4::from_cols(
                    DVec4::new(scale / aspect, 0.0, 0.0, 0.0),
                    DVec4::new(0.0, scale, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, z, 0.0),
                    DVec4::new(0.0, 0.0, near * z, 1.0),
                )
            }
        }
    }
}

/// Extremes of the points that a camera is to show: of z + x/t and z − x/t, of z + y/t and z − y/t, and of z.
#[derive(Clone, Copy)]
struct Reach {
    plus: DVec2,
    minus: DVec2,
    nearest: f64,
    farthest: f64,
}

impl Reach {
    fn of_point(side: DVec2, z: f64, projection: Projection) -> Self {
        let shift = if projection == Projection::Perspective { z } else { 0.0 };
        Self { plus: side + shift, minus: -side + shift, nearest: z, farthest: z }
    }

    fn union(self, other: Self) -> Self {
        Self {
            plus: self.plus.max(other.plus),
            minus: self.minus.max(other.minus),
            nearest: self.nearest.max(other.nearest),
            farthest: self.farthest.min(other.farthest),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_2;

    fn camera() -> impl Strategy<Value = Camera> {
        let target = [-10.0..10.0_f64, -10.0..10.0_f64, -10.0..10.0_f64];
        let angles = (-7.0..7.0_f64, -FRAC_PI_2..=FRAC_PI_2);
        (target, 0.1..100.0_f64, angles, 0.1..2.0_f64, any::<bool>()).prop_map(
            |(target, distance, (azimuth, elevation), fov_y, perspective)| Camera {
                target,
                distance,
                orientation: Orientation::turntable(azimuth, elevation),
                fov_y,
                projection: if perspective { Projection::Perspective } else { Projection::Orthographic },
            },
        )
    }

    fn on_target_plane(camera: &Camera, x: f64, y: f64) -> [f64; 3] {
        let [right, up, _] = camera.basis();
        (DVec3::from(camera.target) + right * x + up * y).to_array()
    }

    #[track_caller]
    fn assert_near(a: [f64; 2], b: [f64; 2], tolerance: f64) {
        assert!(DVec2::from(a).distance(DVec2::from(b)) <= tolerance, "{a:?} is not {b:?}");
    }

    proptest! {
        #[test]
        fn pan_keeps_the_point_under_the_cursor(camera in camera(), x in -300.0..300.0, y in -300.0..300.0) {
            let p = on_target_plane(&camera, 0.1, -0.2);
            let before = camera.project(p, 720.0).unwrap();
            let after = camera.pan([x, y], 720.0).project(p, 720.0).unwrap();
            assert_near(after, [before[0] + x, before[1] + y], 1e-6);
        }

        #[test]
        fn zoom_keeps_the_point_under_the_cursor(camera in camera(), factor in 0.2..5.0, x in -1.0..1.0, y in -1.0..1.0) {
            let p = on_target_plane(&camera, x, y);
            let cursor = camera.project(p, 720.0).unwrap();
            let zoomed = camera.zoom(factor, cursor, 720.0);
            assert_near(zoomed.project(p, 720.0).unwrap(), cursor, 1e-6 * (1.0 + cursor[0].abs() + cursor[1].abs()));
            prop_assert!((zoomed.distance * factor - camera.distance).abs() < 1e-9 * camera.distance);
        }

        #[test]
        fn fit_shows_all_points_and_touches_the_margin_on_two_sides(
            camera in camera(),
            aspect in 0.3..3.0,
            points in prop::collection::vec(prop::array::uniform3(-5.0..5.0_f64), 2..20),
        ) {
            let fitted = camera.fit_points(points.iter().copied(), aspect);
            fitted.validate().unwrap();
            let seen = points.iter().map(|&p| {
                let [x, y] = fitted.project(p, 2.0).expect("before the eye");
                DVec2::new(x / aspect, y) / (1.0 - FIT_MARGIN)
            });
            let (lo, hi) = seen.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
            let depths = points.iter().map(|&p| fitted.depth(p));
            let (near, far) = depths.fold((f64::MAX, f64::MIN), |(a, b), d| (a.min(d), b.max(d)));
            if camera.projection == Projection::Perspective && near <= (NEAREST + 1e-9) * (far - near) { return Ok(()) }
            let within = |x: f64| (x - 1.0).abs() < 1e-6;
            prop_assert!(hi.max_element() < 1.0 + 1e-6 && -1.0 - 1e-6 < lo.min_element());
            prop_assert!((within(hi.x) && within(-lo.x)) || (within(hi.y) && within(-lo.y)), "{lo} {hi}");
        }

        #[test]
        fn arguments_describe_the_camera(camera in camera()) {
            let arguments = camera.arguments();
            let value = |name: &str| {
                let found = arguments.split(' ').find_map(|a| a.strip_prefix(name)?.strip_prefix('='));
                found.map(|v| v.split(',').map(|x| x.parse().unwrap()).collect::<Vec<f64>>())
            };
            let [eye, target, up] = ["--eye", "--target", "--up"].map(|n| {
                <[f64; 3]>::try_from(value(n).expect("is given")).expect("three coordinates")
            });
            let mut read = Camera::looking(eye, target, up).unwrap();
            if let Some(fov) = value("--fov") {
                read.fov_y = fov[0].to_radians();
            }
            if let Some(height) = value("--ortho") {
                read = read.orthographic(height[0]).unwrap();
            }
            prop_assert_eq!(read.projection, camera.projection);
            let at = on_target_plane(&camera, 0.1, -0.2);
            assert_near(read.project(at, 720.0).unwrap(), camera.project(at, 720.0).unwrap(), 1e-5);
        }

        #[test]
        fn motions_that_are_not_numbers_move_nothing(camera in camera(), bad in prop_oneof![Just(f64::NAN), Just(f64::INFINITY)]) {
            prop_assert_eq!(camera.pan([bad, 1.0], 720.0), camera);
            prop_assert_eq!(camera.pan([1.0, 1.0], 0.0), camera);
            prop_assert_eq!(camera.zoom(f64::NAN, [0.0; 2], 720.0), camera);
            camera.zoom(bad, [bad, 0.0], 720.0).validate().unwrap();
            camera.zoom(0.0, [10.0, 0.0], 720.0).validate().unwrap();
        }

        #[test]
        fn matrices_agree_with_project(camera in camera(), p in prop::array::uniform3(-5.0..5.0_f64), aspect in 0.3..3.0) {
            let clip = camera.clip_from_view(aspect, 1e-3, 1e3) * camera.view_from_world() * DVec3::from(p).extend(1.0);
            let Some([x, y]) = camera.project(p, 2.0) else { return Ok(()) };
            if clip.w < 1e-3 { return Ok(()) }
            assert_near([clip.x / clip.w * aspect, clip.y / clip.w], [x, -y], 1e-6 * (1.0 + x.abs() + y.abs()));
        }
    }

    #[test]
    fn depth_runs_from_zero_at_near_to_one_at_far() {
        for camera in [Camera::default(), Camera::default().toggle_projection()] {
            for (z, expected) in [(-2.0, 0.0), (-50.0, 1.0)] {
                let clip = camera.clip_from_view(1.5, 2.0, 50.0) * DVec4::new(0.0, 0.0, z, 1.0);
                assert!((clip.z / clip.w - expected).abs() < 1e-12, "{:?} at {z}", camera.projection);
            }
        }
    }

    #[test]
    fn default_view_has_z_up_and_x_to_the_right() {
        let camera = Camera::default();
        let [x, y, z] = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]].map(|p| camera.project(p, 100.0).unwrap());
        assert!(0.0 < x[0] && 0.0 < x[1], "x points right and towards the eye: {x:?}");
        assert!(0.0 < y[0] && y[1] < 0.0, "y points right and away: {y:?}");
        assert!(z[0].abs() < 1e-9 && z[1] < 0.0, "z points up: {z:?}");
    }

    #[test]
    fn dragging_right_turns_the_near_side_to_the_right() {
        let camera = Camera::default();
        let near = (DVec3::from(camera.target) + camera.basis()[2]).to_array();
        for turn in [Orientation::orbit, Orientation::tumble] {
            let turned = |pixels| Camera { orientation: turn(camera.orientation, pixels), ..camera };
            assert!(0.0 < turned([10.0, 0.0]).project(near, 100.0).unwrap()[0]);
            assert!(0.0 < turned([0.0, 10.0]).project(near, 100.0).unwrap()[1]);
        }
    }

    #[track_caller]
    fn check_refused(camera: Camera, named: &str) {
        let error = camera.validate().unwrap_err().to_string();
        assert!(error.contains(named), "{error}");
    }

    #[test]
    fn senseless_cameras_are_refused() {
        let good = Camera::default();
        check_refused(Camera { distance: 0.0, ..good }, "the camera distance is 0");
        check_refused(Camera { distance: f64::NAN, ..good }, "NaN");
        check_refused(Camera { target: [0.0, f64::INFINITY, 0.0], ..good }, "target coordinate is inf");
        check_refused(Camera { fov_y: -0.1, ..good }, "field of view is -0.1");
    }

    #[test]
    fn a_box_without_extent_is_shown_at_unit_size() {
        let point = Bounds { min: [3.0; 3], max: [3.0; 3] };
        let camera = Camera::default().fit(&point, 1.0);
        camera.validate().unwrap();
        assert!(DVec3::from(camera.target).abs_diff_eq(DVec3::splat(3.0), 1e-12));
    }
}
