//! The lar command.
fn main() {}
