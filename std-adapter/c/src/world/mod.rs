//! Worlds: meshes that come and go, and how a world is to look.

pub(crate) mod steps;
#[cfg(test)]
mod tests;

use crate::answers::Pair;
use crate::detector::{ScalarFormat, topology};
use crate::guard::guarded;
use crate::handles::{self, Handled, Living};
use crate::input::{Out, OutList, Plain, unknown, view};
use crate::settings::{GroupsRow, length};
use crate::status::{Failure, Status};
use selvedge::core::elementary::Limits;
use selvedge::{
    Cancellation, Criterion, Groups, MeshHandle, Scalar, Threads, World, WorldContact, WorldContactGeometry, WorldError,
};
use steps::{WorldContactRow, WorldGeometryRow};

/// Meshes that come and go, and move as they like. Only pointers to it exist; they are numbers, and nothing is behind them.
///
/// One thread at a time, as for a detector.
pub struct WorldHandle {
    _nothing: [u8; 0],
}

/// A mesh of a world, as a number that is never 0. It stays its name for good: no other mesh of the world gets the same one.
pub type Mesh = u64;

/// A world for one format of positions, and where its contacts go first.
pub(crate) struct Finder<S: Scalar> {
    world: World<[S; 3]>,
    contacts: Vec<WorldContact<S>>,
}

impl<S: Scalar> Finder<S> {
    fn new() -> Self {
        Self {
            world: World::new(),
            contacts: Vec::new(),
        }
    }
}

pub(crate) enum AnyFinder {
    F32(Finder<f32>),
    F64(Finder<f64>),
}

/// Does the same with a world of either format.
macro_rules! with_either {
    ($any:expr, $finder:ident => $action:expr) => {
        match $any {
            AnyFinder::F32($finder) => $action,
            AnyFinder::F64($finder) => $action,
        }
    };
}
use with_either;

/// A format of positions that there are worlds for.
pub(crate) trait Format: Scalar + Plain {
    fn of(any: &mut AnyFinder) -> Option<&mut Finder<Self>>;
}

impl Format for f32 {
    fn of(any: &mut AnyFinder) -> Option<&mut Finder<Self>> {
        match any {
            AnyFinder::F32(finder) => Some(finder),
            AnyFinder::F64(_) => None,
        }
    }
}

impl Format for f64 {
    fn of(any: &mut AnyFinder) -> Option<&mut Finder<Self>> {
        match any {
            AnyFinder::F32(_) => None,
            AnyFinder::F64(finder) => Some(finder),
        }
    }
}

/// What a call works on.
pub(crate) struct HandledWorld {
    finder: AnyFinder,
    answers: Answers,
}

/// The lists that pointers given to C show.
#[derive(Default)]
struct Answers {
    contacts: Vec<WorldContactRow>,
    /// Of contacts, before they are shown.
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

/// Does something with a world.
fn on(handle: *const WorldHandle, action: impl FnOnce(&mut HandledWorld) -> Result<(), Failure>) -> Status {
    handles::on(handle, |_, world| action(world))
}

/// Does something with a world for positions of this format.
fn on_format<S: Format>(
    handle: *const WorldHandle,
    action: impl FnOnce(&mut Finder<S>, &mut Answers) -> Result<(), Failure>,
) -> Status {
    on(handle, |it| {
        let Some(finder) = S::of(&mut it.finder) else {
            let text = format!("the world is not for positions in {}", S::NAME);
            return Err(Failure::new(Status::WrongScalar, text));
        };
        action(finder, &mut it.answers)
    })
}

fn mesh(bits: Mesh) -> Result<MeshHandle, Failure> {
    let none = || Failure::new(Status::NoSuchMesh, format!("{bits} is the number of no mesh"));
    MeshHandle::from_bits(bits).ok_or_else(none)
}

/// A world without meshes. `scalar` is a selvedge_scalar: the format that its positions will have. On the calling thread at first,
/// contacts within the default tolerance of that format.
///
/// `*world` becomes the handle; selvedge_world_free gives back what it takes.
///
/// # Safety
/// `world` points to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_new(scalar: u32, world: *mut *mut WorldHandle) -> Status {
    guarded(|| {
        // SAFETY: the caller's promise.
        let out = unsafe { Out::new("where the world goes", world) }?;
        let finder = match scalar {
            number if number == ScalarFormat::F32 as u32 => AnyFinder::F32(Finder::new()),
            number if number == ScalarFormat::F64 as u32 => AnyFinder::F64(Finder::new()),
            number => return Err(unknown("selvedge_scalar", number)),
        };
        out.set(handles::keep(HandledWorld {
            finder,
            answers: Answers::default(),
        })?);
        Ok(())
    })
}

/// Frees a world, its meshes and all that it has shown. NULL is well. One that another thread is using goes when that call has ended.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_free(world: *mut WorldHandle) -> Status {
    handles::free::<HandledWorld>(world)
}

