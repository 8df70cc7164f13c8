//! Stage 1h: which facets may have something in common.

use crate::apart;
use crate::beams::{self, TARGETS_A_PASS};
use crate::boxes::{Aabb, BoxTree, Near};
use crate::canonical::Input;
use crate::charts::Charts;
use crate::crowds::{self, Voxels};
use crate::curve;
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::soup::Soup;
use crate::stars::Stars;
use std::sync::OnceLock;

/// For fewer targets every facet is looked at for each `TARGETS_A_PASS` of them.
const TARGETS_WORTH_A_TREE: usize = 8 * TARGETS_A_PASS;

/// Pairs of facets, and what they were found with.
pub(crate) struct Meeting {
    /// The boxes of all facets, once they are needed.
    tree: OnceLock<BoxTree>,
    charts: Charts,
    stars: Stars,
    /// Those whose boxes meet, without those that a chart or a clean point settles, or that the plane of one keeps apart.
    pub pairs: Vec<[u32; 2]>,
}

impl Meeting {
    /// Boxes are larger by `reach`; `distance` is that of points that are nearly one.
    pub(crate) fn new(soup: &Soup, distance: f64, reach: f64, course: &Course) -> Result<Self, Cancelled> {
        let all = hull(soup).larger(reach);
        let voxels = || Voxels::new(soup, &all, reach);
        // It is not known yet whether voxels are needed, but mostly they are, and another thread has nothing else to do.
        let mut ahead = None;
        let look_ahead = soup.n_facets() >= crowds::MANY && parallel::n_threads() > 1;
        let charts = Charts::new(soup, distance, course, || ahead = look_ahead.then(voxels))?;
        let stars = Stars::new(soup, &charts, distance);
        let is_open = |[f, g]: [u32; 2], sizes: [f32; 2]| {
            !charts.are_one(f, g)
                && !stars.settle(&soup.geometry, f, g)
                && !apart::are_apart(soup, [f, g], sizes, reach)
        };
        let keeps_off = |f: u32, target: &Near<3>| apart::keeps_off(soup, f, target, reach);
        let tree = OnceLock::new();
        let pairs = match crowds::facets(soup, &charts, || ahead.unwrap_or_else(voxels)) {
            Some(crowded) => {
                let facet = |i: u32| crowded[i as usize];
                let box_of = |i| box_of(soup, facet(i)).larger(reach);
                let tree = BoxTree::grouped(&all, crowded.len(), box_of, |i| charts.of(facet(i)));
                let pairs = tree.pairs(
                    course,
                    |pair, sizes| is_open(pair.map(facet), sizes),
                    |i, target| keeps_off(facet(i), target),
                )?;
                pairs.into_iter().map(|pair| pair.map(facet)).collect()
            }
            None => {
                let box_of = |f| box_of(soup, f).larger(reach);
                let all_facets = BoxTree::grouped(&all, soup.n_facets(), box_of, |f| charts.of(f));
                tree.get_or_init(|| all_facets).pairs(course, is_open, keeps_off)?
            }
        };
        Ok(Self { tree, charts, stars, pairs })
    }

    pub(crate) fn input<'a>(&'a self, soup: &'a Soup) -> Input<'a> {
        Input { soup, pairs: &self.pairs, charts: &self.charts, stars: &self.stars }
    }

    /// The boxes of the facets, to be searched.
    pub(crate) fn boxes<'a>(&'a self, soup: &'a Soup) -> Boxes<'a> {
        Boxes { soup, tree: &self.tree }
    }
}

/// The boxes of all facets.
#[derive(Clone, Copy)]
pub(crate) struct Boxes<'a> {
    soup: &'a Soup,
    tree: &'a OnceLock<BoxTree>,
}

impl<'a> Boxes<'a> {
    pub(crate) fn tree(&self) -> &'a BoxTree {
        self.tree.get_or_init(|| {
            let box_of = |f| box_of(self.soup, f);
            BoxTree::within(&hull(self.soup), self.soup.n_facets(), box_of)
        })
    }

    /// Makes ready for so many targets.
    pub(crate) fn prepare(&self, n_targets: usize) {
        if n_targets >= TARGETS_WORTH_A_TREE {
            self.tree();
        }
    }

    /// The facets whose boxes meet each of some others, up to rounding.
    pub(crate) fn meeting(&self, targets: &[Aabb]) -> Vec<Vec<u32>> {
        let Some(tree) = self.tree.get() else {
            return targets
                .chunks(TARGETS_A_PASS)
                .flat_map(|targets| beams::facets_in(self.soup, targets))
                .collect();
        };
        let in_tree = |target: &Aabb| {
            let mut found = Vec::new();
            tree.query(target, |facet| found.push(facet));
            found
        };
        targets.iter().map(in_tree).collect()
    }
}

/// The box around all points.
fn hull(soup: &Soup) -> Aabb {
    let position = |p: u32| soup.geometry.position(p);
    curve::hull(soup.geometry.n_points(), |p| Aabb { lo: position(p), hi: position(p) })
}

/// The box around a facet. O(its edges).
pub(crate) fn box_of(soup: &Soup, facet: u32) -> Aabb {
    let position = |p: u32| soup.geometry.position(p);
    match &soup.facet_edges[facet as usize] {
        [_, _, _] => Aabb::around(soup.geometry.base(facet).map(position)),
        edges => Aabb::around(edges.iter().map(|&e| position(soup.directed(e)[0]))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crossing::{self, Contacts, Scratch};
    use crate::progress::Control;
    use crate::soup::Placed;
    use lar_core::{Points, Surface, icosphere};

    /// Pairs that the plane of a large triangle keeps apart have no contact, and are most of those in its box.
    #[test]
    fn what_a_large_triangle_is_kept_apart_from_does_not_touch_it() {
        let ball = Surface::from_triangles("ball", &icosphere(4));
        let large = |points: [[f64; 3]; 3]| {
            let mut surface = Surface::new("large", Points::from_xyz(&points));
            surface.push_face([&[0, 1, 2][..]], 1);
            surface
        };
        let through = large([[-2.0, -2.0, -1.5], [2.0, -1.0, 0.5], [0.5, 2.0, 1.5]]);
        let beside = large([[3.0, 0.0, 0.1], [0.0, 3.0, 0.1], [0.0, 0.1, 3.0]]);
        let surfaces = [ball, through, beside];
        let soup = Soup::new(&surfaces, Placed::snapped(&surfaces, |_, _| 0.0).expect("finite points"));
        let n = soup.n_facets() as u32;
        let course = Course::new(Control::default(), &[]);
        for reach in [0.0, 8.0] {
            let meeting = Meeting::new(&soup, reach, reach, &course).expect("nobody cancels");
            let (mut n_touching, mut n_left_out) = (0, 0);
            for (f, large) in (0..n - 2).flat_map(|f| [(f, n - 2), (f, n - 1)]) {
                if !box_of(&soup, f).meets(&box_of(&soup, large)) {
                    continue;
                }
                let mut contacts = Contacts::default();
                crossing::meet(&soup, f, large, &mut Scratch::default(), &mut contacts);
                let is_pair = meeting.pairs.contains(&[f, large]);
                let touches = contacts.crossing_pairs > 0 || !contacts.coplanar.is_empty();
                assert!(is_pair || !touches, "{f} touches {large}");
                n_touching += u32::from(touches);
                n_left_out += u32::from(!is_pair);
            }
            assert!(n_touching > 100 && n_left_out > 1000, "{n_touching} touch, {n_left_out} are left out");
        }
    }
}
