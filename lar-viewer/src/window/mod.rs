//! The window: winit for the events, egui for the panels, the off-screen renderer for the picture.
//!
//! The scene is drawn into a texture of its own, which egui then places between its panels; so the window needs nothing
//! from its surface but that it can show colours, and draws the same pixels as a picture file. Everything between input
//! and texture ([`controls`], [`subject`], the panels) runs without a window, and is tested without one.

mod app;
mod capture;
mod controls;
mod exhibit;
mod keys;
mod loader;
mod navigation;
mod painter;
mod panels;
mod picture;
mod subject;
mod surface;

pub use exhibit::{Exhibit, Exploration, NoQueries, Queries, Source};

use crate::{Scene, View, ViewerError};
use app::Contents;
use loader::Loaded;
use winit::event_loop::{ControlFlow, EventLoop};

/// Opens a window on a scene and returns when it is closed.
///
/// Left drag turns, right, middle or shift drag moves, the wheel zooms to the cursor; F fits, 1 to 7 look along the axes, P
/// switches between perspective and orthographic, F1 lists all keys, Esc closes. A side panel explodes the scene per axis,
/// sets opacity and background; pictures and turns are saved as `lar-N.png` and so on in the working directory.
///
/// On macOS this must be called from the main thread; a process can open one window in its life.
///
/// # Errors
/// `NoDisplay` without a display, `NoAdapter`, `InvalidView`, `SceneTooLarge`, `Gpu`, or `Window` with the message of
/// the window system.
///
/// ```no_run
/// use lar_viewer::{Scene, View};
/// let mut scene = Scene::new();
/// lar_viewer::push_axes(&mut scene, 1.0)?;
/// let view = View::fitted(&scene, [1.0; 3], 1.5);
/// lar_viewer::view(scene, view, "axes")?;
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
#[doc(alias = "VIEW")]
pub fn view(scene: Scene, view: View, title: impl Into<String>) -> Result<(), ViewerError> {
    view.validate()?;
    run(Contents::Scene(Box::new((scene, view))), title.into())
}

/// Opens a window on a complex and returns when it is closed: its cells can be picked, walked along boundaries and
/// coboundaries, hidden, exploded, cut, measured, combined by Boolean expressions, and wrapped step by step. Files dropped on
/// the window are loaded in place of the first ones, and files that change are loaded again; what is wrong with them is said
/// below the picture.
///
/// ```no_run
/// use lar_core::{ChainComplex, cuboid_grid};
/// use lar_viewer::session::Session;
/// use lar_viewer::{CellData, Exhibit, Exploration, NoQueries, Source};
/// struct Fixed;
/// impl Source for Fixed {
///     fn load(&self, _: &[std::path::PathBuf]) -> Result<Exhibit, String> {
///         Err("nothing is read here".to_owned())
///     }
/// }
/// let grid = CellData::new(ChainComplex::from_model(&cuboid_grid(&[3, 2, 1]))?)?;
/// lar_viewer::explore(Exploration {
///     session: Session::new(grid),
///     queries: Box::new(NoQueries),
///     source: Box::new(Fixed),
///     files: vec![],
///     camera: None,
///     title: "grid".to_owned(),
/// })?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As [`view`].
pub fn explore(exploration: Exploration) -> Result<(), ViewerError> {
    if let Some(camera) = exploration.camera {
        camera.validate()?;
    }
    let title = exploration.title.clone();
    run(Contents::Complex(Box::new(exploration)), title)
}

fn run(contents: Contents, title: String) -> Result<(), ViewerError> {
    let event_loop = event_loop()?;
    event_loop.set_control_flow(ControlFlow::Wait);
    let mut app = app::App::new(contents, title, &event_loop)?;
    event_loop.run_app(&mut app).map_err(|e| ViewerError::Window(e.to_string()))?;
    app.into_result()
}

fn event_loop() -> Result<EventLoop<Loaded>, ViewerError> {
    let mut builder = EventLoop::with_user_event();
    #[cfg(target_os = "linux")]
    {
        use winit::platform::{wayland, x11};
        x11::EventLoopBuilderExtX11::with_any_thread(&mut builder, true);
        wayland::EventLoopBuilderExtWayland::with_any_thread(&mut builder, true);
    }
    builder.build().map_err(|e| match e {
        winit::error::EventLoopError::RecreationAttempt => ViewerError::Window(e.to_string()),
        _ => ViewerError::NoDisplay(reason(&e.to_string()).to_owned()),
    })
}

/// A message of the window library without the line of its own source that it begins with.
fn reason(message: &str) -> &str {
    let after_place = message.strip_prefix("os error at ").and_then(|m| m.split_once(": "));
    after_place.map_or(message, |(_, reason)| reason).trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::reason;

    #[test]
    fn messages_name_no_source_lines() {
        let message = "os error at /src/winit/mod.rs:765: neither WAYLAND_DISPLAY nor DISPLAY is set.";
        assert_eq!(reason(message), "neither WAYLAND_DISPLAY nor DISPLAY is set");
        assert_eq!(reason("not supported: here"), "not supported: here");
    }
}
