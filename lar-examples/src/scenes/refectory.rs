//! The refectory: tables and chairs in a hierarchy, each kind of part stored once.

use super::SceneError;
use lar_core::mapper::cuboid;
use lar_core::{Node, Struct, r, t};
use std::f64::consts::PI;
use std::sync::Arc;

/// Height of a table, thickness of its top, and side of its legs, in metres.
const TABLE: [f64; 3] = [0.75, 0.04, 0.07];
/// Length and width of a table.
const TOP: [f64; 2] = [1.8, 0.9];
/// Height of a seat, its thickness, and side of the legs.
const CHAIR: [f64; 3] = [0.46, 0.04, 0.05];
/// Side of a seat, and height of the back above it.
const SEAT: [f64; 2] = [0.44, 0.45];
/// Places along a side of a table.
const PLACES: usize = 3;
/// From the middle of one table to the next, along and across.
const AISLES: [f64; 2] = [2.7, 2.6];

/// A hall of `columns` × `rows` settings.
///
/// ```
/// let hall = lar_examples::scenes::refectory(4, 3)?;
/// // A table is 5 boxes, a chair 6, and there are 6 chairs at each of 12 tables.
/// assert_eq!(hall.eval_struct()?.len(), 12 * (5 + 6 * 6));
/// # Ok::<(), lar_examples::scenes::SceneError>(())
/// ```
///
/// # Errors
/// None: the parts' sizes are fixed and good.
pub fn refectory(columns: usize, rows: usize) -> Result<Struct, SceneError> {
    let setting = Arc::new(setting()?);
    let places = (0..columns).flat_map(|i| (0..rows).map(move |j| [i as f64, j as f64]));
    let place = |[i, j]: [f64; 2]| {
        let by = t(&[AISLES[0] * i, AISLES[1] * j, 0.0]);
        Node::from(Struct::new("place").with(by).with(setting.clone()))
    };
    Ok(Struct::from_nodes("refectory", places.map(place).collect::<Vec<_>>()))
}

/// A table about the origin with three chairs on each side, facing it.
///
/// # Errors
/// None: the parts' sizes are fixed and good.
pub fn setting() -> Result<Struct, SceneError> {
    let (table, chair) = (table()?, Arc::new(chair()?));
    let mut setting = Struct::new("setting").with(table);
    for k in 0..PLACES {
        let x = TOP[0] * ((k as f64 + 0.5) / PLACES as f64 - 0.5);
        for turn in [0.0, PI] {
            let along = if turn == 0.0 { x } else { -x };
            let by = t(&[along, -0.5 * TOP[1] - 0.12, 0.0]);
            setting.push(Struct::new("seat").with(r([0.0, 0.0, turn])).with(by).with(chair.clone()));
        }
    }
    Ok(setting)
}

/// A top on four legs.
fn table() -> Result<Struct, SceneError> {
    let [height, thickness, leg] = TABLE;
    let [x, y] = TOP.map(|side| 0.5 * side);
    let top = cuboid(&[-x, -y, height - thickness], &[x, y, height])?;
    let table = Struct::new("table").with_category("table").with(("top", top));
    legs(table, [x - leg, y - leg], leg, height - thickness)
}

/// A seat on four legs with a back behind it, at the smaller y.
fn chair() -> Result<Struct, SceneError> {
    let [height, thickness, leg] = CHAIR;
    let [side, back] = [0.5 * SEAT[0], SEAT[1]];
    let seat = cuboid(&[-side, -side, height - thickness], &[side, side, height])?;
    let rest = cuboid(&[-side, -side, height], &[side, thickness - side, height + back])?;
    let chair = Struct::new("chair").with_category("chair").with(("seat", seat)).with(("back", rest));
    legs(chair, [side - leg, side - leg], leg, height - thickness)
}

/// With four legs of this side and height, their inner corners at (±x, ±y).
fn legs(container: Struct, [x, y]: [f64; 2], side: f64, height: f64) -> Result<Struct, SceneError> {
    let leg = Arc::new(cuboid(&[0.0; 3], &[side, side, height])?);
    let corners = [[x, y], [-x - side, y], [x, -y - side], [-x - side, -y - side]];
    let place = |[x, y]: [f64; 2]| Struct::new("corner").with(t(&[x, y, 0.0])).with(("leg", leg.clone()));
    Ok(corners.into_iter().map(place).fold(container, Struct::with))
}
