//! The data of a simulation with cloths that may tear: its scene, and meshes with copies of vertices.

use super::assembly::Assembly;
use crate::model::tearing::{Tear, TornEdge};
use crate::scene::Scene;
use crate::world::Cloth;
use selvedge_core::glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// The data of a simulation with cloths that may tear.
#[derive(Debug)]
pub(super) struct Tearing {
    /// The original scene, except for the meshes of its cloths.
    pub(super) scene: Scene,
    pub(super) torn: Vec<TornEdge>,
    /// The cloths and the vertices that would be split by tears that had no room to open. They stay whole until the next step
    /// that tries again.
    pub(super) waiting: BTreeSet<(usize, u32)>,
    /// The velocity of the wind that the caller has set last.
    pub(super) wind: Option<DVec3>,
}

/// Meshes of a scene's cloths in which something has torn.
pub(super) struct Meshes {
    pub(super) cloths: Vec<Cloth>,
    /// The old vertex of each vertex, among all, or its original.
    pub(super) from: Vec<u32>,
}

/// The vertex that a fan gets, for a cloth, its vertex that is split, and the fan's place.
pub(super) type Copies = BTreeMap<(usize, u32, usize), u32>;

impl Tearing {
    pub(super) fn new(scene: Scene) -> Self {
        Self {
            scene,
            torn: Vec::new(),
            waiting: BTreeSet::new(),
            wind: None,
        }
    }

    /// Assembles the scene with other meshes of its cloths; on failure, restores the old ones.
    pub(super) fn assemble(&mut self, cloths: Vec<Cloth>) -> Option<Assembly> {
        let before = std::mem::replace(&mut self.scene.cloths, cloths);
        let made = Assembly::of(&self.scene).ok();
        if made.is_none() {
            self.scene.cloths = before;
        }
        made
    }

    /// Stores tears that cannot open now.
    pub(super) fn put_off(&mut self, tears: &[Tear]) {
        let splits = tears.iter().flat_map(|tear| {
            let vertices = tear.splits.iter().map(|(vertex, _)| *vertex);
            vertices.map(|vertex| (tear.cloth, vertex))
        });
        self.waiting.extend(splits);
    }

    pub(super) fn cut(&self, tears: &[Tear], numbered: &Numbering) -> Option<(Meshes, Copies)> {
        let mut cloths = self.scene.cloths.clone();
        let (mut copies, mut of_copies) = (Copies::new(), vec![Vec::new(); cloths.len()]);
        for tear in tears {
            let mesh = &mut cloths[tear.cloth].mesh;
            for (vertex, fans) in &tear.splits {
                for (place, fan) in fans.iter().enumerate().skip(1) {
                    let copy = (mesh.positions.len() + of_copies[tear.cloth].len()) as u32;
                    of_copies[tear.cloth].push(*vertex);
                    copies.insert((tear.cloth, *vertex, place), copy);
                    for &triangle in fan {
                        let corners = mesh.triangles[triangle as usize].iter_mut();
                        corners.filter(|corner| *corner == vertex).for_each(|corner| *corner = copy);
                    }
                }
            }
        }
        let mut from = Vec::new();
        for (index, (cloth, copied)) in cloths.iter_mut().zip(&of_copies).enumerate() {
            let first = numbered.first_of_cloths[index];
            from.extend(
                (0..cloth.mesh.positions.len() as u32)
                    .chain(copied.iter().copied())
                    .map(|own| first + own),
            );
            let all = [cloth.copy_sources(), copied].concat();
            let triangles = std::mem::take(&mut cloth.mesh.triangles);
            cloth.tear(all, triangles).ok()?;
        }
        from.extend(numbered.bodies.clone());
        Some((Meshes { cloths, from }, copies))
    }
}

/// The places of cloths and bodies among all vertices.
pub(super) struct Numbering {
    pub(super) first_of_cloths: Vec<u32>,
    pub(super) bodies: std::ops::Range<u32>,
}

/// The data of a checkpoint's cloths, before the simulation continues with them.
pub(super) struct Retorn {
    pub(super) made: Assembly,
    pub(super) cloths: Vec<Cloth>,
    pub(super) from: Vec<u32>,
}
