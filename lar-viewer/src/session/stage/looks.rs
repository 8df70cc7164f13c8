//! How pieces look: shown or hidden, coloured, faint beside what stands out.

use super::{Kind, Place};
use crate::session::{Exterior, Highlight, Session, coloring};
use crate::{Appearance, CellRef, Drawable, Rgb, WHITE};

/// Opacity of what is not part of a highlighted chain.
const GHOST: f32 = 0.18;
/// Opacity of a translucent exterior.
const FAINT: f32 = 0.12;
/// Opacity of the exterior as a shell.
const SHELL: f32 = 0.45;
/// Edges and vertices on a dark background, and the sum of channels below which it is dark.
const PALE: Rgb = [0.78, 0.80, 0.84];
const DARK: f32 = 0.6;

/// How pieces look, in their order.
pub(super) fn looks(drawables: &[Drawable], roles: &[(Kind, Place)], session: &Session) -> Vec<Appearance> {
    let data = session.data();
    let colors: Vec<Vec<Rgb>> =
        (0..=data.dim()).map(|dim| coloring::colors(session.coloring, data, dim)).collect();
    let look = |(drawable, &(kind, place)): (&Drawable, &(Kind, Place))| {
        let own = drawable.appearance();
        let face = place.face.filter(|_| session.visibility().layers[2]);
        let colored = face.map_or(place.unit, |index| CellRef { dim: 2, index });
        let (color, opacity) = match kind {
            Kind::Fill if data.is_exterior(place.unit) => (WHITE, exterior_opacity(session)),
            Kind::Fill => {
                let solid = data.solids_of(place.unit).first();
                let own = solid.map_or(1.0, |&s| session.visibility().opacity_of(s));
                (colors[usize::from(colored.dim)][colored.index as usize], session.opacity * own)
            }
            Kind::Edges | Kind::Dots if is_dark(session.background) => (PALE, 1.0),
            Kind::Edges | Kind::Dots => (own.color, 1.0),
        };
        let opacity = opacity * ghost(session, place.unit, kind);
        let highlighted = kind == Kind::of(place.unit) && session.selected() == Some(place.unit);
        Appearance { visible: is_shown(session, kind, place), highlighted, color, opacity }
    };
    drawables.iter().zip(roles).map(look).collect()
}

/// What is isolated is shown whatever layers there are; everything else by its layer, and if its unit is drawn.
fn is_shown(session: &Session, kind: Kind, place: Place) -> bool {
    let (visibility, data) = (session.visibility(), session.data());
    let layers = visibility.layers;
    let (dim, in_layer) = match kind {
        Kind::Fill => (2, layers[2] || (data.dim() == 3 && layers[3] && place.unit.dim == 3)),
        Kind::Edges => (1, layers[1]),
        Kind::Dots => (0, layers[0]),
    };
    let alone = place.below().is_none_or(|cell| visibility.shows(cell));
    if visibility.isolates_below(place.unit) {
        let isolated = visibility.isolated_dim() == Some(dim);
        let hidden = data.is_exterior(place.unit) && visibility.exterior == Exterior::Hidden;
        return alone && place.below().is_some() && (isolated || in_layer) && !hidden;
    }
    in_layer && alone && session.draws(place.unit)
}

fn is_dark(color: Rgb) -> bool {
    color.iter().sum::<f32>() < DARK
}

fn exterior_opacity(session: &Session) -> f32 {
    match session.visibility().exterior {
        Exterior::Translucent => FAINT,
        Exterior::Shell | Exterior::Hidden => SHELL,
    }
}

/// What the opacity of a unit is multiplied by: less than 1 when a chain stands out that it is not part of.
fn ghost(session: &Session, unit: CellRef, kind: Kind) -> f32 {
    let in_chain =
        |h: &Highlight| h.chain.dim() == usize::from(unit.dim) && h.chain.coefficient(unit.index) != 0;
    let stands_back = session.replay().is_some() || session.highlight().is_some_and(|h| !in_chain(h));
    match kind {
        Kind::Fill if stands_back => GHOST,
        Kind::Edges | Kind::Dots if stands_back => 2.0 * GHOST,
        _ => 1.0,
    }
}
