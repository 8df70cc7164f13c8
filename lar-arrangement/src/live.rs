//! Stage 1i, for one Boolean only: where its surface can be.
//!
//! Space is divided in eight again and again. In a box that no facet of a solid meets the solid's winding number is one
//! number. Where the numbers that are known decide the expression, by the rules of three-valued logic, the box is *dead*: no
//! surface of the result meets it, and what facets have in common there does not matter. Boxes that few facets meet are not
//! divided any more; those that are not dead are *live*.
//!
//! A pair of facets is kept when both meet one live box: then everything that the two have in common outside of dead boxes
//! is found, and stage 6 sees all of the arrangement that touches the result (module `visible`). Facets that overlap in one
//! plane are cut together; they are kept or left out together.
//!
//! Tests of facets against boxes and of points against solids are those of `f64` with a margin: in doubt a facet meets a
//! box, and a number is not known.

use crate::boolean::FillRule;
use crate::boxes::{Aabb, BoxTree, bits_of};
use crate::circuit::{Circuit, Value};
use crate::coplanar::{self, Overlay};
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::soup::Soup;
use crate::union_find::UnionFind;

/// Boxes that no more facets meet are not divided.
const FEW: usize = 8;
/// How often a box is divided, one in another, at most.
const MOST_DIVISIONS: u32 = 16;
/// How often, one in another, without fewer facets in the parts.
const MOST_IN_VAIN: u32 = 2;
/// What a division may cost for each pair of facets, in facets looked at: a small part of the work of finding what two have
/// in common.
const LOOKS_A_PAIR: u64 = 24;
/// For few pairs it may cost so much, and no more than so much for any number of them: a gigabyte of boxes.
const LOOKS: [u64; 2] = [1 << 16, 1 << 27];
/// A box costs as much as so many facets looked at.
const LOOKS_A_BOX: u64 = 32;
/// Steps through the boxes of two facets.
const MOST_STEPS: usize = 256;
/// Margin in grid steps for all that rounding does to a position, and more.
const MARGIN: f64 = 1.0;
/// Pairs of facets a chunk of work.
const PAIRS_A_CHUNK: usize = 4096;
/// Solids with more facets are looked up in the tree of boxes.
const MANY_FACETS: usize = 128;

/// A facet as the division needs it.
struct Plate {
    around: Aabb,
    /// The normal, its largest component 1.
    normal: [f64; 3],
    origin: [f64; 3],
    /// The solid that it is of, when there is only one.
    solid: Option<u32>,
}

impl Plate {
    fn new(soup: &Soup, facet: u32) -> Self {
        let geometry = &soup.geometry;
        let corners =
            soup.facet_edges[facet as usize].iter().map(|&e| geometry.position(soup.directed(e)[0]));
        let normal = geometry.normal(facet);
        let largest = normal.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        Self {
            around: Aabb::around(corners),
            normal: normal.map(|x| x / largest),
            origin: geometry.position(geometry.base(facet)[0]),
            solid: match soup.parents(facet) {
                [parent] => Some(parent.solid),
                _ => None,
            },
        }
    }

    /// The octants of a box, as bits, that it may meet.
    fn octants(&self, b: &Aabb) -> u8 {
        // The octants on the lower and on the upper side along each axis.
        const SIDES: [[u8; 2]; 3] = [[0x55, 0xaa], [0x33, 0xcc], [0x0f, 0xf0]];
        let (mut octants, mut at, mut reach, mut step) = (0xff, 0.0, 2.0 * MARGIN, [0.0; 3]);
        for k in 0..3 {
            let middle = (b.lo[k] + b.hi[k]) / 2.0;
            let below = self.around.lo[k] <= middle + MARGIN && self.around.hi[k] >= b.lo[k] - MARGIN;
            let above = self.around.hi[k] >= middle - MARGIN && self.around.lo[k] <= b.hi[k] + MARGIN;
            octants &= (u8::from(below) * SIDES[k][0]) | (u8::from(above) * SIDES[k][1]);
            at += self.normal[k] * (middle - self.origin[k]);
            step[k] = self.normal[k] * (b.hi[k] - b.lo[k]) / 4.0;
            reach += step[k].abs();
        }
        // From the middle of the box to the middle of each octant, from its plane.
        for octant in 0..8 {
            let off = |k: usize| if octant >> k & 1 == 1 { step[k] } else { -step[k] };
            let meets = (at + off(0) + off(1) + off(2)).abs() <= reach;
            octants &= !(u8::from(!meets) << octant);
        }
        octants
    }
}

