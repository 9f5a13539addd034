//! Worlds of several meshes, and their settings.

/// The functions for `double`.
pub mod double;
/// The functions for `float`.
pub mod single {
    include!(concat!(env!("OUT_DIR"), "/world.rs"));
}
pub mod steps;
#[cfg(test)]
mod tests;

use crate::answers::PairRow;
use crate::detector::{AnyFinder, Format, OfFormat, ScalarFormat, topology, with_either};
use crate::guard::guarded;
use crate::handles::{self, Handled, Living};
use crate::input::{Out, OutList, unknown, view};
use crate::settings::{GroupsRow, length};
use crate::status::{Failure, Status};
use selvedge::core::elementary::Limits;
use selvedge::{
    Cancellation, Criterion, Groups, MeshHandle, Scalar, Threads, World, WorldContact, WorldContactGeometry, WorldError,
};
use steps::{WorldContactRow, WorldGeometryRow};

/// A world of meshes that come and go and move independently. Its pointer is a handle: a number that is looked up and never
/// followed.
///
/// One thread at a time may use a world, as for a detector.
pub struct WorldHandle {
    _nothing: [u8; 0],
}

/// The number of a mesh of a world, never 0. No other mesh of the world ever receives the same number.
pub type MeshNumber = u64;

/// A world for one format of positions, with a buffer for its contacts.
pub(crate) struct WorldFinder<S: Scalar> {
    world: World<[S; 3]>,
    contacts: Vec<WorldContact<S>>,
}

impl<S: Scalar> WorldFinder<S> {
    fn new() -> Self {
        Self {
            world: World::new(),
            contacts: Vec::new(),
        }
    }
}

pub(crate) struct HandledWorld {
    finder: AnyFinder<Self>,
    answers: WorldAnswers,
}

impl OfFormat for HandledWorld {
    type Finder<S: Format> = WorldFinder<S>;
}

/// The lists to which C holds pointers.
#[derive(Default)]
struct WorldAnswers {
    contacts: Vec<WorldContactRow>,
    /// The geometries of contacts, before C sees them.
    found_geometries: Vec<WorldContactGeometry>,
    geometries: Vec<WorldGeometryRow>,
}

impl Handled for HandledWorld {
    type Handle = WorldHandle;
    const NAME: &'static str = "world";
    const NO_SUCH: Status = Status::NoSuchWorld;

    fn living() -> &'static Living<Self> {
        static LIVING: Living<HandledWorld> = Living::new();
        &LIVING
    }

    fn cancellation(&self) -> Cancellation {
        with_either!(&self.finder, finder => finder.world.cancellation())
    }
}

fn on(handle: *const WorldHandle, action: impl FnOnce(&mut HandledWorld) -> Result<(), Failure>) -> Status {
    handles::on(handle, |_, world| action(world))
}

fn on_format<S: Format>(
    handle: *const WorldHandle,
    action: impl FnOnce(&mut WorldFinder<S>, &mut WorldAnswers) -> Result<(), Failure>,
) -> Status {
    on(handle, |it| {
        let Some(finder) = S::of(&mut it.finder) else {
            let text = format!("the world is not for positions in {}", S::NAME);
            return Err(Failure::new(Status::WrongScalar, text));
        };
        action(finder, &mut it.answers)
    })
}

fn mesh(bits: MeshNumber) -> Result<MeshHandle, Failure> {
    let none = || Failure::new(Status::NoSuchMesh, format!("{bits} is not the number of a mesh"));
    MeshHandle::from_bits(bits).ok_or_else(none)
}

/// Creates a world without meshes. `scalar` is a selvedge_scalar, the format of its positions. By default it uses the calling
/// thread, and contacts are pairs within the default tolerance of that format.
///
/// `*world` receives the handle; free it with selvedge_world_free.
///
/// # Safety
/// `world` points to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_new(scalar: u32, world: *mut *mut WorldHandle) -> Status {
    guarded(|| {
        // SAFETY: the caller's promise.
        let out = unsafe { Out::new("where the world goes", world) }?;
        let finder = match scalar {
            number if number == ScalarFormat::F32 as u32 => AnyFinder::F32(WorldFinder::new()),
            number if number == ScalarFormat::F64 as u32 => AnyFinder::F64(WorldFinder::new()),
            number => return Err(unknown("selvedge_scalar", number)),
        };
        out.set(handles::keep(HandledWorld {
            finder,
            answers: WorldAnswers::default(),
        })?);
        Ok(())
    })
}

/// Frees a world, its meshes and its lists. NULL is allowed. A world that another thread is using is freed when that call has
/// ended.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_free(world: *mut WorldHandle) -> Status {
    handles::free::<HandledWorld>(world)
}

/// Cancels calls on a world, as selvedge_detector_set_cancelled. A cancelled step has begun: its meshes rest at the end of their
/// motions until they are given new ones.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_cancelled(world: *mut WorldHandle, cancelled: i32) -> Status {
    handles::set_cancelled::<HandledWorld>(world, cancelled)
}