/// As selvedge_detector_set_cancelled, for a world. A step that is cut short has begun: what was to move rests where it would have
/// ended unless it is told to move again.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_cancelled(world: *mut WorldHandle, cancelled: i32) -> Status {
    handles::set_cancelled::<HandledWorld>(world, cancelled)
}

/// How many threads steps are split between, as of a detector.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_threads(world: *mut WorldHandle, count: usize) -> Status {
    handles::on::<HandledWorld>(world, |kept, it| {
        with_either!(&mut it.finder, finder => finder.world.set_threads(Threads::from_count(count)))?;
        kept.set_has_threads(count != 1);
        Ok(())
    })
}

/// Contacts are pairs that cannot be proven to stay farther apart than `separation`, as of a detector. The next step fits all boxes
/// anew if the separation is another one.
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

/// Contacts are only pairs that truly touch, decided exactly, as of a detector; of bodies that turn those within the tolerance.
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

/// Most pairs that a step may look at, as of a detector; UINT64_MAX, as at first: as many as there are.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_set_pair_limit(world: *mut WorldHandle, limit: u64) -> Status {
    on(world, |it| {
        let limit = Some(limit).filter(|&limit| limit != u64::MAX);
        with_either!(&mut it.finder, finder => finder.world.set_pair_limit(limit));
        Ok(())
    })
}

/// What came for a mesh that is to be inserted.
struct Inserted<S> {
    vertex_count: usize,
    triangles: (*const u32, usize),
    positions: *const S,
    groups: *const GroupsRow,
    mesh: *mut Mesh,
}

impl<S: Format> Inserted<S> {
    /// # Safety
    /// As selvedge_world_insert_f64.
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

/// # Safety
/// Unless it is null or misaligned, it points to groups.
unsafe fn groups_at(groups: *const GroupsRow) -> Result<Groups, Failure> {
    if groups.is_null() {
        return Ok(Groups::ALL);
    }
    // SAFETY: the caller's promise. Two numbers in a row, whether as fields or as an array.
    let given = unsafe { view::<_, 2>("groups", groups.cast::<u32>(), 1) }?;
    Ok(given
        .iter()
        .map(|&[memberships, filter]| Groups::new(memberships, filter))
        .next()
        .unwrap_or(Groups::ALL))
}

/// A new mesh that rests at these positions. `groups` say which meshes it is looked at with, itself among them; NULL: with all.
/// `*mesh` becomes its number.
///
/// Triangles and positions are copied. Edges and points of ropes, hair and particles are triangles that name a vertex twice or three times,
/// as of a detector.
///
/// # Safety
/// `triangles` points to 3 * `triangle_count` vertex numbers, `positions` to 3 * `vertex_count` numbers, `groups` to one entry unless it is
/// NULL, `mesh` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_insert_f64(
    world: *mut WorldHandle,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    positions: *const f64,
    groups: *const GroupsRow,
    mesh: *mut Mesh,
) -> Status {
    let inserted = Inserted {
        vertex_count,
        triangles: (triangles, triangle_count),
        positions,
        groups,
        mesh,
    };
    // SAFETY: the caller's promises.
    unsafe { inserted.into(world) }
}

/// selvedge_world_insert_f64 for float.
///
/// # Safety
/// As selvedge_world_insert_f64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_insert_f32(
    world: *mut WorldHandle,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    positions: *const f32,
    groups: *const GroupsRow,
    mesh: *mut Mesh,
) -> Status {
    let inserted = Inserted {
        vertex_count,
        triangles: (triangles, triangle_count),
        positions,
        groups,
        mesh,
    };
    // SAFETY: the caller's promises.
    unsafe { inserted.into(world) }
}

/// Takes a mesh out. Its number then names nothing, for good.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_world_remove(world: *mut WorldHandle, mesh: Mesh) -> Status {
    on(world, |it| {
        let mesh = self::mesh(mesh)?;
        Ok(with_either!(&mut it.finder, finder => finder.world.remove(mesh))?)
    })
}

/// Which meshes this one is looked at with from now on, itself among them; NULL: with all.
///
/// # Safety
/// `groups` points to one entry unless it is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_set_groups(world: *mut WorldHandle, mesh: Mesh, groups: *const GroupsRow) -> Status {
    on(world, |it| {
        // SAFETY: the caller's promise.
        let groups = unsafe { groups_at(groups) }?;
        let mesh = self::mesh(mesh)?;
        Ok(with_either!(&mut it.finder, finder => finder.world.set_groups(mesh, groups))?)
    })
}

/// The edges of a mesh by their numbers, each as its vertices, the smaller first; `count` becomes how many there are.
///
/// They stay where they are until the mesh is removed, or the world freed.
///
/// # Safety
/// `edges` points to a pointer, `count` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn selvedge_world_edges(
    world: *const WorldHandle,
    mesh: Mesh,
    edges: *mut *const Pair,
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