/// A box of the division.
#[derive(Clone, Copy)]
enum Node {
    Dead,
    Live,
    /// Its eight parts begin here.
    Divided(u32),
}

/// Space divided into live boxes and dead ones.
pub(crate) struct Live {
    all: Aabb,
    nodes: Vec<Node>,
    boxes: Vec<Aabb>,
    /// The set of facets, overlapping in one plane, that each is in.
    set_of: Vec<u32>,
    sets: Vec<Set>,
}

/// Facets that overlap in one plane, mostly one alone.
struct Set {
    around: Aabb,
    /// The live boxes that it meets, ascending.
    boxes: Vec<u32>,
    /// The stretches of the list of live boxes, as bits, that it meets one of.
    stretches: u128,
}

impl Live {
    /// Divides the space around a soup whose facets meet in pairs. O(pairs) boxes and facets in them.
    pub(crate) fn new(
        soup: &Soup,
        (tree, pairs): (&BoxTree, &[[u32; 2]]),
        circuit: Circuit,
        rule: FillRule,
        course: &Course,
    ) -> Result<Self, Cancelled> {
        let plates = parallel::map_light(soup.n_facets(), |f| Plate::new(soup, f as u32));
        let solids = Solids::new(soup, &plates, tree, rule);
        let all = plates.iter().fold(Aabb::EMPTY, |all, plate| all.joined(&plate.around));
        let unknown = (0..soup.coefficients.len() as u32).collect();
        let (nodes, boxes, found) = (vec![Node::Dead], Vec::new(), Vec::new());
        let mut division = Division { soup, plates: &plates, solids, circuit, nodes, boxes, found, course };
        let facets = (0..plates.len() as u32).collect();
        let looks = (LOOKS_A_PAIR * pairs.len() as u64).clamp(LOOKS[0], LOOKS[1]);
        division.divide(0, &Part { around: all, facets, unknown, divisions: 0, in_vain: 0 }, looks)?;
        let Division { nodes, boxes, found, .. } = division;
        let (set_of, n_sets) = overlapping(soup, pairs, course)?.labels();
        let nowhere = || Set { around: Aabb::EMPTY, boxes: Vec::new(), stretches: 0 };
        let mut sets: Vec<Set> = (0..n_sets).map(|_| nowhere()).collect();
        for (plate, &set) in plates.iter().zip(&set_of) {
            let set = &mut sets[set as usize];
            set.around = set.around.joined(&plate.around);
        }
        let length = boxes.len().div_ceil(u128::BITS as usize).max(1) as u32;
        for (facet, live) in found {
            let set = &mut sets[set_of[facet as usize] as usize];
            if set.boxes.last() != Some(&live) {
                set.boxes.push(live);
                set.stretches |= 1 << (live / length);
            }
        }
        Ok(Self { all, nodes, boxes, set_of, sets })
    }

