//! What a world can be asked of a step: thin functions for each format over one that is generic.

use super::{Answers, AnyFinder, Finder, Format, HandledWorld, Mesh, WorldHandle, mesh, on, on_format, with_either};
use crate::answers::{ContactRow, GeometryRow, Kind};
use crate::input::{Out, OutList, Plain, view};
use crate::status::{Failure, Status};
use selvedge::core::narrowing::rounded_down;
use selvedge::glam::{DQuat, DVec3};
use selvedge::{Frame, MeshHandle, MeshMotion, Scalar, StepError, World, WorldContact, WorldContactGeometry, WorldError};

/// A mesh of a world whose vertices move, each straight and at constant velocity: cloth, soft bodies. Such a mesh can also meet
/// itself.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DeformingF64 {
    /// Which mesh.
    pub mesh: Mesh,
    /// 3 * `vertex_count` numbers: the positions at the start.
    pub start: *const f64,
    /// And at the end.
    pub end: *const f64,
    /// As many as the mesh has.
    pub vertex_count: usize,
}

/// selvedge_deforming_f64 for float.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DeformingF32 {
    /// Which mesh.
    pub mesh: Mesh,
    /// 3 * `vertex_count` numbers: the positions at the start.
    pub start: *const f32,
    /// And at the end.
    pub end: *const f32,
    /// As many as the mesh has.
    pub vertex_count: usize,
}

/// Where a body is: what its shape, which is that it was inserted with, is turned and moved by.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// A quaternion, x y z w. Of any length but zero.
    pub rotation: [f64; 4],
    /// Where the shape's origin is.
    pub origin: [f64; 3],
}

/// A mesh of a world that moves as one body, of the shape that it was inserted with, from one pose to another. It turns the short way at a
/// constant rate, about an axis through its origin, which moves straight.
///
/// With two rotations that are equal every vertex moves straight; else on arcs, of which no contact is missed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Rigid {
    /// Which mesh.
    pub mesh: Mesh,
    /// Where it is at the start.
    pub start: Pose,
    /// And at the end.
    pub end: Pose,
}

// Numbers and pointers: any bits are one.
impl Plain for DeformingF64 {}
impl Plain for DeformingF32 {}
impl Plain for Rigid {}
impl Plain for WorldContactRow {}

/// A pair of a world for which contact during the step is not excluded.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldContactRow {
    /// The mesh of the vertex and that of the face; or those of the two edges. One mesh twice, if it meets itself.
    pub meshes: [Mesh; 2],
    /// When, and which primitives. They and their vertices are numbered as by their own meshes.
    pub contact: ContactRow,
}

impl WorldContactRow {
    fn new<S: Scalar>(contact: &WorldContact<S>, world: &World<[S; 3]>) -> Self {
        Self {
            meshes: contact.meshes.map(MeshHandle::to_bits),
            contact: ContactRow {
                time: contact.time.to_f64(),
                kind: Kind::from(contact.kind) as u32,
                pair: contact.pair.into(),
                // The world's own contact: they are there.
                vertices: world.vertices_of(contact).unwrap_or_default(),
            },
        }
    }

    /// As the world knows it, which looks whether there is such a pair, and the step has such a time.
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

/// Two primitives of a world and how they lie to each other at the time of a contact.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldGeometryRow {
    /// As the contact has them.
    pub meshes: [Mesh; 2],
    /// How they lie. Primitives and vertices are numbered as by their own meshes.
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

/// A deforming mesh of either format.
trait Deforming<S>: Plain {
    fn parts(&self) -> (Mesh, [*const S; 2], usize);
}

impl Deforming<f64> for DeformingF64 {
    fn parts(&self) -> (Mesh, [*const f64; 2], usize) {
        (self.mesh, [self.start, self.end], self.vertex_count)
    }
}

impl Deforming<f32> for DeformingF32 {
    fn parts(&self) -> (Mesh, [*const f32; 2], usize) {
        (self.mesh, [self.start, self.end], self.vertex_count)
    }
}

/// What moves in a step, as it came.
struct Asked<D> {
    world: *mut WorldHandle,
    deforming: (*const D, usize),
    rigid: (*const Rigid, usize),
}

impl<D> Asked<D> {
    const fn new(world: *mut WorldHandle, deforming: (*const D, usize), rigid: (*const Rigid, usize)) -> Self {
        Self { world, deforming, rigid }
    }

