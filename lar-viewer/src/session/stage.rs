//! A complex on show as drawables: pieces that explode, and what each of them shows.
//!
//! A *unit* is a cell in no other cell's boundary: a cell of the highest dimension, or an open sheet, a lone edge. It is
//! drawn with its boundary, and the boundary moves with it. Groups are nested: solid, unit, face, edge. How fine the
//! drawables are is chosen by what moves: as long as only cells do, a cell is three drawables whatever its size.
//!
//! Hiding, colours, selection change appearances only; the stage is built anew when the fineness changes.

use super::{Highlight, Pieces, Session, coloring};
use crate::{
    Appearance, CellData, CellRef, Drawable, GroupId, INK, Rgb, Scene, TextStyle, ViewerError, WHITE,
    push_numbers,
};
use lar_core::{Points, TriangleMesh};
use std::collections::BTreeMap;

/// Opacity of what is not part of a highlighted chain.
const GHOST: f32 = 0.18;
/// Opacity of a translucent exterior.
const FAINT: f32 = 0.12;
/// Opacity of the exterior as a shell.
const SHELL: f32 = 0.45;
/// Colours of positive and negative cells of a chain.
const SIGN_COLORS: [Rgb; 2] = [[0.99, 0.55, 0.10], [0.15, 0.55, 0.98]];
/// Colour of a selected face, edge or vertex.
const SELECTED: Rgb = [1.0, 0.85, 0.15];
/// Colour of the chain of a replay, of its boundary, and of the corolla.
const REPLAY_COLORS: [Rgb; 3] = [[0.93, 0.33, 0.28], [0.98, 0.85, 0.20], [0.26, 0.52, 0.90]];
/// Edges and vertices on a dark background, and the sum of channels below which it is dark.
const PALE: Rgb = [0.78, 0.80, 0.84];
const DARK: f32 = 0.6;
/// Colour of points and lines that are measured.
const MEASURED: Rgb = [0.95, 0.25, 0.60];

/// Where a piece belongs: its unit, and the face and edge of the unit that it is, as far as it is one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    unit: CellRef,
    face: Option<u32>,
    edge: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Fill,
    Edges,
    Dots,
}

/// Drawables of a complex, and what they show.
#[derive(Clone, Debug)]
pub struct Stage {
    pieces: Pieces,
    /// Groups without drawables.
    ground: Scene,
    drawables: Vec<Drawable>,
    roles: Vec<(Kind, Place)>,
    groups: BTreeMap<Place, GroupId>,
}

impl Stage {
    /// The complex taken apart into pieces of this fineness. O(size · log size).
    ///
    /// # Errors
    /// `Coordinate` when a centroid is not finite.
    pub fn new(data: &CellData, pieces: Pieces) -> Result<Self, ViewerError> {
        let mut stage = Self {
            pieces,
            ground: Scene::new(),
            drawables: Vec::new(),
            roles: Vec::new(),
            groups: BTreeMap::new(),
        };
        let units = data.units();
        let solids = stage.push_solids(data, &units)?;
        for (&unit, solid) in units.iter().zip(solids) {
            stage.push_unit(data, unit, solid)?;
        }
        Ok(stage)
    }

