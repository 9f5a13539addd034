//! A world of meshes that are added and removed reports the contacts of a new detector for the same triangles.

use crate::support::prelude::*;
use crate::support::worlds::{Chance, Known, agrees, known, narrow, sorted, wide};
use selvedge::glam::DQuat;
use selvedge::{CollisionFilter, Groups, MeshHandle, MeshMotion, World, WorldContact, WorldError};

/// A mesh as the test knows it.
#[derive(Clone)]
struct Model<S> {
    handle: MeshHandle,
    topology: Topology,
    shape: Vec<[S; 3]>,
    /// The positions at rest.
    at: Vec<[S; 3]>,
    groups: Groups,
}

#[derive(Clone)]
enum Movement<S> {
    Rests,
    Deforms(Vec<[S; 3]>, Vec<[S; 3]>),
    Goes([(DQuat, DVec3); 2]),
}

impl<S: Scalar> Model<S> {
    fn frames(&self, movement: &Movement<S>) -> [Vec<[S; 3]>; 2] {
        match movement {
            Movement::Rests => [self.at.clone(), self.at.clone()],
            Movement::Deforms(start, end) => [start.clone(), end.clone()],
            Movement::Goes(poses) => poses.map(|(rotation, origin)| {
                let posed = |&point: &[S; 3]| narrow(rotation.normalize() * wide(point) + origin);
                self.shape.iter().map(posed).collect()
            }),
        }
    }
}

/// The triangles of several meshes as those of one.
struct Merged {
    triangles: Vec<[u32; 3]>,
    /// The mesh of each vertex.
    mesh_of: Vec<usize>,
    /// The first vertex, edge and face of each mesh, and the numbers of all.
    firsts: Vec<[u32; 3]>,
}

impl Merged {
    fn new<'a>(topologies: impl Iterator<Item = &'a Topology>) -> Self {
        let mut merged = Self {
            triangles: Vec::new(),
            mesh_of: Vec::new(),
            firsts: vec![[0; 3]],
        };
        for (index, topology) in topologies.enumerate() {
            let [vertices, edges, faces] = merged.firsts[index];
            let triangles = topology.triangles().iter();
            merged
                .triangles
                .extend(triangles.map(|corners| corners.map(|vertex| vertex + vertices)));
            merged.mesh_of.extend(vec![index; topology.vertex_count()]);
            merged.firsts.push([
                vertices + topology.vertex_count() as u32,
                edges + topology.edges().len() as u32,
                faces + topology.triangles().len() as u32,
            ]);
        }
        merged
    }

    /// Returns the meshes of a pair, and its numbers in them.
    fn in_meshes(&self, kind: PairKind, pair: [u32; 2]) -> ([usize; 2], [u32; 2]) {
        let columns = match kind {
            PairKind::VertexFace => [0, 2],
            PairKind::EdgeEdge => [1, 1],
        };
        let mesh = |side: usize| {
            let is_before = |first: &[u32; 3]| first[columns[side]] <= pair[side];
            self.firsts.iter().rposition(is_before).expect("from zero on")
        };
        let meshes = [mesh(0), mesh(1)];
        (
            meshes,
            [0, 1].map(|side| pair[side] - self.firsts[meshes[side]][columns[side]]),
        )
    }
}

/// Returns the contacts of some of the meshes, by a detector for all their triangles as one mesh.
fn by_one_detector<S: Scalar>(models: &[(&Model<S>, &Movement<S>)], criterion: Criterion<S>) -> Vec<Known<S>>
where
    [S; 3]: Position<Scalar = S>,
{
    let merged = Merged::new(models.iter().map(|(model, _)| &model.topology));
    if merged.triangles.is_empty() {
        return Vec::new();
    }
    let frames: Vec<_> = models.iter().map(|(model, movement)| model.frames(movement)).collect();
    let [start, end] = [0, 1].map(|end| frames.iter().flat_map(|ends| ends[end].clone()).collect::<Vec<_>>());
    let topology = Topology::new(start.len(), merged.triangles.clone()).expect("as they were");
    let mut detector = CollisionDetector::<S>::new(topology);
    detector.set_criterion(criterion).expect("lengths");
    let filter = CollisionFilter::new().with_rule(rule(models, merged.mesh_of.clone()));
    detector.set_collision_filter(filter).expect("no lists");

    let (mut contacts, mut geometries) = (Vec::new(), Vec::new());
    detector.contacts(&start, &end, &mut contacts).expect("finite positions");
    let result = detector.contact_geometries(&start, &end, &contacts, &mut geometries);
    result.expect("contacts of the step");
    let found = contacts.iter().zip(geometries).map(|(contact, geometry)| {
        let (meshes, pair) = merged.in_meshes(contact.kind, contact.pair);
        let first_vertex = |corner: usize| merged.firsts[meshes[side_of(contact.kind, corner)]][0];
        let vertices = [0, 1, 2, 3].map(|corner| geometry.vertices[corner] - first_vertex(corner));
        let contact = WorldContact {
            kind: contact.kind,
            meshes: meshes.map(|index| models[index].0.handle),
            pair,
            time: contact.time,
        };
        (contact, vertices, geometry.geometry)
    });
    sorted(found.collect())
}

