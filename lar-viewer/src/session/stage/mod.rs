//! A complex on show as drawables: pieces that explode, and what each of them shows.
//!
//! A *unit* is a cell in no other cell's boundary: a cell of the highest dimension, or an open sheet, a lone edge. It is
//! drawn with its boundary, and the boundary moves with it. Groups are nested: solid, unit, face, edge. How fine the
//! drawables are is chosen by what moves: as long as only cells do, a cell is three drawables whatever its size.
//!
//! Pieces are one scene and what stands out of them (numbers, selection, chains, measurements) another, in the same groups.
//! Hiding and colours change appearances of pieces only, selection the other scene only; the pieces are built anew when their
//! fineness changes.
//!
//! A partition of the plane has its faces at different heights when it is exploded along z: each is lifted by the number of
//! edges between it and the exterior, so that a face comes out of the one it lies in.

mod lift;
mod lone;
mod looks;
mod shapes;
mod standing_out;

use super::{Pieces, Session};
use crate::{Appearance, CellData, CellRef, Drawable, GroupId, Scene, ViewerError};
use shapes::{dots, fill, lines};
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// Where a piece belongs: its unit, and the face, edge and vertex of the unit that it is, as far as it is one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    unit: CellRef,
    face: Option<u32>,
    edge: Option<u32>,
    vertex: Option<u32>,
}

impl Place {
    fn unit(unit: CellRef) -> Self {
        Self { unit, face: None, edge: None, vertex: None }
    }

    /// The cell of lower dimension than its unit that the piece is.
    fn below(&self) -> Option<CellRef> {
        let cell = |dim, index: Option<u32>| Some(CellRef { dim, index: index? });
        cell(0, self.vertex).or(cell(1, self.edge)).or(cell(2, self.face))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Fill,
    Edges,
    Dots,
}

impl Kind {
    /// What a unit itself is drawn as.
    fn of(unit: CellRef) -> Self {
        match unit.dim {
            0 => Self::Dots,
            1 => Self::Edges,
            _ => Self::Fill,
        }
    }
}

/// Drawables of a complex, and what they show.
#[derive(Clone, Debug)]
pub struct Stage {
    fineness: Pieces,
    pieces: Arc<Scene>,
    /// Of each drawable of the pieces.
    roles: Vec<(Kind, Place)>,
    groups: BTreeMap<Place, GroupId>,
    /// Where the number of each cell of each dimension stands, once it was asked for.
    numbers_at: [Vec<OnceLock<[f64; 3]>>; 4],
}

impl Stage {
    /// The complex taken apart into pieces of this fineness. O(size · log size).
    ///
    /// # Errors
    /// `Coordinate` when a centroid is not finite.
    pub fn new(data: &CellData, fineness: Pieces) -> Result<Self, ViewerError> {
        let units = data.units();
        let lifts = lift::lifts(data, &units);
        let mut builder = Builder {
            data,
            fineness,
            pieces: Scene::new(),
            roles: Vec::new(),
            groups: BTreeMap::new(),
            lone: lone::curves(data),
        };
        let middles: Vec<[f64; 3]> = units
            .iter()
            .zip(lifts)
            .map(|(&unit, lift)| {
                let [x, y, z] = data.middle(unit);
                [x, y, z + lift]
            })
            .collect();
        let solids = builder.push_solids(&units, &middles)?;
        for ((&unit, solid), middle) in units.iter().zip(solids).zip(middles) {
            builder.push_unit(unit, solid, middle)?;
        }
        let Builder { pieces, roles, groups, .. } = builder;
        let numbers_at = std::array::from_fn(|dim| match dim as u8 {
            dim if dim <= data.dim() => vec![OnceLock::new(); data.n_cells(dim)],
            _ => Vec::new(),
        });
        Ok(Self { fineness, pieces: Arc::new(pieces), roles, groups, numbers_at })
    }

    /// The fineness.
    #[must_use]
    pub fn fineness(&self) -> Pieces {
        self.fineness
    }

    /// All pieces, whether they are shown or not.
    #[must_use]
    pub fn pieces(&self) -> &Arc<Scene> {
        &self.pieces
    }

    /// Everything that a session shows as one scene, for a picture: what stands out, then all pieces as they look. Drawn in
    /// this order, what stands out covers the faces that it lies in.
    ///
    /// # Errors
    /// Those of [`Scene::push`].
    pub fn scene(&self, session: &Session) -> Result<Scene, ViewerError> {
        let mut scene = self.standing_out(session)?;
        for (drawable, look) in self.pieces.drawables().iter().zip(self.appearances(session)) {
            scene.push(drawable.clone().looking(look))?;
        }
        Ok(scene)
    }

