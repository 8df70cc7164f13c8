//! The camera as arguments: what `Copy camera` in a window gives.

#[cfg(feature = "viewer")]
use crate::CommandError;
#[cfg(feature = "viewer")]
use lar_viewer::{Camera, Projection};
use std::str::FromStr;

/// Where the picture is seen from; fitted to what is shown where nothing is said.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub(crate) struct CameraArguments {
    /// Where the eye is.
    #[arg(long, value_name = "X,Y,Z", requires = "target", allow_hyphen_values = true)]
    eye: Option<Triple>,
    /// The point in the middle of the picture.
    #[arg(long, value_name = "X,Y,Z", requires = "eye", allow_hyphen_values = true)]
    target: Option<Triple>,
    /// The direction that is up in the picture.
    #[arg(long, value_name = "X,Y,Z", requires = "eye", default_value = "0,0,1", allow_hyphen_values = true)]
    up: Triple,
    /// Vertical opening angle in degrees.
    #[arg(long, value_name = "DEGREES", conflicts_with = "ortho", allow_hyphen_values = true)]
    fov: Option<f64>,
    /// Parallel projection, showing this height of the world, or fitted when none is given.
    #[arg(long, value_name = "HEIGHT", num_args = 0..=1)]
    ortho: Option<Option<f64>>,
}

/// Three numbers separated by commas.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Triple([f64; 3]);

impl FromStr for Triple {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
        let triple = numbers.and_then(|n| <[f64; 3]>::try_from(n).ok());
        triple
            .filter(|t| t.iter().all(|x| x.is_finite()))
            .map(Self)
            .ok_or("three numbers separated by commas")
    }
}

#[cfg(feature = "viewer")]
impl CameraArguments {
    /// The camera that is asked for; `fit` places one of which only the lens is known.
    pub(crate) fn camera(&self, fit: impl FnOnce(Camera) -> Camera) -> Result<Camera, CommandError> {
        let mut lens = Camera::default();
        if let Some(degrees) = self.fov {
            lens.fov_y = degrees.to_radians();
        }
        if self.ortho.is_some() {
            lens.projection = Projection::Orthographic;
        }
        lens.validate()?;
        let placed = match (self.eye, self.target) {
            (Some(Triple(eye)), Some(Triple(target))) => {
                let Camera { fov_y, projection, .. } = lens;
                Camera { fov_y, projection, ..Camera::looking(eye, target, self.up.0)? }
            }
            _ => fit(lens),
        };
        Ok(self.ortho.flatten().map_or(Ok(placed), |height| placed.orthographic(height))?)
    }

    /// Whether an eye is given.
    pub(crate) fn is_placed(&self) -> bool {
        self.eye.is_some()
    }

    /// Whether the height of the world that is shown is given.
    pub(crate) fn has_height(&self) -> bool {
        self.ortho.flatten().is_some()
    }
}

#[cfg(all(test, feature = "viewer"))]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        camera: CameraArguments,
    }

    fn parse(arguments: &str) -> Result<Camera, String> {
        let line = Line::try_parse_from(std::iter::once("test").chain(arguments.split_whitespace()));
        let fit = |lens| Camera { target: [9.0; 3], ..lens };
        line.map_err(|e| e.to_string())?.camera.camera(fit).map_err(|e| e.to_string())
    }

    #[test]
    fn what_a_window_copies_is_read_back() {
        let camera = Camera::looking([4.0, -3.0, 2.5], [0.5, -0.25, 0.0], [0.0, 0.1, 1.0]).unwrap();
        for camera in [camera, camera.orthographic(3.5).unwrap(), Camera { fov_y: 1.0, ..camera }] {
            let read = parse(&camera.arguments()).unwrap();
            assert_eq!(read.projection, camera.projection);
            for p in [[0.0; 3], [1.0, 2.0, -0.5]] {
                let [a, b] = [read, camera].map(|c| c.project(p, 700.0).unwrap());
                assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-6, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_lens_alone_is_fitted() {
        assert_eq!(parse("").unwrap(), Camera { target: [9.0; 3], ..Camera::default() });
        let wide = parse("--fov 60").unwrap();
        assert_eq!((wide.target, wide.fov_y), ([9.0; 3], 60_f64.to_radians()));
        let parallel = parse("--ortho=2").unwrap();
        assert_eq!(parallel.projection, Projection::Orthographic);
        assert!((parallel.visible_height() - 2.0).abs() < 1e-12);
    }

    #[track_caller]
    fn check_refused(arguments: &str, expected: &str) {
        let error = parse(arguments).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }

    #[test]
    fn senseless_cameras_are_refused() {
        check_refused("--eye 1,2", "three numbers separated by commas");
        check_refused("--eye 1,2,NaN --target 0,0,0", "three numbers");
        check_refused("--eye 1,2,3", "--target");
        check_refused("--eye 1,2,3 --target 1,2,3", "the distance from eye to target is 0");
        check_refused("--eye 0,0,3 --target 0,0,0", "up must not be parallel");
        check_refused("--fov 200", "the field of view is 3.49");
        check_refused("--fov 20 --ortho 3", "cannot be used with");
        check_refused("--ortho 0", "the camera distance is 0");
    }
}