/// Returns whether a world tests the pair of such vertices: its meshes collide, and one moves; or its mesh deforms.
fn rule<S: Scalar>(
    models: &[(&Model<S>, &Movement<S>)],
    mesh_of: Vec<usize>,
) -> impl Fn(PairKind, [u32; 2], [u32; 4]) -> bool + use<S> {
    let rules = models.iter().map(|(model, movement)| {
        let moves = !matches!(movement, Movement::Rests);
        (moves, matches!(movement, Movement::Deforms(..)), model.groups)
    });
    let rules: Vec<(bool, bool, Groups)> = rules.collect();
    move |_, _, vertices| {
        let [a, b] = [vertices[0], vertices[3]].map(|vertex| mesh_of[vertex as usize]);
        let ((moves, deforms, groups), (other_moves, _, other_groups)) = (rules[a], rules[b]);
        groups.collide(other_groups) && if a == b { deforms } else { moves || other_moves }
    }
}

/// A change of a world.
#[derive(Clone, Copy, Debug)]
enum Event {
    Insertion,
    Removal,
    Grouping,
    Setting,
    Step,
}

fn stories() -> impl Strategy<Value = Vec<(Event, u64)>> + Clone {
    let event = prop_oneof![
        4 => Just(Event::Insertion),
        2 => Just(Event::Removal),
        1 => Just(Event::Grouping),
        1 => Just(Event::Setting),
        6 => Just(Event::Step),
    ];
    prop::collection::vec((event, any::<u64>()), 1..80)
}

/// Counts each change, and the contacts within meshes and between them.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    insertions: usize,
    removals: usize,
    moves: usize,
    contacts: [usize; 2],
}

/// Two worlds, on one thread and on two, and what they should hold.
struct Story<S: Scalar>
where
    [S; 3]: Position<Scalar = S>,
{
    worlds: [World<[S; 3]>; 2],
    models: Vec<Model<S>>,
    removed: Vec<MeshHandle>,
    criterion: Criterion<S>,
    count: Count,
}

impl<S: Scalar> Story<S>
where
    [S; 3]: Position<Scalar = S>,
{
    fn new(count: Count) -> Self {
        let mut worlds = [World::new(), World::new()];
        worlds[1].set_threads(Threads::from_count(2)).expect("two threads");
        Self {
            worlds,
            models: Vec::new(),
            removed: Vec::new(),
            criterion: Criterion::default(),
            count,
        }
    }

    /// Applies a change to both worlds, and checks their answers.
    fn apply(&mut self, event: Event, seed: u64) -> TestCaseResult {
        let mut random = Chance::new(seed);
        match event {
            Event::Insertion => self.insert(&mut random),
            Event::Removal if !self.models.is_empty() => self.remove(&mut random),
            Event::Grouping if !self.models.is_empty() => self.set_groups(&mut random),
            Event::Setting => self.set_criterion(&mut random),
            Event::Step => self.step(&mut random),
            Event::Removal | Event::Grouping => Ok(()),
        }
    }

    fn insert(&mut self, random: &mut Chance) -> TestCaseResult {
        let vertices = 3 + random.below(6);
        let place = random.vector() * random.pick(&[0.0, 1.0, 4.0]);
        let on_lattice = random.below(2) == 0;
        let shape: Vec<[S; 3]> = (0..vertices).map(|_| narrow(place + random.point(on_lattice))).collect();
        let triangles = (0..1 + random.below(6)).map(|_| [(); 3].map(|()| random.below(vertices) as u32));
        let topology = Topology::new(vertices, triangles.collect()).expect("vertices that exist");
        let groups = random.pick(&[Groups::ALL, Groups::ALL, Groups::new(1, 2), Groups::new(2, 3)]);
        let handles = self
            .worlds
            .each_mut()
            .map(|world| world.insert(topology.clone(), &shape, groups));
        let [Ok(handle), Ok(other)] = handles else {
            return Err(TestCaseError::fail("refused"));
        };
        prop_assert_eq!(handle, other);
        prop_assert!(!self.removed.contains(&handle), "a handle of a mesh that was removed");
        self.models.push(Model {
            handle,
            topology,
            at: shape.clone(),
            shape,
            groups,
        });
        self.models.sort_by_key(|model| model.handle);
        self.count.insertions += 1;
        Ok(())
    }

    fn remove(&mut self, random: &mut Chance) -> TestCaseResult {
        let model = self.models.remove(random.below(self.models.len()));
        for world in &mut self.worlds {
            prop_assert_eq!(world.remove(model.handle), Ok(()));
            prop_assert_eq!(world.remove(model.handle), Err(WorldError::NoSuchMesh { mesh: model.handle }));
        }
        self.removed.push(model.handle);
        self.count.removals += 1;
        Ok(())
    }

    fn set_groups(&mut self, random: &mut Chance) -> TestCaseResult {
        let index = random.below(self.models.len());
        let model = &mut self.models[index];
        model.groups = random.pick(&[Groups::ALL, Groups::new(1, 2), Groups::new(2, 3), Groups::new(1, 1)]);
        for world in &mut self.worlds {
            prop_assert_eq!(world.set_groups(model.handle, model.groups), Ok(()));
        }
        Ok(())
    }

    fn set_criterion(&mut self, random: &mut Chance) -> TestCaseResult {
        let limits = Limits::within(S::from_f64(random.pick(&[0.0, 0.01, 0.3])));
        let tolerance = limits.tolerance;
        self.criterion = random.pick(&[Criterion::Within(limits), Criterion::Touching { tolerance }]);
        for world in &mut self.worlds {
            prop_assert_eq!(world.set_criterion(self.criterion), Ok(()));
        }
        Ok(())
    }

    fn step(&mut self, random: &mut Chance) -> TestCaseResult {
        let movements: Vec<_> = self.models.iter().map(|model| model.movement(random)).collect();
        let pairs = self.models.iter().zip(&movements);
        let motions: Vec<_> = pairs
            .filter_map(|(model, movement)| Some((model.handle, movement.motion()?)))
            .collect();
        self.count.moves += motions.len();
        let [mut found, mut on_two_threads] = [Vec::new(), Vec::new()];
        prop_assert_eq!(self.worlds[0].contacts(&motions, &mut found), Ok(()));
        prop_assert_eq!(self.worlds[1].contacts(&motions, &mut on_two_threads), Ok(()));
        prop_assert_eq!(&found, &on_two_threads, "on one thread and on two");
        for world in &mut self.worlds {
            agrees(world, &motions, &found)?;
        }
        let found = known(&self.worlds[0], &found)?;
        prop_assert_eq!(&found, &self.expected(&movements));
        for (contact, ..) in &found {
            self.count.contacts[usize::from(contact.meshes[0] != contact.meshes[1])] += 1;
        }
        for (model, movement) in self.models.iter_mut().zip(&movements) {
            model.at = model.frames(movement)[1].clone();
        }
        Ok(())
    }

    /// Returns the contacts of new detectors. In `f64` a pair is examined in `f32` first if all positions of its detector are
    /// such numbers, so meshes are compared two at a time.
    fn expected(&self, movements: &[Movement<S>]) -> Vec<Known<S>> {
        let all: Vec<_> = self.models.iter().zip(movements).collect();
        if S::UNIT_ROUNDOFF.to_f64() > f64::EPSILON {
            return by_one_detector(&all, self.criterion);
        }
        let mut expected = Vec::new();
        for (index, &one) in all.iter().enumerate() {
            expected.extend(by_one_detector(&[one], self.criterion));
            for &other in &all[index + 1..] {
                let both = by_one_detector(&[one, other], self.criterion);
                expected.extend(
                    both.into_iter()
                        .filter(|(contact, ..)| contact.meshes[0] != contact.meshes[1]),
                );
            }
        }
        sorted(expected)
    }
}