    /// Whether what two facets have in common may matter.
    pub(crate) fn share(&self, facets: [u32; 2]) -> bool {
        let [f, g] = facets.map(|f| &self.sets[self.set_of[f as usize] as usize]);
        if f.stretches & g.stretches == 0 {
            return false;
        }
        let common = Aabb {
            lo: std::array::from_fn(|k| f.around.lo[k].max(g.around.lo[k]) - MARGIN),
            hi: std::array::from_fn(|k| f.around.hi[k].min(g.around.hi[k]) + MARGIN),
        };
        let (mut a, mut b) = (f.boxes.as_slice(), g.boxes.as_slice());
        // A pair of which that is not known after some steps is kept.
        for _ in 0..MOST_STEPS {
            let (Some((x, after_x)), Some((y, after_y))) = (a.split_first(), b.split_first()) else {
                return false;
            };
            if x == y && common.meets(&self.boxes[*x as usize]) {
                return true;
            }
            if x <= y {
                a = after_x;
            }
            if y <= x {
                b = after_y;
            }
        }
        true
    }

    /// Whether a point, of rounded position, is in a dead box.
    pub(crate) fn is_dead(&self, at: [f64; 3]) -> bool {
        let (mut around, mut node) = (self.all, self.nodes[0]);
        while let Node::Divided(first) = node {
            let octant =
                (0..3).filter(|&k| at[k] > (around.lo[k] + around.hi[k]) / 2.0).map(|k| 1 << k).sum();
            around = octant_of(&around, octant);
            node = self.nodes[first as usize + octant];
        }
        matches!(node, Node::Dead)
    }
}

/// The sets of facets that overlap in one plane.
fn overlapping(soup: &Soup, pairs: &[[u32; 2]], course: &Course) -> Result<UnionFind, Cancelled> {
    let (mut sets, mut overlay) = (UnionFind::new(soup.n_facets()), Overlay::default());
    for chunk in pairs.chunks(PAIRS_A_CHUNK) {
        course.go_on()?;
        for &[f, g] in chunk {
            if soup.geometry.is_coplanar(f, g) && coplanar::overlap(soup, [f, g], &mut overlay) {
                sets.union(f, g);
            }
        }
    }
    Ok(sets)
}

/// A box, the facets that may meet it, and the solids of unknown winding number.
struct Part {
    around: Aabb,
    facets: Vec<u32>,
    unknown: Vec<u32>,
    divisions: u32,
    /// How many of the last divisions left nearly all facets in it.
    in_vain: u32,
}

impl Part {
    /// Its eight parts.
    fn octants(&self, plates: &[Plate], unknown: &[u32]) -> [Self; 8] {
        let mut facets: [Vec<u32>; 8] = Default::default();
        for &facet in &self.facets {
            for octant in bits_of(plates[facet as usize].octants(&self.around)) {
                facets[octant].push(facet);
            }
        }
        let mut facets = facets.into_iter();
        std::array::from_fn(|octant| {
            let facets = facets.next().unwrap_or_default();
            let is_vain = 8 * facets.len() > 7 * self.facets.len();
            Self {
                around: octant_of(&self.around, octant),
                unknown: unknown.to_vec(),
                divisions: self.divisions + 1,
                in_vain: if is_vain { self.in_vain + 1 } else { 0 },
                facets,
            }
        })
    }

    fn is_small(&self) -> bool {
        self.facets.len() <= FEW || self.divisions == MOST_DIVISIONS || self.in_vain == MOST_IN_VAIN
    }

    /// A point of it that is in line with nothing in particular.
    fn sample(&self) -> [f64; 3] {
        const PLACE: [f64; 3] = [0.479_341, 0.527_183, 0.513_707];
        let Aabb { lo, hi } = self.around;
        std::array::from_fn(|k| lo[k] + PLACE[k] * (hi[k] - lo[k]))
    }
}

/// One of the eight parts of a box: bit k of its number says that it is the upper one along axis k.
fn octant_of(around: &Aabb, octant: usize) -> Aabb {
    let Aabb { mut lo, mut hi } = *around;
    for k in 0..3 {
        let middle = (lo[k] + hi[k]) / 2.0;
        *(if octant >> k & 1 == 1 { &mut lo[k] } else { &mut hi[k] }) = middle;
    }
    Aabb { lo, hi }
}

