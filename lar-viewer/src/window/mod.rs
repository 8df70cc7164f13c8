//! The window: winit for the events, egui for the panels, the off-screen renderer for the picture.
//!
//! The scene is drawn into a texture of its own, which egui then places between its panels; so the window needs nothing
//! from its surface but that it can show colours, and draws the same pixels as a picture file. Everything between input
//! and texture ([`controls`], [`subject`], the panels) runs without a window, and is tested without one. Desktops and browsers
//! differ in how the loop of events begins and in what a [`Host`] does.

mod app;
#[cfg(target_arch = "wasm32")]
mod browser;
mod capture;
mod controls;
#[cfg(not(target_arch = "wasm32"))]
mod desktop;
mod exhibit;
mod host;
mod input;
mod keys;
#[cfg_attr(target_arch = "wasm32", allow(dead_code, reason = "browsers load no files"))]
mod loader;
mod navigation;
mod painter;
mod panels;
mod picture;
mod subject;
mod surface;

#[cfg(target_arch = "wasm32")]
pub use browser::open;
#[cfg(not(target_arch = "wasm32"))]
pub use desktop::{explore, view};
pub use exhibit::{Exhibit, Exploration, Source};
pub use host::Host;
