//! Three rods through each other at right angles, the cells of their arrangement, and their Booleans.

use super::collection::{Drawn, Request};
use super::gallery::counts;
use super::parts::{Part, cyclic, exploded};
use super::sheet::{Panel, Sheet, lettered};
use crate::shapes::{self, Shapes};
use crate::{CommandError, scenes};
use lar_arrangement::{Arrangement, Detail, Expression, FillRule, Solid, arrange};
use lar_viewer::Coloring;
use std::fmt::Write;

/// Sides of a rod.
const SIDES: usize = 32;

const EXPRESSIONS: [(&str, &str); 4] = [
    ("union", "A | B | C"),
    ("intersection", "A & B & C"),
    ("difference", "A - (B | C)"),
    ("in two at least", "A & B | B & C | C & A"),
];

/// The rods, their cells exploded, and four Booleans.
pub(super) fn rods(request: &Request) -> Result<Drawn, CommandError> {
    let surfaces = scenes::surfaces(&scenes::three_rods(SIDES)?)?;
    let arrangement = arrange(&surfaces)?;
    let inputs = (0..).zip(&surfaces).map(|(i, s)| shapes::surface(s, i)).collect::<Result<Vec<_>, _>>()?;
    let mut panels = vec![Panel::new(cyclic(inputs, 1.0)), Panel::new(cells(&arrangement)?)];
    let mut numbers = counts(&arrangement);
    for ((i, letter), (name, text)) in (3..).zip('c'..).zip(EXPRESSIONS) {
        let solid = arrangement.boolean(&Expression::parse(text, &["A", "B", "C"])?, FillRule::NonZero)?;
        writeln!(
            numbers,
            "({letter}) {name:<17}{text:<23}volume {:.6}, area {:.6}",
            solid.volume(),
            solid.area()
        )
        .expect("a string takes all text");
        panels.push(Panel::new(boolean(name, &solid, i)?));
    }
    let figure = Sheet { panels: lettered(panels), columns: 3 }.figure(
        "rods",
        "three rods and their Booleans",
        320,
        request.size,
    )?;
    Ok(Drawn { numbers, figures: vec![figure] })
}

fn cells(arrangement: &Arrangement) -> Result<Vec<Part>, CommandError> {
    let shapes = Shapes::new(arrangement)?;
    Ok(cyclic(exploded(shapes.bounded_cells()?, [1.7; 3]), 1.0))
}

fn boolean(name: &str, solid: &Solid<'_>, i: usize) -> Result<[Part; 2], CommandError> {
    let result = solid.to_complex(Detail::Simplified);
    Ok(Part::of_cell(shapes::complex_whole(name, &result.complex)?, Coloring::Cyclic.color(i), 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The common part of three round cylinders of radius 1 at right angles has the volume 8 (2 − √2); that of
    /// polygons with many sides is a little less.
    #[test]
    fn the_common_part_is_the_tricylinder() {
        let surfaces = scenes::surfaces(&scenes::three_rods(64).unwrap()).unwrap();
        let arrangement = arrange(&surfaces).unwrap();
        let expression = Expression::parse("A & B & C", &["A", "B", "C"]).unwrap();
        let volume = arrangement.boolean(&expression, FillRule::NonZero).unwrap().volume();
        let round = 8.0 * (2.0 - 2.0_f64.sqrt());
        assert!(0.99 * round < volume && volume < round, "{volume} of {round}");
    }
}
