//! A step of a world: refits moving meshes, finds meshes that are near each other, and decides their pairs.

use super::handles::{MeshHandle, Places};
use super::mesh::{Moves, RowsAt, WorldMesh};
use super::vertex_path::{vertex_paths, vertices_of};
use crate::broad_phase::{Hierarchies, MeshHierarchy, Pairing, Rows};
use crate::engine::{PairEngine, Question, Refine, Source, Wanted};
use crate::step::{Contact, Motions, StepError};
use selvedge_core::elementary::Limits;
use selvedge_core::paths::{Path, RigidMotion, separation_of_pieces, time_of_impact};
use std::cmp::Ordering;

/// The largest number of vertices of all meshes. Rows are numbered by `u32`, and up to half of their places are unused.
pub(crate) const MOST_VERTICES: usize = u32::MAX as usize / 2;

/// All meshes, and the buffers of a step.
#[derive(Debug)]
pub(crate) struct Stage {
    pub(crate) meshes: Places<WorldMesh>,
    hierarchy: MeshHierarchy,
    /// The meshes in the hierarchy, in ascending order.
    handles: Vec<MeshHandle>,
    /// True if meshes or groups differ from those in the hierarchy.
    pub(crate) are_others: bool,
    pub(crate) engine: PairEngine,
    pub(crate) vertices: usize,
    /// True if boxes were made for another separation.
    pub(crate) must_fit: bool,
    /// The meshes that moved in the last step.
    moved: Vec<MeshHandle>,
    near: Vec<[u32; 2]>,
    rows: PlacedRows,
    /// The meshes of each source of the last step.
    pub(crate) sources: Vec<[MeshHandle; 2]>,
}

/// A mesh's motion in a step.
pub(crate) type Given<'a> = (MeshHandle, &'a dyn Motions, Moves);

impl Stage {
    pub(crate) fn new() -> Self {
        Self {
            meshes: Places::new(),
            hierarchy: MeshHierarchy::new(),
            handles: Vec::new(),
            are_others: false,
            engine: PairEngine::new(),
            vertices: 0,
            must_fit: false,
            moved: Vec::new(),
            near: Vec::new(),
            rows: PlacedRows::default(),
            sources: Vec::new(),
        }
    }