    /// Puts the question, with the motions.
    ///
    /// # Safety
    /// As selvedge_world_contacts_f64.
    unsafe fn ask<S: Format>(
        self,
        question: impl FnOnce(&mut Finder<S>, &mut Answers, &[(MeshHandle, MeshMotion<'_, [S; 3]>)]) -> Result<(), Failure>,
    ) -> Status
    where
        D: Deforming<S>,
    {
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
                let (bits, [start, end], count) = row.parts();
                let mesh = mesh(bits)?;
                let expected = finder.world.topology(mesh)?.vertex_count();
                if count != expected {
                    // Before one of them is looked at.
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
            question(finder, answers, &motions)
        })
    }
}

unsafe fn find_contacts<S: Format, D: Deforming<S>>(
    asked: Asked<D>,
    contacts: *mut *const WorldContactRow,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask::<S>(|finder, answers, motions| {
            let out = OutList::new("contacts", contacts, count)?;
            finder.world.contacts(motions, &mut finder.contacts)?;
            answers.contacts.clear();
            let rows = finder
                .contacts
                .iter()
                .map(|contact| WorldContactRow::new(contact, &finder.world));
            answers.contacts.extend(rows);
            out.set(&answers.contacts);
            Ok(())
        })
    }
}

unsafe fn find_earliest<S: Format, D: Deforming<S>>(asked: Asked<D>, found: *mut bool, contact: *mut WorldContactRow) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask::<S>(|finder, _, motions| {
            let (found, out) = (Out::new("found", found)?, Out::new("contact", contact)?);
            let earliest = finder.world.earliest(motions)?;
            found.set(earliest.is_some());
            if let Some(earliest) = earliest {
                out.set(WorldContactRow::new(&earliest, &finder.world));
            }
            Ok(())
        })
    }
}

unsafe fn tell_free<S: Format, D: Deforming<S>>(asked: Asked<D>, is_free: *mut bool) -> Status {
    // SAFETY: the caller's promises.
    unsafe {
        asked.ask::<S>(|finder, _, motions| {
            let out = Out::new("is_free", is_free)?;
            out.set(finder.world.is_free(motions)?);
            Ok(())
        })
    }
}

/// All contacts of a step in which these meshes move, each listed once, and all others rest: those that have moved rest where their last
/// motion ended. The contacts stay where they are until this world's contacts are asked for again, or it is freed. If there are none
/// they are at NULL.
///
/// If the question is refused nothing has changed; for one that is cut short see selvedge_world_set_cancelled.
///
/// # Safety
/// `deforming` and `rigid` point to so many entries, each frame to 3 * `vertex_count` numbers, `contacts` to a pointer, `count` to a
/// number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_contacts_f64(
    world: *mut WorldHandle,
    deforming: *const DeformingF64,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    contacts: *mut *const WorldContactRow,
    count: *mut usize,
) -> Status {
    let asked = Asked::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe { find_contacts::<f64, _>(asked, contacts, count) }
}

/// selvedge_world_contacts_f64 for float.
///
/// # Safety
/// As selvedge_world_contacts_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_contacts_f32(
    world: *mut WorldHandle,
    deforming: *const DeformingF32,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    contacts: *mut *const WorldContactRow,
    count: *mut usize,
) -> Status {
    let asked = Asked::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe { find_contacts::<f32, _>(asked, contacts, count) }
}

/// The earliest contact of such a step, before which it is free of contact. `*found` becomes whether there is one; if there is none the
/// whole step is free, and nothing is written to `contact`.
///
/// # Safety
/// As selvedge_world_contacts_f64; `found` and `contact` point to one each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_earliest_f64(
    world: *mut WorldHandle,
    deforming: *const DeformingF64,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    found: *mut bool,
    contact: *mut WorldContactRow,
) -> Status {
    let asked = Asked::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe { find_earliest::<f64, _>(asked, found, contact) }
}

/// selvedge_world_earliest_f64 for float.
///
/// # Safety
/// As selvedge_world_earliest_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_earliest_f32(
    world: *mut WorldHandle,
    deforming: *const DeformingF32,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    found: *mut bool,
    contact: *mut WorldContactRow,
) -> Status {
    let asked = Asked::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe { find_earliest::<f32, _>(asked, found, contact) }
}

/// Whether such a step is certainly free of contact.
///
/// # Safety
/// As selvedge_world_contacts_f64; `is_free` points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_is_free_f64(
    world: *mut WorldHandle,
    deforming: *const DeformingF64,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    is_free: *mut bool,
) -> Status {
    let asked = Asked::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe { tell_free::<f64, _>(asked, is_free) }
}

/// selvedge_world_is_free_f64 for float.
///
/// # Safety
/// As selvedge_world_is_free_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_is_free_f32(
    world: *mut WorldHandle,
    deforming: *const DeformingF32,
    deforming_count: usize,
    rigid: *const Rigid,
    rigid_count: usize,
    is_free: *mut bool,
) -> Status {
    let asked = Asked::new(world, (deforming, deforming_count), (rigid, rigid_count));
    // SAFETY: the caller's promises.
    unsafe { tell_free::<f32, _>(asked, is_free) }
}

unsafe fn find_geometries<S: Format>(
    finder: &Finder<S>,
    answers: &mut Answers,
    contacts: (*const WorldContactRow, usize),
) -> Result<(), Failure> {
    // SAFETY: the caller's promises. The contacts may be this world's own, to which nothing is written here.
    let rows = unsafe { view::<_, 1>("contacts", contacts.0, contacts.1) }?;
    let given = rows.iter().map(|[row]| row.contact());
    let given: Vec<WorldContact<S>> = given.collect::<Result<_, _>>()?;
    finder.world.contact_geometries(&given, &mut answers.found_geometries)?;
    Ok(())
}

/// How the two of each contact of the last step lie to each other at its time, in their order. They stay where they are until this
/// world's contact geometries are asked for again, or it is freed. The contacts may be the world's own.
///
/// The last step is that of the last question: of an earlier step's contacts nothing is known any more.
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