    /// How all pieces look now.
    #[must_use]
    pub fn appearances(&self, session: &Session) -> Vec<Appearance> {
        looks::looks(self.pieces.drawables(), &self.roles, session)
    }
}

/// A stage in the making.
struct Builder<'a> {
    data: &'a CellData,
    fineness: Pieces,
    pieces: Scene,
    roles: Vec<(Kind, Place)>,
    groups: BTreeMap<Place, GroupId>,
    /// How long the curves are that lone edges are part of.
    lone: BTreeMap<u32, f64>,
}

impl Builder<'_> {
    /// The groups of the solids that the units belong to: of the first that contains it, or of its own.
    fn push_solids(
        &mut self,
        units: &[CellRef],
        middles: &[[f64; 3]],
    ) -> Result<Vec<Option<GroupId>>, ViewerError> {
        let data = self.data;
        let solid_of = |unit: CellRef| {
            data.solids_of(unit).first().copied().or_else(|| data.parents(unit).first().map(|p| p.solid))
        };
        let mut sums: BTreeMap<u32, ([f64; 3], f64)> = BTreeMap::new();
        for (&unit, middle) in units.iter().zip(middles) {
            if let (Some(solid), false) = (solid_of(unit), data.is_exterior(unit)) {
                let (sum, n) = sums.entry(solid).or_default();
                (0..3).for_each(|k| sum[k] += middle[k]);
                *n += 1.0;
            }
        }
        let mut groups = BTreeMap::new();
        for (solid, (sum, n)) in sums {
            groups.insert(solid, self.pieces.push_group(sum.map(|x| x / n))?);
        }
        let group = |(unit, middle): (&CellRef, &[f64; 3])| match solid_of(*unit) {
            _ if data.is_exterior(*unit) => Ok(None),
            Some(solid) => Ok(groups.get(&solid).copied()),
            None => self.pieces.push_group(*middle).map(Some),
        };
        units.iter().zip(middles).map(group).collect()
    }

    fn push_unit(
        &mut self,
        unit: CellRef,
        solid: Option<GroupId>,
        middle: [f64; 3],
    ) -> Result<(), ViewerError> {
        let data = self.data;
        let place = Place::unit(unit);
        let group = self.push_place(place, solid, middle)?;
        let closure = data.closure([unit]);
        let below = |p: usize| closure.get(p).map_or(&[][..], Vec::as_slice);
        let by_face = self.fineness != Pieces::Cells && unit.dim == 3;
        if !by_face {
            return self.push_piece(place, group, below(2), below(1), below(0));
        }
        for &face in below(2) {
            let cell = CellRef { dim: 2, index: face };
            let place = Place { face: Some(face), ..place };
            let group = self.push_place(place, group, data.middle(cell))?;
            let of_face = data.closure([cell]);
            self.push_piece(place, group, &[face], &of_face[1], &of_face[0])?;
        }
        Ok(())
    }

    /// Triangles of faces, edges and vertices that move together, or each edge, each vertex for itself.
    fn push_piece(
        &mut self,
        place: Place,
        group: Option<GroupId>,
        faces: &[u32],
        edges: &[u32],
        vertices: &[u32],
    ) -> Result<(), ViewerError> {
        let data = self.data;
        self.push_drawable(Kind::Fill, place, group, fill(data, place.unit, faces))?;
        let together = lines(data, edges);
        let lone = self.lone.get(&place.unit.index).filter(|_| place.unit.dim == 1);
        let curve = lone.copied().or(together.curve()).unwrap_or_default();
        if self.fineness < Pieces::Edges {
            self.push_drawable(Kind::Edges, place, group, together.of_curve(curve))?;
        } else {
            for &edge in edges {
                let middle = data.middle(CellRef { dim: 1, index: edge });
                let place = Place { edge: Some(edge), ..place };
                let group = self.push_place(place, group, middle)?;
                self.push_drawable(Kind::Edges, place, group, lines(data, &[edge]).of_curve(curve))?;
            }
        }
        if self.fineness < Pieces::Vertices {
            return self.push_drawable(Kind::Dots, place, group, dots(data, vertices));
        }
        for &vertex in vertices {
            let place = Place { vertex: Some(vertex), ..place };
            self.push_drawable(Kind::Dots, place, group, dots(data, &[vertex]))?;
        }
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
        let group = self.pieces.push_subgroup(around, centroid)?;
        self.groups.insert(place, group);
        Ok(Some(group))
    }

    fn push_drawable(
        &mut self,
        kind: Kind,
        place: Place,
        group: Option<GroupId>,
        drawable: Drawable,
    ) -> Result<(), ViewerError> {
        if drawable.n_elements() == 0 {
            return Ok(());
        }
        let drawable = drawable.cell(place.unit);
        self.pieces.push(match group {
            Some(group) => drawable.group(group),
            None => drawable,
        })?;
        self.roles.push((kind, place));
        Ok(())
    }
}