struct Division<'a> {
    soup: &'a Soup,
    plates: &'a [Plate],
    solids: Solids<'a>,
    circuit: Circuit,
    nodes: Vec<Node>,
    boxes: Vec<Aabb>,
    /// Facets and the live boxes that they meet, the latter ascending.
    found: Vec<(u32, u32)>,
    course: &'a Course<'a>,
}

impl Division<'_> {
    /// Divides a part as long as that costs no more than so much, and returns what is left of it.
    fn divide(&mut self, node: usize, part: &Part, mut looks: u64) -> Result<u64, Cancelled> {
        self.course.go_on()?;
        let (learnt, unknown) = self.learn(part);
        if self.circuit.value() == Value::Unknown {
            // A facet meets four octants or so.
            let cost = 4 * part.facets.len() as u64 + 8 * LOOKS_A_BOX;
            if part.is_small() || cost > looks {
                let leaf = self.boxes.len() as u32;
                self.nodes[node] = Node::Live;
                self.boxes.push(part.around);
                self.found.extend(part.facets.iter().map(|&f| (f, leaf)));
            } else {
                let first = self.nodes.len();
                self.nodes[node] = Node::Divided(first as u32);
                self.nodes.resize(first + 8, Node::Dead);
                looks -= cost;
                let octants = part.octants(self.plates, &unknown);
                let mut waiting: u64 = octants.iter().map(|part| part.facets.len() as u64).sum();
                for (octant, part) in octants.iter().enumerate() {
                    // By the facets; what one does not need is for those after it.
                    let n = part.facets.len() as u64;
                    let share = u128::from(looks) * u128::from(n) / u128::from(waiting.max(1));
                    looks = looks - share as u64 + self.divide(first + octant, part, share as u64)?;
                    waiting -= n;
                }
            }
        }
        learnt.into_iter().for_each(|solid| self.circuit.set(solid, Value::Unknown));
        Ok(looks)
    }

    /// Finds the numbers of solids that have no facet in a box: those that were found, and those still unknown.
    fn learn(&mut self, part: &Part) -> (Vec<u32>, Vec<u32>) {
        self.solids.mark(self.soup, &part.facets);
        let sample = part.sample();
        let (mut learnt, mut unknown) = (Vec::new(), Vec::new());
        for &solid in &part.unknown {
            let absent = !self.solids.is_marked(solid);
            match absent.then(|| self.solids.is_inside(self.soup, solid, sample)).flatten() {
                Some(inside) => {
                    self.circuit.set(solid, inside.into());
                    learnt.push(solid);
                }
                None => unknown.push(solid),
            }
        }
        (learnt, unknown)
    }
}

/// The solids by their facets.
struct Solids<'a> {
    around: Vec<Aabb>,
    facets: Vec<Vec<u32>>,
    /// When each was marked last.
    marks: Vec<u32>,
    now: u32,
    plates: &'a [Plate],
    tree: &'a BoxTree,
    rule: FillRule,
}

impl<'a> Solids<'a> {
    fn new(soup: &Soup, plates: &'a [Plate], tree: &'a BoxTree, rule: FillRule) -> Self {
        let n = soup.coefficients.len();
        let (mut around, mut facets) = (vec![Aabb::EMPTY; n], vec![Vec::new(); n]);
        for (plate, facet) in plates.iter().zip(0..) {
            for parent in soup.parents(facet) {
                let solid = parent.solid as usize;
                around[solid] = around[solid].joined(&plate.around);
                facets[solid].push(facet);
            }
        }
        facets.iter_mut().for_each(Vec::dedup);
        Self { around, facets, marks: vec![0; n], now: 0, plates, tree, rule }
    }

