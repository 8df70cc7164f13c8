//! Ear clipping that always finishes: the fallback for broken loops, and the quick way for small intact ones.
//!
//! Every node of the ring waits in a heap, the best ear first: (0) proper ears, the shortest diagonal first
//! (which keeps triangles, and with them the searches, small), (1) flat ones, (2) convex corners with
//! something inside, the smallest first, (3) reflex corners, the smallest first, (4) corners between two copies
//! of one point. A corner that is not an ear because of one node waits at that node, and is looked at again when the
//! node goes or turns convex. Without any rounding damage only class 0 is ever cut (two-ears theorem), and so
//! the result is a true triangulation; with damage the least bad corner goes, and the laws still hold, because
//! cutting any corner off a ring of distinct points keeps them (over bridges they are checked afterwards).
//!
//! Cost: O(n log n) for ordinary polygons, with searches in a tree of boxes; O(n²) in the worst case, since
//! corners are looked at again at most [`WAKES`] × n times in all and one look is O(n).

use crate::flat::Flat;
use crate::predicates::{Xy, in_closed_triangle, orient};
use crate::ring::Ring;
use crate::tree::Tree;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

const NONE: u32 = u32::MAX;
/// Further looks at blocked corners, per node; 20 times what spirals, combs and sieves of 10^5 corners need.
const WAKES: usize = 64;
/// Rings up to this size are searched node by node, larger ones through the tree.
const WITHOUT_TREE: usize = 48;

const PROPER: u8 = 0;
const FLAT: u8 = 1;
const BLOCKED: u8 = 2;
const REFLEX: u8 = 3;
const DOUBLE: u8 = 4;

/// A place in the queue: class, size within the class (the bits of a non-negative number, which order like it),
/// sequence number, node, the node's version.
type Place = Reverse<(u8, u64, u32, u32, u32)>;

/// A corner waiting at a node: corner, its version, next in the list.
type Waiting = (u32, u32, u32);

/// Buffers of the ear clipping.
#[derive(Debug, Default)]
pub(crate) struct Ears {
    pub(crate) ring: Ring,
    xy: Vec<Xy>,
    /// Current version of each node's place; `NONE` once the node is cut off.
    version: Vec<u32>,
    /// Strictly convex, or cut off.
    convex: Vec<bool>,
    not_convex: usize,
    queue: BinaryHeap<Place>,
    sequence: u32,
    waiting: Vec<Waiting>,
    waiting_at: Vec<u32>,
    wakes_left: usize,
    tree: Tree,
}

impl Ears {
    /// Triangles (of corners) of a face whose points are identified; true when all of them have positive area.
    pub(crate) fn clip(&mut self, flat: &Flat, triangles: &mut Vec<[u32; 3]>) -> bool {
        self.start(flat);
        let nodes = self.xy.len();
        let mut proper = true;
        for _ in 3..nodes {
            let Some((class, node)) = self.pop() else { break };
            proper &= class == PROPER;
            self.cut(node, flat, triangles);
        }
        let Some((_, last)) = self.pop() else { return proper };
        let rest = self.corners(last);
        triangles.push(rest.map(|i| self.ring.corner[i as usize]));
        proper && self.turn(rest) > 0.0
    }

    fn start(&mut self, flat: &Flat) {
        self.ring.join(flat);
        let nodes = self.ring.corner.len();
        self.xy.clear();
        self.xy.extend(self.ring.corner.iter().map(|&c| flat.xy[c as usize]));
        self.version.clear();
        self.version.resize(nodes, 0);
        self.convex.clear();
        self.convex.resize(nodes, true);
        self.not_convex = 0;
        self.queue.clear();
        self.sequence = 0;
        self.waiting.clear();
        self.waiting_at.clear();
        self.waiting_at.resize(nodes, NONE);
        self.wakes_left = nodes * WAKES;
        if nodes > WITHOUT_TREE {
            self.tree.fill(&self.xy);
        }
        for node in 0..nodes as u32 {
            self.update_convex(node);
        }
        for node in 0..nodes as u32 {
            self.queue_up(node, flat);
        }
    }

    fn pop(&mut self) -> Option<(u8, u32)> {
        loop {
            let Reverse((class, _, _, node, version)) = self.queue.pop()?;
            if self.version[node as usize] == version {
                return Some((class, node));
            }
        }
    }

