//! The queries about a step of a world, generic over the format of the positions.

use super::{Format, HandledWorld, MeshNumber, WorldAnswers, WorldFinder, WorldHandle, mesh, on, on_format, with_either};
use crate::answers::{ContactRow, GeometryRow, Kind};
use crate::input::{OutList, Plain, view};
use crate::status::{Failure, Status};
use selvedge::core::narrowing::rounded_down;
use selvedge::glam::{DQuat, DVec3};
use selvedge::{Frame, MeshHandle, MeshMotion, Scalar, StepError, World, WorldContact, WorldContactGeometry, WorldError};

/// A mesh of a world whose vertices move, each on a straight path and at constant velocity, such as cloth or a soft body. The
/// mesh can also meet itself.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Deforming<S> {
    /// The mesh.
    pub mesh: MeshNumber,
    /// The positions at the start: 3 * `vertex_count` numbers.
    pub start: *const S,
    /// The positions at the end.
    pub end: *const S,
    /// The number of vertices of the mesh.
    pub vertex_count: usize,
}

/// The place of a body: the rotation and the translation of the shape that it was inserted with.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PoseRow {
    /// A quaternion, x y z w, of any length except zero.
    pub rotation: [f64; 4],
    /// The position of the shape's origin.
    pub origin: [f64; 3],
}

/// A mesh of a world that moves as a rigid body from one pose to another. It rotates the short way at a constant rate, about an
/// axis through its origin, which moves on a straight path.
///
/// If the two rotations are equal, every vertex moves straight. Otherwise vertices move on arcs, and no contact on an arc is
/// missed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Rigid {
    /// The mesh.
    pub mesh: MeshNumber,
    /// The pose at the start.
    pub start: PoseRow,
    /// The pose at the end.
    pub end: PoseRow,
}

// Any bits are valid numbers and pointers.
impl<S: Copy> Plain for Deforming<S> {}
impl Plain for Rigid {}
impl Plain for WorldContactRow {}

/// A pair of a world that may touch during the step.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldContactRow {
    /// The meshes of the vertex and of the face, or of the two edges. They are equal if a mesh meets itself.
    pub meshes: [MeshNumber; 2],
    /// The time and the primitives. Primitives and vertices have the numbers of their own meshes.
    pub contact: ContactRow,
}

impl WorldContactRow {
    pub(super) fn new<S: Scalar>(contact: &WorldContact<S>, world: &World<[S; 3]>) -> Self {
        Self {
            meshes: contact.meshes.map(MeshHandle::to_bits),
            contact: ContactRow {
                time: contact.time.to_f64(),
                kind: Kind::from(contact.kind) as u32,
                pair: contact.pair.into(),
                // The contact is the world's own, so the vertices exist.
                vertices: world.vertices_of(contact).unwrap_or_default(),
            },
        }
    }

    /// Converts the row. The world checks that there is such a pair and that the time is valid.
    fn contact<S: Scalar>(&self) -> Result<WorldContact<S>, Failure> {
        let [first, second] = self.meshes.map(mesh);
        Ok(WorldContact {
            kind: self.contact.kind()?,
            meshes: [first?, second?],
            pair: [self.contact.pair.first, self.contact.pair.second],
            time: rounded_down(self.contact.time),
        })
    }
}

/// The geometry of a contact in a world.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldGeometryRow {
    /// The meshes, as in the contact.
    pub meshes: [MeshNumber; 2],
    /// The geometry. Primitives and vertices have the numbers of their own meshes.
    pub geometry: GeometryRow,
}

impl From<&WorldContactGeometry> for WorldGeometryRow {
    fn from(found: &WorldContactGeometry) -> Self {
        let &WorldContactGeometry {
            kind,
            meshes,
            pair,
            vertices,
            geometry,
        } = found;
        Self {
            meshes: meshes.map(MeshHandle::to_bits),
            geometry: GeometryRow::new(kind, pair, vertices, &geometry),
        }
    }
}