/// Sets the number of threads of a step, as selvedge_detector_set_threads.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_threads(world: *mut WorldHandle, count: usize) -> Status {
    handles::on::<HandledWorld>(world, |kept, it| {
        with_either!(&mut it.finder, finder => finder.world.set_threads(Threads::from_count(count)))?;
        kept.set_has_threads(count != 1);
        Ok(())
    })
}

/// Sets the minimum separation and the tolerance, as selvedge_detector_set_within. If the separation changes, the next step fits
/// all boxes again.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_within(world: *mut WorldHandle, separation: f64, tolerance: f64) -> Status {
    on(world, |it| {
        with_either!(&mut it.finder, finder => {
            let (separation, tolerance) = (length(separation)?, length(tolerance)?);
            finder.world.set_criterion(Criterion::Within(Limits { tolerance, separation }))?;
        });
        Ok(())
    })
}

/// Reports only pairs that truly touch, as selvedge_detector_set_touching. For rotating bodies it reports pairs within the
/// tolerance.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_touching(world: *mut WorldHandle, tolerance: f64) -> Status {
    on(world, |it| {
        with_either!(&mut it.finder, finder => {
            let tolerance = length(tolerance)?;
            finder.world.set_criterion(Criterion::Touching { tolerance })?;
        });
        Ok(())
    })
}

/// Limits the number of candidate pairs of a step, as selvedge_detector_set_pair_limit. UINT64_MAX, the default, is no limit.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_pair_limit(world: *mut WorldHandle, limit: u64) -> Status {
    on(world, |it| {
        let limit = Some(limit).filter(|&limit| limit != u64::MAX);
        with_either!(&mut it.finder, finder => finder.world.set_pair_limit(limit));
        Ok(())
    })
}

/// Limits the memory of the contacts of a step, as for a detector. UINT64_MAX is no limit.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_memory_limit(world: *mut WorldHandle, limit: u64) -> Status {
    on(world, |it| {
        let limit = Some(limit).filter(|&limit| limit != u64::MAX);
        with_either!(&mut it.finder, finder => finder.world.set_memory_limit(limit));
        Ok(())
    })
}

struct Inserted<S> {
    vertex_count: usize,
    triangles: (*const u32, usize),
    positions: *const S,
    groups: *const GroupsRow,
    mesh: *mut MeshNumber,
}

impl<S: Format> Inserted<S> {
    /// # Safety
    /// The conditions are those of selvedge_world_insert_f64.
    unsafe fn into(self, world: *mut WorldHandle) -> Status {
        on_format::<S>(world, |finder, _| {
            let (triangles, count) = self.triangles;
            // SAFETY: the caller's promises.
            let (out, topology, positions, groups) = unsafe {
                (
                    Out::new("where the mesh goes", self.mesh)?,
                    topology(self.vertex_count, triangles, count)?,
                    view("positions", self.positions, self.vertex_count)?,
                    groups_at(self.groups)?,
                )
            };
            let handle = finder.world.insert(topology, positions, groups)?;
            out.set(handle.to_bits());
            Ok(())
        })
    }
}

/// Returns the groups at a pointer; those that collide with all for NULL.
///
/// # Safety
/// Unless it is null or misaligned, it points to groups.
unsafe fn groups_at(groups: *const GroupsRow) -> Result<Groups, Failure> {
    if groups.is_null() {
        return Ok(Groups::ALL);
    }
    // SAFETY: the caller's promise. The layout is two numbers, as fields or as an array.
    let given = unsafe { view::<_, 2>("groups", groups.cast::<u32>(), 1) }?;
    Ok(given
        .iter()
        .map(|&[memberships, filter]| Groups::new(memberships, filter))
        .next()
        .unwrap_or(Groups::ALL))
}

/// Removes a mesh. Its number is never used again.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_remove(world: *mut WorldHandle, mesh: MeshNumber) -> Status {
    on(world, |it| {
        let mesh = self::mesh(mesh)?;
        Ok(with_either!(&mut it.finder, finder => finder.world.remove(mesh))?)
    })
}

/// Sets which meshes this one can collide with from now on, itself included. NULL means all.
///
/// # Safety
/// `groups` points to one entry unless it is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_set_groups(
    world: *mut WorldHandle,
    mesh: MeshNumber,
    groups: *const GroupsRow,
) -> Status {
    on(world, |it| {
        // SAFETY: the caller's promise.
        let groups = unsafe { groups_at(groups) }?;
        let mesh = self::mesh(mesh)?;
        Ok(with_either!(&mut it.finder, finder => finder.world.set_groups(mesh, groups))?)
    })
}

/// Returns the edges of a mesh in the order of their numbers. Each is a pair of vertices, the smaller number first.
///
/// The list stays valid until the mesh is removed or the world is freed.
///
/// # Safety
/// `edges` points to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_edges(
    world: *const WorldHandle,
    mesh: MeshNumber,
    edges: *mut *const PairRow,
    count: *mut usize,
) -> Status {
    on(world, |it| {
        // SAFETY: the caller's promise.
        let out = unsafe { OutList::new("edges", edges, count) }?;
        let mesh = self::mesh(mesh)?;
        let topology: Result<_, WorldError> = with_either!(&it.finder, finder => finder.world.topology(mesh));
        out.set_pairs(topology?.edges());
        Ok(())
    })
}