    /// Marks the solids that some facets belong to, and no others.
    fn mark(&mut self, soup: &Soup, facets: &[u32]) {
        self.now += 1;
        for &facet in facets {
            match self.plates[facet as usize].solid {
                Some(solid) => self.marks[solid as usize] = self.now,
                None => soup.parents(facet).iter().for_each(|p| self.marks[p.solid as usize] = self.now),
            }
        }
    }

    fn is_marked(&self, solid: u32) -> bool {
        self.marks[solid as usize] == self.now
    }

    /// Whether a point is inside of a solid, when that is beyond doubt.
    fn is_inside(&self, soup: &Soup, solid: u32, at: [f64; 3]) -> Option<bool> {
        let mut winding = Some(0);
        if self.around[solid as usize].meets(&Aabb { lo: at, hi: at }) {
            let facets = &self.facets[solid as usize];
            let mut pass = |facet: u32| {
                let change = winding
                    .and_then(|w| Some(w + passed(soup, &self.plates[facet as usize], facet, solid, at)?));
                winding = change;
            };
            if facets.len() <= MANY_FACETS {
                facets.iter().copied().for_each(pass);
            } else {
                let lo = [f64::NEG_INFINITY, at[1] - MARGIN, at[2] - MARGIN];
                self.tree.query(&Aabb { lo, hi: at.map(|x| x + MARGIN) }, |f| {
                    if soup.parents(f).iter().any(|p| p.solid == solid) {
                        pass(f);
                    }
                });
            }
        }
        winding.map(|w| self.rule.is_inside(w))
    }
}

/// What a facet adds to the winding number of a solid at a point, by the ray towards −x, when that is beyond doubt.
fn passed(soup: &Soup, plate: &Plate, facet: u32, solid: u32, at: [f64; 3]) -> Option<i32> {
    let geometry = &soup.geometry;
    let Plate { around, normal, origin, .. } = plate;
    let is_beside = |k: usize| around.lo[k] > at[k] + MARGIN || around.hi[k] < at[k] - MARGIN;
    if normal[0] == 0.0 || is_beside(1) || is_beside(2) || around.lo[0] > at[0] + MARGIN {
        return Some(0);
    }
    let mut inside = false;
    for &code in &soup.facet_edges[facet as usize] {
        let [p, q] = soup.directed(code).map(|p| {
            let p = geometry.position(p);
            [p[1] - at[1], p[2] - at[2]]
        });
        let above = [p, q].map(|p| p[1] > 0.0);
        if p[1].abs().min(q[1].abs()) <= MARGIN {
            return None;
        }
        if above[0] != above[1] {
            let turn = sure_sign(p[0] * q[1] - q[0] * p[1], p, q)?;
            inside ^= turn == above[1];
        }
    }
    if !inside {
        return Some(0);
    }
    let terms: [f64; 3] = std::array::from_fn(|k| normal[k] * (at[k] - origin[k]));
    let sum: f64 = terms.iter().sum();
    let size: f64 = terms.iter().map(|t| t.abs()).sum();
    // Components of the normal are at most 1.
    if sum.abs() <= 3.0 * MARGIN + size * 2f64.powi(-48) {
        return None;
    }
    if (sum > 0.0) != (normal[0] > 0.0) {
        return Some(0);
    }
    let of_solid = soup.parents(facet).iter().filter(|p| p.solid == solid);
    let jump: i32 = of_solid.map(|p| soup.jump(p)).sum();
    // The ray comes out in front where the normal points to −x.
    Some(if normal[0] < 0.0 { jump } else { -jump })
}

/// Whether the determinant of two vectors is positive, when rounding cannot have decided that.
fn sure_sign(det: f64, p: [f64; 2], q: [f64; 2]) -> Option<bool> {
    let sizes = p[0].abs() + p[1].abs() + q[0].abs() + q[1].abs();
    let products = (p[0] * q[1]).abs() + (q[0] * p[1]).abs();
    (det.abs() > (sizes + MARGIN) * MARGIN + products * 2f64.powi(-50)).then_some(det > 0.0)
}