pub(super) struct Query<S> {
    world: *mut WorldHandle,
    deforming: (*const Deforming<S>, usize),
    rigid: (*const Rigid, usize),
}

impl<S: Format> Query<S> {
    pub(super) const fn new(
        world: *mut WorldHandle,
        deforming: (*const Deforming<S>, usize),
        rigid: (*const Rigid, usize),
    ) -> Self {
        Self { world, deforming, rigid }
    }

    /// Runs `search` with the motions.
    ///
    /// # Safety
    /// The conditions are those of selvedge_world_contacts_f64.
    pub(super) unsafe fn run(
        self,
        search: impl FnOnce(&mut WorldFinder<S>, &mut WorldAnswers, &[(MeshHandle, MeshMotion<'_, [S; 3]>)]) -> Result<(), Failure>,
    ) -> Status {
        on_format::<S>(self.world, |finder, answers| {
            // SAFETY: the caller's promises.
            let (deforming, rigid) = unsafe {
                (
                    view::<_, 1>("deforming", self.deforming.0, self.deforming.1)?,
                    view::<_, 1>("rigid", self.rigid.0, self.rigid.1)?,
                )
            };
            let mut motions = Vec::with_capacity(deforming.len() + rigid.len());
            for [row] in deforming {
                let &Deforming {
                    mesh: bits,
                    start,
                    end,
                    vertex_count: count,
                } = row;
                let mesh = mesh(bits)?;
                let expected = finder.world.topology(mesh)?.vertex_count();
                if count != expected {
                    // The count is checked before any number is read.
                    let (frame, found) = (Frame::Start, count);
                    let error = StepError::WrongLength { frame, found, expected };
                    return Err(WorldError::BadPositions { mesh, error }.into());
                }
                // SAFETY: the caller's promises.
                let (start, end) = unsafe { (view("start", start, count)?, view("end", end, count)?) };
                motions.push((mesh, MeshMotion::Deforming { start, end }));
            }
            for [row] in rigid {
                let [start, end] = [row.start, row.end].map(|pose| (DQuat::from_array(pose.rotation), DVec3::from(pose.origin)));
                motions.push((mesh(row.mesh)?, MeshMotion::Rigid { start, end }));
            }
            search(finder, answers, &motions)
        })
    }
}

unsafe fn find_geometries<S: Format>(
    finder: &WorldFinder<S>,
    answers: &mut WorldAnswers,
    contacts: (*const WorldContactRow, usize),
) -> Result<(), Failure> {
    // SAFETY: the caller's promises. The contacts may be this world's own; they are not written to here.
    let rows = unsafe { view::<_, 1>("contacts", contacts.0, contacts.1) }?;
    let given = rows.iter().map(|[row]| row.contact());
    let given: Vec<WorldContact<S>> = given.collect::<Result<_, _>>()?;
    finder.world.contact_geometries(&given, &mut answers.found_geometries)?;
    Ok(())
}

/// Computes the geometry of each contact of the last step at its time, in the same order. The contacts may be the world's own
/// list. The geometries stay valid until the next call of this function for this world, or until the world is freed.
///
/// The last step is the one of the last call. Contacts of earlier steps are refused.
///
/// # Safety
/// `contacts` points to `contact_count` contacts, `geometries` to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_contact_geometries(
    world: *mut WorldHandle,
    contacts: *const WorldContactRow,
    contact_count: usize,
    geometries: *mut *const WorldGeometryRow,
    count: *mut usize,
) -> Status {
    on(world, |it| {
        // SAFETY: the caller's promises.
        let out = unsafe { OutList::new("geometries", geometries, count) }?;
        let HandledWorld { finder, answers } = it;
        // SAFETY: the caller's promises.
        with_either!(finder, finder => unsafe { find_geometries(finder, answers, (contacts, contact_count)) })?;
        answers.geometries.clear();
        answers
            .geometries
            .extend(answers.found_geometries.iter().map(WorldGeometryRow::from));
        out.set(&answers.geometries);
        Ok(())
    })
}
