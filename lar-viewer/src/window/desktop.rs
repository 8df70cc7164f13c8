//! Windows on a desktop, opened by a call that returns when they are closed.

use super::app::{App, Contents};
use super::exhibit::Exploration;
use super::host::Desktop;
use super::loader::{Loaded, Loader};
use crate::{Scene, View, ViewerError};
use std::cell::Cell;
use std::rc::Rc;
use winit::event_loop::{ControlFlow, EventLoop, EventLoopProxy};

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
    run(Contents::scene(scene, view), title.into(), |_| None)
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
    let Exploration { session, queries, source, files, camera, title } = exploration;
    let contents = Contents::complex(session, queries, camera.unwrap_or_default(), camera.is_none())?;
    let loader = |proxy: EventLoopProxy<Loaded>| {
        // Without a loop there is no one to tell.
        Some(Loader::start(source, files, move |loaded| _ = proxy.send_event(loaded)))
    };
    run(contents, title, loader)
}

fn run(
    contents: Contents,
    title: String,
    loader: impl FnOnce(EventLoopProxy<Loaded>) -> Option<Loader>,
) -> Result<(), ViewerError> {
    let event_loop = event_loop()?;
    event_loop.set_control_flow(ControlFlow::Wait);
    let failure = Rc::new(Cell::new(None));
    let slot = Rc::clone(&failure);
    let failed = Box::new(move |error| slot.set(Some(error)));
    let display = event_loop.owned_display_handle();
    let app = App::new(contents, title, display, Box::new(Desktop::new()), failed);
    let mut app = match loader(event_loop.create_proxy()) {
        Some(loader) => app.with_loader(loader),
        None => app,
    };
    event_loop.run_app(&mut app).map_err(|e| ViewerError::Window(e.to_string()))?;
    failure.take().map_or(Ok(()), Err)
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
