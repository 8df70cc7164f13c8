//! Example scenes.
