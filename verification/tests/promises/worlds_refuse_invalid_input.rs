//! A world refuses meshes, motions and questions that are invalid, with an error that names them, and loses nothing.

use crate::support::prelude::*;
use crate::support::worlds::{AT_REST, CORNERS, deforms, moves, triangle};
use selvedge::glam::DQuat;
use selvedge::{Groups, MeshHandle, World, WorldContact, WorldError};

/// A world with a floor, a mesh above it, the motion in which the mesh falls through, and the handle of a mesh that was removed.
struct Fall {
    world: World<DVec3>,
    floor: MeshHandle,
    mesh: MeshHandle,
    removed: MeshHandle,
    above: [DVec3; 3],
    below: [DVec3; 3],
}

impl Fall {
    fn new() -> Self {
        let mut world = World::<DVec3>::new();
        let above = CORNERS.map(|corner| corner + DVec3::new(0.1, 0.1, 1.0));
        let floor = world.insert(triangle(), &CORNERS, Groups::ALL).expect("in order");
        let mesh = world.insert(triangle(), &above, Groups::ALL).expect("in order");
        let removed = world.insert(triangle(), &CORNERS, Groups::ALL).expect("in order");
        world.remove(removed).expect("it is there");
        Self {
            world,
            floor,
            mesh,
            removed,
            above,
            below: above.map(|corner| corner - 2.0 * DVec3::Z),
        }
    }

    fn contacts(&mut self) -> Result<Vec<WorldContact<f64>>, WorldError> {
        let mut contacts = Vec::new();
        let falls = deforms(&self.above, &self.below);
        self.world.contacts(&[(self.mesh, falls)], &mut contacts).map(|()| contacts)
    }
}

#[test]
fn invalid_meshes_and_settings_are_refused_and_nothing_is_lost() {
    let mut fall = Fall::new();
    let expected = fall.contacts().expect("in order");
    assert!(!expected.is_empty());
    let many = Topology::new(u32::MAX as usize, vec![[0, 1, 2]]).expect("they can be numbered");
    let (world, removed) = (&mut fall.world, fall.removed);
    let refused = [
        world.insert(many, &CORNERS, Groups::ALL).map(|_| ()),
        world.insert(triangle(), &CORNERS[..2], Groups::ALL).map(|_| ()),
        world.insert(triangle(), &[DVec3::NAN; 3], Groups::ALL).map(|_| ()),
        world.remove(removed),
        world.set_groups(removed, Groups::ALL),
        world.topology(removed).map(|_| ()),
        world.set_criterion(Criterion::Touching { tolerance: f64::NAN }),
    ];
    assert!(refused.iter().all(Result::is_err), "{refused:?}");
    assert_eq!(fall.contacts(), Ok(expected));
    assert!(fall.world.meshes().eq([fall.floor, fall.mesh]));
}

#[test]
fn invalid_motions_are_refused_by_name() {
    let mut fall = Fall::new();
    let (above, below, mesh, removed) = (fall.above, fall.below, fall.mesh, fall.removed);
    let falls = (mesh, deforms(&above, &below));
    let nan = [DVec3::NAN; 3];
    let rests = |pose| moves(AT_REST, pose);
    let of_mesh = |motion| (mesh, motion);
    let far = DVec3::splat(f64::MAX);
    let turned = (DQuat::from_rotation_x(1.0), far);
    let [no_turn, no_number] = [[0.0, 0.0], [f64::NAN, 1.0]].map(|[x, w]| DQuat::from_xyzw(x, 0.0, 0.0, w));
    let short = StepError::WrongLength {
        frame: selvedge::Frame::Start,
        found: 2,
        expected: 3,
    };
    for (motion, error) in [
        ((removed, rests(AT_REST)), WorldError::NoSuchMesh { mesh: removed }),
        (falls, WorldError::MovedTwice { mesh }),
        (of_mesh(rests((DQuat::IDENTITY, DVec3::NAN))), WorldError::BadPose { mesh }),
        (of_mesh(rests((no_turn, DVec3::ZERO))), WorldError::BadPose { mesh }),
        (of_mesh(rests((no_number, DVec3::ZERO))), WorldError::BadPose { mesh }),
        (of_mesh(moves((DQuat::IDENTITY, -far), turned)), WorldError::BadPose { mesh }),
        (
            of_mesh(deforms(&above[1..], &below)),
            WorldError::BadPositions { mesh, error: short },
        ),
    ] {
        let motions = match error {
            WorldError::MovedTwice { .. } => vec![falls, motion],
            _ => vec![(fall.floor, rests(AT_REST)), motion],
        };
        assert_eq!(fall.world.contacts(&motions, &mut Vec::new()), Err(error));
        assert!(!error.to_string().is_empty());
    }
    let refused = fall.world.contacts(&[of_mesh(deforms(&above, &nan))], &mut Vec::new());
    let Err(WorldError::BadPositions { error, .. }) = refused else {
        panic!("{refused:?}")
    };
    assert!(matches!(error, StepError::NotFinite { vertex: 0, .. }));
}