    /// Finds the contacts of a step. The given meshes exist, and each is given once.
    pub(crate) fn run(&mut self, given: &[Given<'_>], question: &Question) -> Result<(), StepError> {
        self.set_motions(given, question.limits.separation);
        self.hierarchy.find(&mut self.near);
        self.place_rows();

        let meshes = &self.meshes;
        let mut sources = Vec::new();
        // The meshes and motions of sources that have a rotating mesh.
        let mut rotating = Vec::new();
        self.sources.clear();
        for &handle in &self.moved {
            let Some(mesh) = meshes.get(handle) else { continue };
            if mesh.moves == Moves::Deforming && mesh.groups.collide(mesh.groups) {
                sources.extend(Source::within(&mesh.hierarchies, *question));
                rotating.extend([None; 2]);
                self.sources.extend([[handle; 2]; 2]);
            }
        }
        for pair in &self.near {
            let [a, b] = pair.map(|index| self.handles[index as usize]);
            let (Some(first), Some(second)) = (meshes.get(a), meshes.get(b)) else {
                continue;
            };
            let (there, back) = ([first, second], [second, first]);
            let pairings = Pairing::all_between(&first.hierarchies, &second.hierarchies);
            for (pairing, (meshes, handles)) in pairings.into_iter().zip([(there, [a, b]), (back, [b, a]), (there, [a, b])]) {
                let motions = meshes.map(|mesh| mesh.moves.turning());
                let are_single = meshes.iter().all(|mesh| mesh.hierarchies.rows().single().is_some());
                let rows = self.rows.rows.put_slices(are_single);
                let first_rows = meshes.map(PlacedRows::first_of);
                sources.push(Source::between(
                    pairing,
                    rows,
                    first_rows,
                    question_on_pieces(question, meshes),
                ));
                rotating.push(motions.iter().any(Option::is_some).then_some((pairing.meshes, motions)));
                self.sources.push(handles);
            }
        }
        let refine = |source: usize, contact: &Contact<f64>| match &rotating[source] {
            None => Some(contact.time),
            Some((meshes, motions)) => time_on_paths(*meshes, motions, &question.limits, contact),
        };
        let refine: Option<&Refine<'_>> = rotating.iter().any(Option::is_some).then_some(&refine);
        self.engine.prepare(&sources);
        if self.engine.run(&sources, question.wanted, 1.0, refine) {
            self.observe();
        }
        self.engine.stop.result()
    }

    /// Returns the earliest contact of the last step, with its source.
    pub(crate) fn earliest(&self) -> Option<(usize, &Contact<f64>)> {
        let all = self.engine.contacts();
        let all = all.flat_map(|(source, found)| found.iter().map(move |contact| (source, contact)));
        all.min_by(|(a_source, a), (b_source, b)| {
            let by_time = a.time.partial_cmp(&b.time).unwrap_or(Ordering::Equal);
            let place = |source: &usize, contact: &Contact<f64>| (contact.kind, self.sources[*source], contact.pair);
            by_time.then_with(|| place(a_source, a).cmp(&place(b_source, b)))
        })
    }

    /// Refits meshes that move, and meshes that have come to rest.
    fn set_motions(&mut self, given: &[Given<'_>], separation: f64) {
        for &(handle, motions, moves) in given {
            if let Some(mesh) = self.meshes.get_mut(handle) {
                mesh.set_motion(motions, moves, separation);
            }
        }
        let mut listed: Vec<_> = given.iter().map(|&(handle, ..)| handle).collect();
        listed.sort_unstable();
        let rests = |handle: &MeshHandle| listed.binary_search(handle).is_err();
        if self.must_fit {
            self.moved = self.meshes.iter().map(|(handle, _)| handle).collect();
            self.must_fit = false;
        }
        self.moved.retain(rests);
        for &handle in &self.moved {
            // Otherwise it was removed.
            if let Some(mesh) = self.meshes.get_mut(handle) {
                mesh.come_to_rest(separation);
            }
        }
        let bounds = |mesh: &WorldMesh| (mesh.hierarchies.bounds(), mesh.moves != Moves::Not);
        if self.are_others {
            self.handles = self.meshes.iter().map(|(handle, _)| handle).collect();
            let all = self.meshes.iter().map(|(_, mesh)| {
                let (bounds, moves) = bounds(mesh);
                (bounds, moves, mesh.groups)
            });
            self.hierarchy.replace(all);
            self.are_others = false;
        } else {
            for handle in self.moved.iter().chain(&listed) {
                let Ok(index) = self.handles.binary_search(handle) else {
                    continue;
                };
                if let Some(mesh) = self.meshes.get(*handle) {
                    let (bounds, moves) = bounds(mesh);
                    self.hierarchy.set(index, bounds, moves);
                }
            }
        }
        self.moved = listed;
    }

    /// Gives places to the rows of meshes that are near others.
    fn place_rows(&mut self) {
        let mut near: Vec<u32> = self.near.iter().flatten().copied().collect();
        near.sort_unstable();
        near.dedup();
        let near: Vec<_> = near.into_iter().map(|index| self.handles[index as usize]).collect();
        let new = near.iter().filter_map(|&handle| self.meshes.get(handle));
        let new = new.filter(|mesh| !self.rows.has(mesh));
        let new = new.map(|mesh| mesh.hierarchies.vertex_positions()).sum();
        self.rows.make_room(new, self.vertices);
        for handle in near {
            if let Some(mesh) = self.meshes.get_mut(handle) {
                self.rows.place(mesh);
            }
        }
    }

    /// Reports the costs of searches to the hierarchies, which decide when they are built again.
    fn observe(&mut self) {
        if self.engine.stop.result().is_err() {
            return;
        }
        let mut efforts = vec![(0, 0); self.sources.len()];
        for (source, tests, candidates) in self.engine.efforts() {
            let (own_tests, own_candidates) = &mut efforts[source];
            *own_tests += tests;
            *own_candidates += candidates;
        }
        // Sources of a mesh with itself come first, two for each mesh.
        let within = self.sources.chunks(2).zip(efforts.chunks(2));
        for (handles, efforts) in within.take_while(|(handles, _)| handles[0][0] == handles[0][1]) {
            if let Some(mesh) = self.meshes.get_mut(handles[0][0]) {
                let tests = efforts.iter().map(|effort| effort.0).sum();
                let candidates: u64 = efforts.iter().map(|effort| effort.1).sum();
                mesh.hierarchies.observe(tests, candidates as usize);
            }
        }
    }
}

/// Returns the question about the straight pieces of two meshes' paths. There is no exact verdict for arcs.
fn question_on_pieces(question: &Question, meshes: [&WorldMesh; 2]) -> Question {
    let [first, second] = meshes.map(|mesh| mesh.moves.deviation());
    let limits = question.limits;
    match first + second {
        0.0 => *question,
        deviation => Question {
            limits: Limits {
                separation: separation_of_pieces(limits.separation, deviation),
                ..limits
            },
            is_exact: false,
            // A contact of the pieces may be no contact of the arcs.
            wanted: Wanted::All,
            ..*question
        },
    }
}

/// Returns the time at which a pair is in contact on its paths.
fn time_on_paths(
    meshes: [&Hierarchies; 2],
    motions: &[Option<RigidMotion>; 2],
    limits: &Limits<f64>,
    contact: &Contact<f64>,
) -> Option<f64> {
    let Some(vertices) = vertices_of(meshes, contact.kind, contact.pair) else {
        // The meshes do not have such a pair, so nothing is proven about it.
        return Some(0.0);
    };
    let paths = vertex_paths(meshes, motions, contact.kind, vertices);
    let time = time_of_impact(contact.kind, paths.each_ref().map(|path| path as &dyn Path), limits).time();
    // Neither time is after the exact one. Pairs are dropped by their time on pieces, so a smaller time would make the result
    // depend on the order of the threads.
    time.map(|time| time.max(contact.time))
}

/// The rows of meshes that are, or were, near others. Each mesh keeps its place as long as there is room, so resting meshes are
/// copied once.
#[derive(Debug, Default)]
struct PlacedRows {
    rows: Rows,
    arrangement: u64,
    /// The first free place.
    end: usize,
}

impl PlacedRows {
    fn has(&self, mesh: &WorldMesh) -> bool {
        mesh.rows_at.is_some_and(|place| place.arrangement == self.arrangement)
    }

    /// Makes room for more rows. Gives all meshes new places if more than half of the rows would belong to no mesh.
    fn make_room(&mut self, new: usize, vertices: usize) {
        if self.end + new > 2 * vertices {
            self.rows.clear();
            self.arrangement += 1;
            self.end = 0;
        }
    }

    fn place(&mut self, mesh: &mut WorldMesh) {
        let rows = mesh.hierarchies.rows();
        let place = match mesh.rows_at.filter(|place| place.arrangement == self.arrangement) {
            Some(place) => place,
            None => {
                let first = self.end as u32;
                self.end += mesh.hierarchies.vertex_positions();
                RowsAt {
                    arrangement: self.arrangement,
                    first,
                    are_current: false,
                }
            }
        };
        if !place.are_current {
            self.rows.put(place.first as usize, rows);
        }
        mesh.rows_at = Some(RowsAt {
            are_current: true,
            ..place
        });
    }

    fn first_of(mesh: &WorldMesh) -> u32 {
        mesh.rows_at.map_or(0, |place| place.first)
    }
}