    /// The fineness.
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        self.pieces
    }

    /// The groups of the solids that the units belong to: of the first that contains it, or of its own.
    fn push_solids(
        &mut self,
        data: &CellData,
        units: &[CellRef],
    ) -> Result<Vec<Option<GroupId>>, ViewerError> {
        let solid_of = |unit: CellRef| {
            data.solids_of(unit).first().copied().or_else(|| data.parents(unit).first().map(|p| p.solid))
        };
        let mut sums: BTreeMap<u32, ([f64; 3], f64)> = BTreeMap::new();
        for &unit in units {
            if let (Some(solid), false) = (solid_of(unit), data.is_exterior(unit)) {
                let (sum, n) = sums.entry(solid).or_default();
                let centroid = data.middle(unit);
                (0..3).for_each(|k| sum[k] += centroid[k]);
                *n += 1.0;
            }
        }
        let mut groups = BTreeMap::new();
        for (solid, (sum, n)) in sums {
            groups.insert(solid, self.ground.push_group(sum.map(|x| x / n))?);
        }
        let group = |unit: &CellRef| match solid_of(*unit) {
            _ if data.is_exterior(*unit) => Ok(None),
            Some(solid) => Ok(groups.get(&solid).copied()),
            None => self.ground.push_group(data.middle(*unit)).map(Some),
        };
        units.iter().map(group).collect()
    }

    fn push_unit(
        &mut self,
        data: &CellData,
        unit: CellRef,
        solid: Option<GroupId>,
    ) -> Result<(), ViewerError> {
        let place = Place { unit, face: None, edge: None };
        let group = self.push_place(place, solid, data.middle(unit))?;
        let closure = data.closure([unit]);
        let below = |p: usize| closure.get(p).map_or(&[][..], Vec::as_slice);
        let by_face = self.pieces != Pieces::Cells && unit.dim == 3;
        if !by_face {
            return self.push_piece(data, place, group, below(2), below(1), below(0));
        }
        for &face in below(2) {
            let centroid = data.middle(CellRef { dim: 2, index: face });
            let place = Place { unit, face: Some(face), edge: None };
            let group = self.push_place(place, group, centroid)?;
            let of_face = data.closure([CellRef { dim: 2, index: face }]);
            self.push_piece(data, place, group, &[face], &of_face[1], &of_face[0])?;
        }
        Ok(())
    }

    /// Triangles of faces, edges and vertices that move together, or each edge for itself.
    fn push_piece(
        &mut self,
        data: &CellData,
        place: Place,
        group: Option<GroupId>,
        faces: &[u32],
        edges: &[u32],
        vertices: &[u32],
    ) -> Result<(), ViewerError> {
        self.push_drawable(Kind::Fill, place, group, fill(data, place.unit, faces));
        if self.pieces == Pieces::Edges {
            for &edge in edges {
                let place = Place { edge: Some(edge), ..place };
                let group = self.push_place(place, group, data.middle(CellRef { dim: 1, index: edge }))?;
                self.push_drawable(Kind::Edges, place, group, lines(data, &[edge]));
            }
        } else {
            self.push_drawable(Kind::Edges, place, group, lines(data, edges));
        }
        self.push_drawable(Kind::Dots, place, group, dots(data, vertices));
        Ok(())
    }

    /// The group of a place inside another; the exterior has none.
    fn push_place(
        &mut self,
        place: Place,
        around: Option<GroupId>,
        centroid: [f64; 3],
    ) -> Result<Option<GroupId>, ViewerError> {
        let Some(around) = around else { return Ok(None) };
        let group = self.ground.push_subgroup(around, centroid)?;
        self.groups.insert(place, group);
        Ok(Some(group))
    }

    fn push_drawable(&mut self, kind: Kind, place: Place, group: Option<GroupId>, drawable: Drawable) {
        if 0 < drawable.n_elements() {
            let drawable = drawable.cell(place.unit);
            self.drawables.push(match group {
                Some(group) => drawable.group(group),
                None => drawable,
            });
            self.roles.push((kind, place));
        }
    }

    /// The scene of a session: numbers and what stands out first, then all pieces as they look. Drawn in this order, what stands out
    /// covers the faces that it lies in.
    ///
    /// # Errors
    /// Those of [`Scene::push`].
    pub fn scene(&self, session: &Session) -> Result<Scene, ViewerError> {
        let mut scene = self.ground.clone();
        push_numbers(&mut scene, self.numbered(session), &TextStyle::default(), true)?;
        for drawable in self.standing_out(session) {
            scene.push(drawable)?;
        }
        for (drawable, look) in self.drawables.iter().zip(self.looks(session)) {
            scene.push(Drawable { appearance: look, ..drawable.clone() })?;
        }
        Ok(scene)
    }

    /// How all drawables of a scene that was made by [`scene`](Self::scene) look now.
    #[must_use]
    pub fn appearances(&self, scene: &Scene, session: &Session) -> Vec<Appearance> {
        let n_standing_out = scene.drawables().len().saturating_sub(self.drawables.len());
        let standing_out = scene.drawables().iter().take(n_standing_out).map(Drawable::appearance);
        standing_out.chain(self.looks(session)).collect()
    }

    /// How the pieces look, in the order of the drawables.
    fn looks(&self, session: &Session) -> Vec<Appearance> {
        let data = session.data();
        let colors: Vec<Vec<Rgb>> =
            (0..=data.dim()).map(|dim| coloring::colors(session.coloring, data, dim)).collect();
        let look = |(drawable, &(kind, place)): (&Drawable, &(Kind, Place))| {
            let shown = Self::is_shown(session, kind, place);
            let own = drawable.appearance();
            let face = place.face.filter(|_| session.visibility().layers[2]);
            let colored = face.map_or(place.unit, |index| CellRef { dim: 2, index });
            let (color, opacity) = match kind {
                Kind::Fill if data.is_exterior(place.unit) => (WHITE, exterior_opacity(session)),
                Kind::Fill => (colors[usize::from(colored.dim)][colored.index as usize], session.opacity),
                Kind::Edges | Kind::Dots if is_dark(session.background) => (PALE, 1.0),
                Kind::Edges | Kind::Dots => (own.color, 1.0),
            };
            let opacity = opacity * ghost(session, place.unit, kind);
            let highlighted = kind == Kind::Fill && session.selected() == Some(place.unit);
            Appearance { visible: shown, highlighted, color, opacity }
        };
        self.drawables.iter().zip(&self.roles).map(look).collect()
    }

    fn is_shown(session: &Session, kind: Kind, place: Place) -> bool {
        let (visibility, data) = (session.visibility(), session.data());
        let layers = visibility.layers;
        let in_layer = match kind {
            Kind::Fill => layers[2] || (data.dim() == 3 && layers[3] && place.unit.dim == 3),
            Kind::Edges => layers[1],
            Kind::Dots => layers[0],
        };
        let sub = place.edge.map(|e| (1, e)).or(place.face.map(|f| (2, f)));
        let alone = sub.is_none_or(|(dim, index)| visibility.shows(CellRef { dim, index }));
        let unit = session.draws(place.unit) || (sub.is_some() && visibility.isolates_below(place.unit));
        in_layer && alone && unit
    }

    /// Selection, highlighted chain, replay and measurements as drawables of their own.
    fn standing_out(&self, session: &Session) -> Vec<Drawable> {
        let data = session.data();
        let mut found = Vec::new();
        if let Some(cell) = session.selected().filter(|c| !self.is_unit(*c)) {
            found.extend(self.cells(session, &[(cell, SELECTED)], None));
        }
        if let Some(Highlight { chain, within, .. }) = session.highlight() {
            let dim = chain.dim() as u8;
            let signed = chain
                .entries()
                .iter()
                .map(|&(index, sign)| (CellRef { dim, index }, SIGN_COLORS[usize::from(sign < 0)]));
            let signed: Vec<_> = signed.filter(|(c, _)| !self.is_unit(*c)).collect();
            found.extend(self.cells(session, &signed, *within));
        }
        if let Some(replay) = session.replay() {
            let step = replay.step();
            let mut parts = vec![(&step.chain, REPLAY_COLORS[0]), (&step.boundary, REPLAY_COLORS[1])];
            if replay.shows_corolla() {
                parts.push((&step.corolla, REPLAY_COLORS[2]));
            }
            for (chain, color) in parts {
                let dim = chain.dim() as u8;
                let cells: Vec<_> =
                    chain.entries().iter().map(|&(index, _)| (CellRef { dim, index }, color)).collect();
                found.extend(self.cells(session, &cells, Some(replay.cell())));
            }
        }
        found.extend(measured(session.measuring().points()));
        debug_assert!(found.iter().all(|d| d.cell_ref().is_none_or(|c| data.contains(c))));
        found
    }

    /// The cells that carry their numbers, each once: in the first unit that is drawn.
    fn numbered(&self, session: &Session) -> Vec<(CellRef, [f64; 3], Option<GroupId>)> {
        let data = session.data();
        let mut found = Vec::new();
        for dim in (0..=data.dim()).filter(|&dim| session.numbers()[usize::from(dim)]) {
            let cells = (0..data.n_cells(dim) as u32).map(|index| CellRef { dim, index });
            for cell in cells.filter(|&c| session.visibility().shows(c)) {
                let unit = data.units_of(cell).into_iter().find(|&unit| session.draws(unit));
                let group = unit.and_then(|unit| Some((unit, *self.groups_of(data, unit, cell).first()?)));
                found.extend(group.map(|(_, group)| (cell, data.middle(cell), group)));
            }
        }
        found
    }

    fn is_unit(&self, cell: CellRef) -> bool {
        cell.dim == 3 || self.groups.contains_key(&Place { unit: cell, face: None, edge: None })
    }

    /// Cells in these colours, in every unit that has them and is drawn, or in one.
    fn cells(&self, session: &Session, cells: &[(CellRef, Rgb)], within: Option<CellRef>) -> Vec<Drawable> {
        let data = session.data();
        let mut found = Vec::new();
        for &(cell, color) in cells {
            let mut units = within.map_or_else(|| data.units_of(cell), |unit| vec![unit]);
            if within.is_none() && units.iter().any(|&u| session.draws(u)) {
                units.retain(|&u| session.draws(u));
            }
            for unit in units {
                let drawable = match cell.dim {
                    0 => dots(data, &[cell.index]).size(11.0),
                    1 => lines(data, &[cell.index]).width(5.0),
                    _ => fill(data, unit, &[cell.index]),
                };
                let drawable = drawable.color(color).cell(unit);
                found.extend(self.groups_of(data, unit, cell).into_iter().map(|group| match group {
                    Some(group) => drawable.clone().group(group),
                    None => drawable.clone(),
                }));
            }
        }
        found
    }

    /// The groups in which a cell of a unit is drawn.
    fn groups_of(&self, data: &CellData, unit: CellRef, cell: CellRef) -> Vec<Option<GroupId>> {
        let by_face = unit.dim == 3 && self.pieces != Pieces::Cells && cell.dim <= 2;
        let faces =
            if by_face { data.cells_above(cell, 2).into_iter().map(Some).collect() } else { vec![None] };
        let edge = (cell.dim == 1 && self.pieces == Pieces::Edges).then_some(cell.index);
        let places = faces.into_iter().map(|face| Place { unit, face, edge });
        let found: Vec<_> = places.filter_map(|place| self.groups.get(&place)).map(|&g| Some(g)).collect();
        let whole = self.groups.get(&Place { unit, face: None, edge: None }).copied();
        if found.is_empty() { vec![whole] } else { found }
    }
}