impl<S: Scalar> Model<S> {
    fn movement(&self, random: &mut Chance) -> Movement<S> {
        let far = random.pick(&[0.1, 0.5, 2.0]);
        match random.below(5) {
            0 | 1 => Movement::Rests,
            2 | 3 => {
                let on_lattice = random.below(2) == 0;
                let by = random.vector() * far;
                let end = self.at.iter().map(|&point| {
                    let bend = random.point(on_lattice) * 0.5 * far;
                    narrow(wide(point) + if on_lattice { bend } else { by + bend })
                });
                Movement::Deforms(self.at.clone(), end.collect())
            }
            _ => {
                let rotation = if random.below(2) == 0 {
                    DQuat::IDENTITY
                } else {
                    random.rotation()
                };
                Movement::Goes([(rotation, random.vector() * far), (rotation, random.vector() * far)])
            }
        }
    }
}

impl<S: Scalar> Movement<S>
where
    [S; 3]: Position<Scalar = S>,
{
    fn motion(&self) -> Option<MeshMotion<'_, [S; 3]>> {
        match self {
            Self::Rests => None,
            Self::Deforms(start, end) => Some(MeshMotion::Deforming { start, end }),
            &Self::Goes([start, end]) => Some(MeshMotion::Rigid { start, end }),
        }
    }
}

fn is_as_new_detectors<S: Scalar>(count: &Cell<Count>)
where
    [S; 3]: Position<Scalar = S>,
{
    check(120, stories(), |events| {
        let mut story = Story::<S>::new(count.get());
        events.iter().try_for_each(|&(event, seed)| story.apply(event, seed))?;
        for world in &story.worlds {
            prop_assert!(world.meshes().eq(story.models.iter().map(|model| model.handle)));
        }
        count.set(story.count);
        Ok(())
    });
}

#[test]
fn ten_thousand_changes_of_a_world_give_the_contacts_of_a_new_detector() {
    let count = Cell::new(Count::default());
    is_as_new_detectors::<f32>(&count);
    is_as_new_detectors::<f64>(&count);
    let count = count.get();
    let changes = count.insertions + count.removals + count.moves;
    assert!(
        changes >= 10_000 && count.contacts.iter().all(|&contacts| contacts > 2_000),
        "{count:?}"
    );
}
