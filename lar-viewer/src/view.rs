//! What is chosen anew for each picture: camera, explosion, opacity, background.

use crate::{Camera, Clip, Explosion, Outline, Rgb, SLATE, Scene, ViewerError};

/// Samples per pixel and axis when nothing else is asked for.
const DEFAULT_SAMPLES: u32 = 3;

/// How a scene is shown. Changing a view never rebuilds what the scene has on the graphics card.
///
/// ```
/// use lar_viewer::{Scene, View};
/// let scene = Scene::new();
/// let view = View { background: lar_viewer::WHITE, ..View::fitted(&scene, [1.5; 3], 4.0 / 3.0) };
/// assert!(view.validate().is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the scene is seen from.
    pub camera: Camera,
    /// How far the groups are pulled apart.
    pub explode: Explosion,
    /// What is cut away.
    pub clip: Option<Clip>,
    /// Multiplies the opacity of all meshes; 1 leaves them as they are.
    pub opacity: f32,
    /// Whether cell edges are drawn.
    pub edges: bool,
    /// Silhouettes.
    pub outline: Option<Outline>,
    /// Colour behind everything.
    pub background: Rgb,
    /// Opacity of the background: below 1 the picture is transparent where nothing is drawn.
    pub background_opacity: f32,
    /// Pixels of the picture for one pixel of line width or point size: 2 for a picture to be shown at half size,
    /// the scale factor of the screen in a window.
    pub scale: f32,
    /// Samples per pixel along each axis, 1 to 8, averaged for smooth outlines; reduced where the picture would
    /// outgrow the adapter.
    pub samples: u32,
}

impl Default for View {
    /// The default camera, nothing exploded, slate background.
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            explode: Explosion::default(),
            clip: None,
            opacity: 1.0,
            edges: true,
            outline: None,
            background: SLATE,
            background_opacity: 1.0,
            scale: 1.0,
            samples: DEFAULT_SAMPLES,
        }
    }
}

impl View {
    /// The default three-quarter view of the exploded scene, filling a picture of this aspect (width / height).
    #[must_use]
    pub fn fitted(scene: &Scene, explode: impl Into<Explosion>, aspect: f64) -> Self {
        Self { explode: explode.into(), ..Self::default() }.fit(scene, aspect)
    }

    /// The same view with the scene, as exploded, in the middle and filling the picture. An empty scene leaves the
    /// view unchanged. Takes time linear in the size of the scene.
    #[must_use]
    pub fn fit(self, scene: &Scene, aspect: f64) -> Self {
        Self { camera: self.camera.fit_points(scene.points(self.explode), aspect), ..self }
    }

    /// A full turn about the vertical axis through the target in `n` views, beginning with this one.
    ///
    /// ```
    /// let turn = lar_viewer::View::default().turntable(4);
    /// assert_eq!(turn.len(), 4);
    /// let [east, west] = [turn[0], turn[2]].map(|v| v.camera.eye());
    /// assert!((east[0] + west[0]).abs() < 1e-9 && (east[2] - west[2]).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn turntable(&self, n: u32) -> Vec<Self> {
        let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let orientation = |i| self.camera.orientation.turned(angle(i));
        (0..n)
            .map(|i| Self { camera: Camera { orientation: orientation(i), ..self.camera }, ..*self })
            .collect()
    }

    /// Checks that all parameters are finite and in range.
    ///
    /// # Errors
    /// `InvalidView` with the parameter and its value.
    pub fn validate(&self) -> Result<(), ViewerError> {
        self.camera.validate()?;
        let within = |parameter, value: f64, low: f64, high: f64, expected| {
            let ok = low <= value && value <= high;
            if ok { Ok(()) } else { Err(ViewerError::InvalidView { parameter, value, expected }) }
        };
        for s in self.explode.factors.into_iter().flatten() {
            within("an explode factor", f64::from(s), -1e6, 1e6, "in ±1e6")?;
        }
        for x in self.explode.about.unwrap_or_default() {
            let expected = "at most 1e100 in magnitude";
            within("a coordinate of the explosion's fixed point", x, -1e100, 1e100, expected)?;
        }
        self.clip.map_or(Ok(()), |clip| clip.validate())?;
        self.outline.map_or(Ok(()), |outline| outline.validate())?;
        within("the opacity", f64::from(self.opacity), 0.0, 1.0, "in 0..=1")?;
        let background = f64::from(self.background_opacity);
        within("the background's opacity", background, 0.0, 1.0, "in 0..=1")?;
        within("the scale of lines", f64::from(self.scale), 0.01, 100.0, "in 0.01..=100")?;
        within("the number of samples", f64::from(self.samples), 1.0, 8.0, "in 1..=8")?;
        for c in self.background {
            within("a background channel", f64::from(c), 0.0, 1.0, "in 0..=1")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_refused(view: View, named: &str) {
        let error = view.validate().unwrap_err().to_string();
        assert!(error.contains(named), "{error}");
    }

    #[test]
    fn senseless_views_are_refused() {
        let good = View::default();
        good.validate().unwrap();
        check_refused(View { explode: [1.0, f32::NAN, 1.0].into(), ..good }, "explode factor is NaN");
        check_refused(View { opacity: 1.5, ..good }, "opacity is 1.5");
        let about = Explosion::default().about([0.0, f64::INFINITY, 0.0]);
        check_refused(View { explode: about, ..good }, "fixed point is inf");
        check_refused(
            View { clip: Some(Clip::new([0.0; 3], 1.0)), ..good },
            "length of the clip plane's normal is 0",
        );
        check_refused(View { background_opacity: -0.1, ..good }, "background's opacity is -0.1");
        let outline = Some(Outline { width: f32::NAN, ..Outline::default() });
        check_refused(View { outline, ..good }, "width of outlines is NaN");
        check_refused(View { samples: 0, ..good }, "samples is 0");
        check_refused(View { scale: 0.0, ..good }, "scale of lines is 0");
        check_refused(View { background: [0.0, 2.0, 0.0], ..good }, "background channel is 2");
    }
}