fn is_dark(color: Rgb) -> bool {
    color.iter().sum::<f32>() < DARK
}

fn exterior_opacity(session: &Session) -> f32 {
    match session.visibility().exterior {
        super::Exterior::Translucent => FAINT,
        super::Exterior::Shell | super::Exterior::Hidden => SHELL,
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

/// The triangles of faces of a unit, turned outwards.
fn fill(data: &CellData, unit: CellRef, faces: &[u32]) -> Drawable {
    let (mut triangles, mut cells) = (Vec::new(), Vec::new());
    for &face in faces {
        let own = data.triangles(face);
        triangles.extend_from_slice(own);
        cells.extend(own.iter().map(|_| CellRef { dim: 2, index: face }));
    }
    let mut used = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let corners: Vec<[f64; 3]> = used.iter().filter_map(|&v| data.position(v)).collect();
    for v in triangles.as_flattened_mut() {
        *v = used.partition_point(|u| u < v) as u32;
    }
    let mesh = TriangleMesh { points: Points::from_xyz(&corners), triangles };
    Drawable::mesh(unit.to_string(), mesh).element_cells(cells)
}

fn lines(data: &CellData, edges: &[u32]) -> Drawable {
    let ends = |&e: &u32| Some((e, data.segment(e)?));
    let (cells, segments): (Vec<u32>, Vec<_>) = edges.iter().filter_map(ends).unzip();
    let cells = cells.into_iter().map(|index| CellRef { dim: 1, index });
    Drawable::edges("edges", segments).element_cells(cells)
}

fn dots(data: &CellData, vertices: &[u32]) -> Drawable {
    let points = vertices.iter().filter_map(|&v| data.position(v));
    Drawable::points("vertices", points)
        .color(INK)
        .element_cells(vertices.iter().map(|&index| CellRef { dim: 0, index }))
}

fn measured(points: &[[f64; 3]]) -> Vec<Drawable> {
    if points.is_empty() {
        return Vec::new();
    }
    let segments = points.windows(2).map(|w| [w[0], w[1]]);
    let lines = Drawable::lines("measured", segments).width(2.5).color(MEASURED).unclipped();
    vec![Drawable::points("measured", points.iter().copied()).size(10.0).color(MEASURED).unclipped(), lines]
}