#[test]
fn a_step_is_cut_short_by_the_number_of_pairs_or_by_another_thread() {
    let mut fall = Fall::new();
    let expected = fall.contacts();
    fall.world.set_pair_limit(Some(1));
    assert_eq!(fall.contacts(), Err(WorldError::Step(StepError::TooManyPairs { limit: 1 })));
    fall.world.set_pair_limit(None);
    fall.world.cancellation().cancel();
    assert_eq!(fall.contacts(), Err(WorldError::Step(StepError::Cancelled)));
    fall.world.cancellation().reset();
    assert_eq!(fall.contacts(), expected);
}

#[test]
fn geometry_of_what_the_last_step_does_not_have_is_an_error() {
    let mut world = World::<DVec3>::new();
    // The last vertex belongs to no triangle.
    let loose = Topology::new(4, vec![[0, 1, 2]]).expect("a triangle");
    let corners = [CORNERS[0], CORNERS[1], CORNERS[2], DVec3::Z];
    let floor = world.insert(loose, &corners, Groups::ALL).expect("in order");
    let above = CORNERS.map(|corner| corner + DVec3::new(0.1, 0.1, 1.0));
    let mesh = world.insert(triangle(), &above, Groups::ALL).expect("in order");
    let falls = moves(AT_REST, (DQuat::IDENTITY, -2.0 * DVec3::Z));
    let contact = world.earliest(&[(mesh, falls)]).expect("in order").expect("it goes through");
    let found = world.contact_geometry(&contact).expect("a contact of the step");
    assert_eq!(found.geometry.normal.map(|normal| normal.z.abs()), Some(1.0));

    let mut kept = vec![found];
    for (kind, pair) in [
        (PairKind::VertexFace, [0, 1]),
        (PairKind::VertexFace, [3, 0]),
        (PairKind::EdgeEdge, [3, 0]),
        (PairKind::EdgeEdge, [0, u32::MAX]),
    ] {
        let meshes = [floor, mesh];
        let strange = WorldContact {
            kind,
            meshes,
            pair,
            ..contact
        };
        let error = WorldError::Step(StepError::NoSuchPair { kind, pair });
        assert_eq!(world.contact_geometry(&strange), Err(error));
        assert_eq!(world.contact_geometries(&[contact, strange], &mut kept), Err(error));
    }
    for time in [-0.1, 1.1, f64::NAN] {
        let at_no_time = WorldContact { time, ..contact };
        let refused = world.contact_geometry(&at_no_time);
        assert!(matches!(refused, Err(WorldError::Step(StepError::BadTime { .. }))));
    }
    // In another step the result is that of this step: everything rests, one unit below.
    world.contacts(&[], &mut Vec::new()).expect("in order");
    let at_rest = world.contact_geometry(&contact).expect("they are still there");
    assert_eq!((at_rest.geometry.speed, at_rest.geometry.distance[1] > 0.9), (0.0, true));
    world.remove(mesh).expect("it is there");
    assert_eq!(world.contact_geometry(&contact), Err(WorldError::NoSuchMesh { mesh }));
    assert_eq!(kept, [found], "an earlier result is kept");
}

#[test]
fn pairs_that_rest_or_that_groups_exclude_are_not_examined() {
    let mut world = World::<DVec3>::new();
    let touching = |mesh: DVec3| CORNERS.map(|corner| corner + mesh);
    // Two meshes rest in one place, and a ghost passes through both.
    for _ in 0..2 {
        world.insert(triangle(), &CORNERS, Groups::new(1, 1)).expect("in order");
    }
    let ghost = world.insert(triangle(), &CORNERS, Groups::new(2, 2)).expect("in order");
    let [above, below] = [DVec3::Z, -DVec3::Z].map(touching);
    let mut contacts = Vec::new();
    world.set_pair_limit(Some(0));
    world.contacts(&[], &mut contacts).expect("nothing is examined");
    let step = [(ghost, deforms(&above, &below))];
    world.contacts(&step, &mut contacts).expect("nothing is examined");
    world.set_groups(ghost, Groups::ALL).expect("it is there");
    let limit = StepError::TooManyPairs { limit: 0 };
    assert_eq!(world.contacts(&step, &mut contacts), Err(WorldError::Step(limit)));
    world.set_pair_limit(None);
    world.contacts(&step, &mut contacts).expect("as many as there are");
    assert!(contacts.len() > 10 && contacts.iter().all(|contact| contact.meshes.contains(&ghost)));
}