    fn cut(&mut self, node: u32, flat: &Flat, triangles: &mut Vec<[u32; 3]>) {
        let [a, b, c] = self.corners(node);
        triangles.push([a, b, c].map(|i| self.ring.corner[i as usize]));
        self.ring.next[a as usize] = c;
        self.ring.prev[c as usize] = a;
        self.version[b as usize] = NONE;
        self.set_convex(b, true);
        let freed = [true, self.update_convex(a), self.update_convex(c)];
        self.queue_up(a, flat);
        self.queue_up(c, flat);
        for (node, _) in [b, a, c].into_iter().zip(freed).filter(|&(_, freed)| freed) {
            self.wake(node, flat);
        }
    }

    /// Looks again at the corners that wait at a node.
    fn wake(&mut self, node: u32, flat: &Flat) {
        let mut at = std::mem::replace(&mut self.waiting_at[node as usize], NONE);
        while at != NONE && self.wakes_left > 0 {
            let (corner, version, next) = self.waiting[at as usize];
            if self.version[corner as usize] == version {
                self.wakes_left -= 1;
                self.queue_up(corner, flat);
            }
            at = next;
        }
    }

    /// True when the node has just become strictly convex.
    fn update_convex(&mut self, node: u32) -> bool {
        let convex = self.turn(self.corners(node)) > 0.0;
        self.set_convex(node, convex) && convex
    }

    /// True when that is news.
    fn set_convex(&mut self, node: u32, convex: bool) -> bool {
        let changed = std::mem::replace(&mut self.convex[node as usize], convex) != convex;
        if changed {
            self.not_convex = if convex { self.not_convex - 1 } else { self.not_convex + 1 };
            if self.xy.len() > WITHOUT_TREE {
                self.tree.set(node, !convex);
            }
        }
        changed
    }

    /// Gives the node a new place in the queue.
    fn queue_up(&mut self, node: u32, flat: &Flat) {
        let version = self.version[node as usize].wrapping_add(1) % NONE;
        self.version[node as usize] = version;
        let corners = self.corners(node);
        let [a, _, c] = corners.map(|i| flat.ids[self.ring.corner[i as usize] as usize]);
        let turn = self.turn(corners);
        let (class, size) = if a == c {
            (DOUBLE, 0.0)
        } else if turn < 0.0 {
            (REFLEX, -turn)
        } else if turn == 0.0 {
            (FLAT, 0.0)
        } else if let Some(blocker) = self.blocker(corners) {
            self.waiting.push((node, version, self.waiting_at[blocker as usize]));
            self.waiting_at[blocker as usize] = self.waiting.len() as u32 - 1;
            (BLOCKED, turn)
        } else {
            (PROPER, self.gap(corners))
        };
        self.sequence += 1;
        self.queue.push(Reverse((class, size.to_bits(), self.sequence, node, version)));
    }

    /// A node of the ring, not strictly convex, inside or on the triangle and not at one of its corners.
    fn blocker(&mut self, corners: [u32; 3]) -> Option<u32> {
        if self.not_convex == 0 {
            return None;
        }
        let Self { xy, convex, tree, .. } = self;
        let triangle = corners.map(|i| xy[i as usize]);
        let blocks = |&i: &u32| {
            let p = xy[i as usize];
            !convex[i as usize] && !triangle.contains(&p) && in_closed_triangle(triangle, p)
        };
        if xy.len() <= WITHOUT_TREE { (0..xy.len() as u32).find(blocks) } else { tree.find(triangle, blocks) }
    }

    fn corners(&self, node: u32) -> [u32; 3] {
        [self.ring.prev[node as usize], node, self.ring.next[node as usize]]
    }

    /// Squared length of the diagonal that cuts the ear off.
    fn gap(&self, [a, _, c]: [u32; 3]) -> f64 {
        let (a, c) = (self.xy[a as usize], self.xy[c as usize]);
        (c[0] - a[0]).powi(2) + (c[1] - a[1]).powi(2)
    }

    fn turn(&self, corners: [u32; 3]) -> f64 {
        let [a, b, c] = corners.map(|i| self.xy[i as usize]);
        orient(a, b, c)
    }
}
