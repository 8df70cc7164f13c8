//! What cameras do on the screen.

use super::fit::{FIT_MARGIN, NEAREST};
use super::*;
use crate::Bounds;
use glam::{DVec2, DVec4};
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
