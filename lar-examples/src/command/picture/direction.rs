//! Directions of sight on the command line, as people say them.

use lar_viewer::{Orientation, StandardView};

/// Azimuth and elevation of which only the other is given, in degrees.
const DEFAULT_ANGLES: [f64; 2] = [-60.0, 24.0];

/// From where the scene is seen when no eye is given; the picture is fitted to it.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Direction {
    /// A view along an axis, or the isometric one.
    #[arg(long, value_name = "SIDE", value_parser = side, conflicts_with_all = ["azimuth", "elevation", "eye"])]
    view: Option<StandardView>,
    /// Angle of the eye about z, from x towards y, in degrees.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = angle, conflicts_with = "eye")]
    azimuth: Option<f64>,
    /// Angle of the eye above the xy plane, in degrees.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = angle, conflicts_with = "eye")]
    elevation: Option<f64>,
}

fn side(text: &str) -> Result<StandardView, String> {
    let all = || StandardView::ALL.into_iter().chain([StandardView::Isometric]);
    let found = all().find(|view| view.name() == text);
    found.ok_or_else(|| {
        let mut names: Vec<_> = all().map(StandardView::name).collect();
        names.dedup();
        format!("a view is {}", names.join(", "))
    })
}

fn angle(text: &str) -> Result<f64, &'static str> {
    text.parse().ok().filter(|a: &f64| a.abs() <= 3600.0).ok_or("an angle in degrees, within ±3600")
}

impl Direction {
    /// The orientation that is asked for.
    pub(crate) fn orientation(&self) -> Option<Orientation> {
        if let Some(view) = self.view {
            return Some(view.orientation());
        }
        let given = self.azimuth.is_some() || self.elevation.is_some();
        let azimuth = self.azimuth.unwrap_or(DEFAULT_ANGLES[0]).to_radians();
        let elevation = self.elevation.unwrap_or(DEFAULT_ANGLES[1]).to_radians();
        given.then(|| Orientation::turntable(azimuth, elevation))
    }
}
