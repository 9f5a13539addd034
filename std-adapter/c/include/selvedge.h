/* Selvedge: which vertex-face and edge-edge pairs of a deforming triangle mesh can collide during a time step.
 *
 * Made by cbindgen from std-adapter/c/src; do not edit. README.md beside it begins with an example.
 *
 * Every function returns a selvedge_status, those that only read a constant or a text excepted. One that fails has changed
 * nothing, and written nothing to where its answers go; selvedge_last_error() says what is wrong.
 *
 * Positions are three numbers for each vertex, x y z, one vertex after another, in a unit of yours. Times are in [0, 1] of the
 * step. Triangles are three vertex numbers each.
 */

#ifndef SELVEDGE_H
#define SELVEDGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/**
 * The major version of the header. It changes with an incompatible change.
 */
#define SELVEDGE_VERSION_MAJOR 0

/**
 * The minor version of the header. Below 1.0 it changes with an incompatible change.
 */
#define SELVEDGE_VERSION_MINOR 1

/**
 * The patch version of the header.
 */
#define SELVEDGE_VERSION_PATCH 0

/**
 * The version of the header as one number. selvedge_version() returns that of the library.
 */
#define SELVEDGE_VERSION (((1000000 * SELVEDGE_VERSION_MAJOR) + (1000 * SELVEDGE_VERSION_MINOR)) + SELVEDGE_VERSION_PATCH)

/**
 * The default tolerance of detectors for float: 2^-20, a micrometre if positions are in metres.
 */
#define SELVEDGE_DEFAULT_TOLERANCE_F32 9.5367431640625e-7

/**
 * The default tolerance of detectors for double: 2^-30, a nanometre if positions are in metres.
 */
#define SELVEDGE_DEFAULT_TOLERANCE_F64 9.313225746154785e-10

/**
 * The result of a call.
 */
enum selvedge_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The call succeeded.
   */
  SELVEDGE_STATUS_OK = 0,
  /**
   * A pointer is NULL where NULL is not allowed.
   */
  SELVEDGE_STATUS_NULL_POINTER = 1,
  /**
   * A pointer does not have the alignment of its type.
   */
  SELVEDGE_STATUS_MISALIGNED_POINTER = 2,
  /**
   * A count exceeds memory or the largest allowed value.
   */
  SELVEDGE_STATUS_BAD_COUNT = 3,
  /**
   * A number is not a value of its enumeration.
   */
  SELVEDGE_STATUS_UNKNOWN_CONSTANT = 4,
  /**
   * The detector was freed or never created.
   */
  SELVEDGE_STATUS_NO_SUCH_DETECTOR = 5,
  /**
   * Another thread is using the detector, world or simulation.
   */
  SELVEDGE_STATUS_BUSY = 6,
  /**
   * The detector or world is for positions in the other format.
   */
  SELVEDGE_STATUS_WRONG_SCALAR = 7,
  /**
   * The mesh has no triangles.
   */
  SELVEDGE_STATUS_NO_TRIANGLES = 8,
  /**
   * A triangle, or a pair of vertices, names a vertex that the mesh does not have.
   */
  SELVEDGE_STATUS_VERTEX_OUT_OF_RANGE = 9,
  /**
   * The mesh has more vertices or triangles than can be numbered.
   */
  SELVEDGE_STATUS_TOO_LARGE = 10,
  /**
   * A list does not have one entry for each vertex.
   */
  SELVEDGE_STATUS_WRONG_LENGTH = 11,
  /**
   * A coordinate is NaN or infinite.
   */
  SELVEDGE_STATUS_NOT_FINITE = 12,
  /**
   * A separation, a tolerance or a distance is negative, NaN or infinite.
   */
  SELVEDGE_STATUS_BAD_LIMIT = 13,
  /**
   * A pair names a vertex, a face or an edge that the mesh does not have.
   */
  SELVEDGE_STATUS_NO_SUCH_PAIR = 14,
  /**
   * The threads could not be started, or their number is too large.
   */
  SELVEDGE_STATUS_NO_THREADS = 15,
  /**
   * The operating system refused memory.
   */
  SELVEDGE_STATUS_NO_MEMORY = 16,
  /**
   * The process was forked after the detector, world or simulation had started threads. The child does not have them.
   */
  SELVEDGE_STATUS_FORKED = 17,
  /**
   * The call was cancelled.
   */
  SELVEDGE_STATUS_CANCELLED = 18,
  /**
   * There are more candidate pairs than the limit allows.
   */
  SELVEDGE_STATUS_TOO_MANY_PAIRS = 19,
  /**
   * A contact's time is not in [0, 1].
   */
  SELVEDGE_STATUS_BAD_TIME = 20,
  /**
   * The library has a bug. The detector, world or simulation can only be freed from now on.
   */
  SELVEDGE_STATUS_INTERNAL = 21,
  /**
   * The world was freed or never created.
   */
  SELVEDGE_STATUS_NO_SUCH_WORLD = 22,
  /**
   * The world has no such mesh: it was removed, or it belongs to another world.
   */
  SELVEDGE_STATUS_NO_SUCH_MESH = 23,
  /**
   * A mesh has two motions in one step.
   */
  SELVEDGE_STATUS_MOVED_TWICE = 24,
  /**
   * A pose is invalid: a number is not finite, the quaternion is zero, or the mesh would leave the range of the format.
   */
  SELVEDGE_STATUS_BAD_POSE = 25,
  /**
   * The simulation was freed or never created.
   */
  SELVEDGE_STATUS_NO_SUCH_SIMULATION = 26,
  /**
   * A scene is invalid. The message names file, line and column where there is one.
   */
  SELVEDGE_STATUS_BAD_SCENE = 27,
  /**
   * A step found no motion without an intersection, in a scene that stops then. The part of the step that was done remains.
   */
  SELVEDGE_STATUS_BLOCKED = 28,
  /**
   * The scene has no such cloth, body, group of pins or wind.
   */
  SELVEDGE_STATUS_NO_SUCH_PART = 29,
  /**
   * A body or a group of pins cannot be moved: its scene does not say that it is driven.
   */
  SELVEDGE_STATUS_NOT_DRIVEN = 30,
  /**
   * A position or a velocity is not finite or out of its range.
   */
  SELVEDGE_STATUS_BAD_VALUE = 31,
  /**
   * The bytes are not a checkpoint, are damaged, or belong to another scene.
   */
  SELVEDGE_STATUS_BAD_CHECKPOINT = 32,
  /**
   * There is no checkpoint after this step. One exists every SELVEDGE_CHECKPOINT_STEPS steps.
   */
  SELVEDGE_STATUS_NO_CHECKPOINT = 33,
  /**
   * A text is not valid UTF-8.
   */
  SELVEDGE_STATUS_BAD_TEXT = 34,
  /**
   * A scene starts with surfaces that pass through each other. The message names the first place and the possible settings.
   */
  SELVEDGE_STATUS_TANGLED = 35,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum selvedge_status selvedge_status;
#else
typedef int32_t selvedge_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The primitives of a pair.
 */
enum selvedge_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * A vertex and a face.
   */
  SELVEDGE_KIND_VERTEX_FACE = 0,
  /**
   * Two edges.
   */
  SELVEDGE_KIND_EDGE_EDGE = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum selvedge_kind selvedge_kind;
#else
typedef uint32_t selvedge_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The format of a detector's positions.
 */
enum selvedge_scalar
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * float: functions whose names end in _f32.
   */
  SELVEDGE_SCALAR_F32 = 0,
  /**
   * double: functions whose names end in _f64.
   */
  SELVEDGE_SCALAR_F64 = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum selvedge_scalar selvedge_scalar;
#else
typedef uint32_t selvedge_scalar;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The bounding boxes that generate candidates.
 */
enum selvedge_boxes
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * The boxes at the start and at the end of the step. Two primitives are apart if an axis orders both pairs of boxes alike. This
   * gives fewer pairs in less time.
   */
  SELVEDGE_BOXES_MOVING = 0,
  /**
   * The boxes that primitives sweep; they overlap. Other libraries call these pairs candidates.
   */
  SELVEDGE_BOXES_SWEPT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum selvedge_boxes selvedge_boxes;
#else
typedef uint32_t selvedge_boxes;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The primitives that intersect.
 */
enum selvedge_intersection_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * An edge passes through a face, or touches it.
   */
  SELVEDGE_INTERSECTION_KIND_EDGE_FACE = 0,
  /**
   * A vertex touches a face of a neighbour, folded flat onto it.
   */
  SELVEDGE_INTERSECTION_KIND_VERTEX_FACE = 1,
  /**
   * Two edges of neighbours touch, folded flat onto each other.
   */
  SELVEDGE_INTERSECTION_KIND_EDGE_EDGE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum selvedge_intersection_kind selvedge_intersection_kind;
#else
typedef uint32_t selvedge_intersection_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A detector for one mesh. Its pointer is a handle: a number that is looked up and never followed.
 *
 * One thread at a time may use a detector. A call on a detector in use fails with SELVEDGE_STATUS_BUSY and changes nothing.
 * Different detectors are independent, and each may have a thread of its own.
 */
typedef struct selvedge_detector selvedge_detector;

/**
 * Meshes that come and go, and move as they like. Only pointers to it exist; they are numbers, and nothing is behind them.
 *
 * One thread at a time, as for a detector.
 */
typedef struct selvedge_world selvedge_world;

/**
 * The groups of a vertex and the groups it collides with, a bit for each group. Two vertices collide if each is in a group of the
 * other's filter.
 */
typedef struct selvedge_groups {
  /**
   * The groups that it is in.
   */
  uint32_t memberships;
  /**
   * The groups that it collides with.
   */
  uint32_t filter;
} selvedge_groups;

/**
 * The numbers of a vertex and a face, of two edges, or of two vertices (the ends of an edge).
 */
typedef struct selvedge_pair {
  /**
   * The vertex, or the first edge.
   */
  uint32_t first;
  /**
   * The face, or the second edge.
   */
  uint32_t second;
} selvedge_pair;

/**
 * A pair that may touch during the step.
 */
typedef struct selvedge_contact {
  /**
   * The time in [0, 1] of the step, not after the exact time. A detector for float gives a float, widened without rounding.
   */
  double time;
  /**
   * A selvedge_kind.
   */
  uint32_t kind;
  /**
   * The vertex and the face, or the two edges. Faces have the numbers of the triangles, edges those of selvedge_detector_edges.
   */
  struct selvedge_pair pair;
  /**
   * The vertex and the face's three, or the ends of the first edge and of the second.
   */
  uint32_t vertices[4];
} selvedge_contact;

/**
 * Two primitives of a mesh at rest that share a point, but no vertex.
 */
typedef struct selvedge_intersection {
  /**
   * A selvedge_intersection_kind.
   */
  uint32_t kind;
  /**
   * The edge and the face, the vertex and the face, or the two edges.
   */
  struct selvedge_pair pair;
} selvedge_intersection;

/**
 * The geometry of two primitives at the time of a contact, or at rest. Lengths are in the unit of the positions. All values are
 * computed in double, for float as well.
 */
typedef struct selvedge_geometry {
  /**
   * A selvedge_kind.
   */
  uint32_t kind;
  /**
   * The vertex and the face, or the two edges.
   */
  struct selvedge_pair pair;
  /**
   * The vertex and the face's three, or the ends of the first edge and of the second.
   */
  uint32_t vertices[4];
  /**
   * Whether there is a normal. There is none if the two cannot be shown to have been apart: they touch at the start of the step or
   * earlier in it; or, at rest, they touch.
   */
  bool has_normal;
  /**
   * Barycentric weights of the four vertices, in [0, 1]. The weights of each side add up to one.
   */
  double weights[4];
  /**
   * The closest points of the first and of the second side; they have these weights.
   */
  double points[2][3];
  /**
   * The direction from the second side to the first, of length one; zeros if there is no normal.
   */
  double normal[3];
  /**
   * A time at which the sides were certainly apart along the normal: that of the contact, or slightly earlier. 0 without a normal.
   */
  double separated_at;
  /**
   * A lower and an upper bound of the distance of the two sides at that time.
   */
  double distance[2];
  /**
   * The speed at which the first point moves away from the second along the normal, in lengths per step. It is negative if they
   * approach each other, and zero without a normal.
   */
  double speed;
} selvedge_geometry;

/**
 * The counts of a step that was truncated vertex by vertex.
 */
typedef struct selvedge_truncation {
  /**
   * The number of vertices that do not go their whole way.
   */
  size_t held_back;
  /**
   * The number of pairs in contact at the start. Their vertices rest. If it is 0, the step is certainly free of contact.
   */
  size_t in_contact;
  /**
   * The number of searches for contacts.
   */
  size_t rounds;
} selvedge_truncation;

/**
 * A mesh of a world, as a number that is never 0. It stays its name for good: no other mesh of the world gets the same one.
 */
typedef uint64_t selvedge_mesh;

/**
 * A mesh of a world whose vertices move, each on a straight path and at constant velocity, such as cloth or a soft body. The mesh
 * can also meet itself.
 */
typedef struct Deforming_f64 {
  /**
   * The mesh.
   */
  selvedge_mesh mesh;
  /**
   * The positions at the start: 3 * `vertex_count` numbers.
   */
  const double *start;
  /**
   * The positions at the end.
   */
  const double *end;
  /**
   * The number of vertices of the mesh.
   */
  size_t vertex_count;
} Deforming_f64;

/**
 * Where a body is: what its shape, which is that it was inserted with, is turned and moved by.
 */
typedef struct selvedge_pose {
  /**
   * A quaternion, x y z w. Of any length but zero.
   */
  double rotation[4];
  /**
   * Where the shape's origin is.
   */
  double origin[3];
} selvedge_pose;

/**
 * A mesh of a world that moves as one body, of the shape that it was inserted with, from one pose to another. It turns the short way at a
 * constant rate, about an axis through its origin, which moves straight.
 *
 * With two rotations that are equal every vertex moves straight; else on arcs, of which no contact is missed.
 */
typedef struct selvedge_rigid {
  /**
   * Which mesh.
   */
  selvedge_mesh mesh;
  /**
   * Where it is at the start.
   */
  struct selvedge_pose start;
  /**
   * And at the end.
   */
  struct selvedge_pose end;
} selvedge_rigid;

/**
 * A pair of a world for which contact during the step is not excluded.
 */
typedef struct selvedge_world_contact {
  /**
   * The mesh of the vertex and that of the face; or those of the two edges. One mesh twice, if it meets itself.
   */
  selvedge_mesh meshes[2];
  /**
   * When, and which primitives. They and their vertices are numbered as by their own meshes.
   */
  struct selvedge_contact contact;
} selvedge_world_contact;

/**
 * Two primitives of a world and how they lie to each other at the time of a contact.
 */
typedef struct selvedge_world_geometry {
  /**
   * As the contact has them.
   */
  selvedge_mesh meshes[2];
  /**
   * How they lie. Primitives and vertices are numbered as by their own meshes.
   */
  struct selvedge_geometry geometry;
} selvedge_world_geometry;

/**
 * A mesh of a world whose vertices move, each on a straight path and at constant velocity, such as cloth or a soft body. The mesh
 * can also meet itself.
 */
typedef struct Deforming_f32 {
  /**
   * The mesh.
   */
  selvedge_mesh mesh;
  /**
   * The positions at the start: 3 * `vertex_count` numbers.
   */
  const float *start;
  /**
   * The positions at the end.
   */
  const float *end;
  /**
   * The number of vertices of the mesh.
   */
  size_t vertex_count;
} Deforming_f32;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Returns the version of the library as a text, such as "0.1.0". Never NULL; valid forever.
 */
const char *selvedge_version_string(void);

/**
 * Returns the version of the library: 1,000,000 * major + 1,000 * minor + patch. SELVEDGE_VERSION is that of the header.
 */
uint32_t selvedge_version(void);

/**
 * Returns the message of the last failed call on this thread, or an empty text. Never NULL.
 *
 * The text is valid until the next failed call on this thread, or until the thread ends. Successful calls do not change it.
 */
const char *selvedge_last_error(void);

/**
 * Returns a short text for a selvedge_status, or for any other number. Never NULL; valid forever.
 */
const char *selvedge_status_string(int32_t status);

/**
 * Creates a detector for a mesh. `scalar` is a selvedge_scalar, the format of its positions. By default it uses the calling thread,
 * all vertices move, steps are not coherent, and contacts are pairs within the default tolerance.
 *
 * A triangle that names a vertex twice, (a, b, b), is a loose edge, and one that names it three times, (p, p, p), a point: parts of
 * ropes, hair and particles. They collide as edges and points. A vertex that no triangle names collides with nothing.
 *
 * The triangles are copied. `*detector` receives the handle; free it with selvedge_detector_free.
 *
 * The caller promises:
 * `triangles` points to 3 * `triangle_count` vertex numbers, `detector` to a pointer.
 */
selvedge_status selvedge_detector_new(uint32_t scalar,
                                      size_t vertex_count,
                                      const uint32_t *triangles,
                                      size_t triangle_count,
                                      struct selvedge_detector **detector);

/**
 * Cancels the call that another thread is making, and all later calls, if `cancelled` is not 0. They fail with
 * SELVEDGE_STATUS_CANCELLED unless they are nearly done. 0 ends this; the detector then answers as usual.
 *
 * Any thread may call this at any time. Besides selvedge_detector_free it is the only function that a detector in use accepts.
 */
selvedge_status selvedge_detector_set_cancelled(struct selvedge_detector *detector,
                                                int32_t cancelled);

/**
 * Frees a detector, its lists and its threads. NULL is allowed. A detector that another thread is using is freed when that call
 * has ended.
 */
selvedge_status selvedge_detector_free(struct selvedge_detector *detector);

/**
 * Sets the number of threads of a step. 1, the default, is the calling thread; larger numbers start threads of the detector; 0 is
 * one for each core. Answers are the same bit for bit. More than four for each core, or more than 256, are refused.
 */
selvedge_status selvedge_detector_set_threads(struct selvedge_detector *detector,
                                              size_t count);

/**
 * Reports pairs that may come within `separation` of each other. A pair that only comes within `separation + tolerance` may be
 * among them. By default the separation is 0 and the tolerance is SELVEDGE_DEFAULT_TOLERANCE_F32 or _F64.
 *
 * Both are in the unit of the positions. A detector for float rounds them up to a float.
 */
selvedge_status selvedge_detector_set_within(struct selvedge_detector *detector,
                                             double separation,
                                             double tolerance);

/**
 * Reports only pairs that truly touch, decided exactly. A reported time may be early: by as long as the pair takes to close the
 * distance `tolerance`.
 *
 * The tolerance is in the unit of the positions. A detector for float rounds it up to a float.
 */
selvedge_status selvedge_detector_set_touching(struct selvedge_detector *detector,
                                               double tolerance);

/**
 * Names the moving vertices: a byte for each vertex, not 0 if it moves. NULL and 0, the default: all vertices move.
 *
 * From the next step on, pairs without a moving vertex are skipped. The next step sets the positions of resting vertices; they are
 * not read again until the next call of this function. The bytes are copied.
 *
 * The caller promises:
 * `moving` points to `count` bytes.
 */
selvedge_status selvedge_detector_set_moving(struct selvedge_detector *detector,
                                             const uint8_t *moving,
                                             size_t count);

/**
 * Sets the collision filter, from the next step on. It replaces the previous one.
 *
 * Two vertices do not collide if their groups do not, if they have the same patch, or if they are an excluded pair, in either
 * order. A pair of primitives is skipped if no vertex of one side collides with any vertex of the other. NULL omits a rule; with
 * all three NULL, the default, no pair is skipped.
 *
 * `groups` and `patches` have an entry for each of the `vertex_count` vertices; the count is ignored if both are NULL. The filter
 * does not apply to selvedge_detector_contacts_of_f64. All arguments are copied.
 *
 * The caller promises:
 * `groups` and `patches` are NULL or point to `vertex_count` entries, `excluded` to `excluded_count` pairs of vertices.
 */
selvedge_status selvedge_detector_set_collision_filter(struct selvedge_detector *detector,
                                                       const struct selvedge_groups *groups,
                                                       const uint32_t *patches,
                                                       size_t vertex_count,
                                                       const struct selvedge_pair *excluded,
                                                       size_t excluded_count);

/**
 * Sets whether each step starts where the last one ended, as in a simulation: not 0, or 0 as by default. Such steps are faster if
 * vertices move by much less than an edge. The contacts are the same, in ascending order of their pairs.
 */
selvedge_status selvedge_detector_set_coherent(struct selvedge_detector *detector,
                                               int32_t coherent);

/**
 * Limits the number of candidate pairs of a call. UINT64_MAX, the default, is no limit. A call with more pairs fails with
 * SELVEDGE_STATUS_TOO_MANY_PAIRS, on any number of threads.
 */
selvedge_status selvedge_detector_set_pair_limit(struct selvedge_detector *detector,
                                                 uint64_t limit);

/**
 * Returns the number of threads of a step.
 *
 * The caller promises:
 * `count` points to a number.
 */
selvedge_status selvedge_detector_threads(const struct selvedge_detector *detector, size_t *count);

/**
 * Returns the edges of the mesh in the order of their numbers. Each is a pair of vertices, the smaller number first.
 *
 * The list stays valid until the detector is freed.
 *
 * The caller promises:
 * `edges` points to a pointer, `count` to a number.
 */
selvedge_status selvedge_detector_edges(const struct selvedge_detector *detector,
                                        const struct selvedge_pair **edges,
                                        size_t *count);

/**
 * Finds all contacts of the step from `start` to `end`. The list stays valid until the next search for contacts with this
 * detector, or until the detector is freed. An empty list is at NULL.
 *
 * The caller promises:
 * `start` and `end` point to 3 * `vertex_count` numbers, `contacts` to a pointer, `count` to a number.
 */
selvedge_status selvedge_detector_contacts_f64(struct selvedge_detector *detector,
                                               const double *start,
                                               const double *end,
                                               size_t vertex_count,
                                               const struct selvedge_contact **contacts,
                                               size_t *count);

/**
 * Finds the contacts among the given pairs, in their order. The pairs may be this detector's own candidates. The list stays valid
 * as for selvedge_detector_contacts_f64.
 *
 * The caller promises:
 * As selvedge_detector_contacts_f64; `vertex_face` and `edge_edge` point to as many pairs as their counts say.
 */
selvedge_status selvedge_detector_contacts_of_f64(struct selvedge_detector *detector,
                                                  const double *start,
                                                  const double *end,
                                                  size_t vertex_count,
                                                  const struct selvedge_pair *vertex_face,
                                                  size_t vertex_face_count,
                                                  const struct selvedge_pair *edge_edge,
                                                  size_t edge_edge_count,
                                                  const struct selvedge_contact **contacts,
                                                  size_t *count);

/**
 * Finds the earliest contact of the step. Of several at the same time it is the one with the smallest numbers.
 *
 * `*found` says whether there is one. If so, `*contact` receives it, and the step is free of contact before its time. Otherwise
 * the whole step is free, and `*contact` stays unchanged.
 *
 * The caller promises:
 * `start` and `end` point to 3 * `vertex_count` numbers, `found` and `contact` to one value of their type.
 */
selvedge_status selvedge_detector_earliest_f64(struct selvedge_detector *detector,
                                               const double *start,
                                               const double *end,
                                               size_t vertex_count,
                                               bool *found,
                                               struct selvedge_contact *contact);

/**
 * Decides whether the step is certainly free of contact. The search ends at the first contact.
 *
 * The caller promises:
 * `start` and `end` point to 3 * `vertex_count` numbers, `is_free` to one value of its type.
 */
selvedge_status selvedge_detector_is_free_f64(struct selvedge_detector *detector,
                                              const double *start,
                                              const double *end,
                                              size_t vertex_count,
                                              bool *is_free);

/**
 * Finds the pairs that bounding boxes keep. All other pairs certainly stay farther apart than the separation throughout the step.
 * `boxes` is a selvedge_boxes. The lists stay valid until the next search for candidates with this detector, or until the
 * detector is freed.
 *
 * The caller promises:
 * `start` and `end` point to 3 * `vertex_count` numbers, `vertex_face` and `edge_edge` to pointers, the counts to numbers.
 */
selvedge_status selvedge_detector_candidates_f64(struct selvedge_detector *detector,
                                                 const double *start,
                                                 const double *end,
                                                 size_t vertex_count,
                                                 uint32_t boxes,
                                                 const struct selvedge_pair **vertex_face,
                                                 size_t *vertex_face_count,
                                                 const struct selvedge_pair **edge_edge,
                                                 size_t *edge_edge_count);

/**
 * Finds all intersections of the mesh at rest, exactly. They are edges and faces that meet, touching included, and primitives of
 * neighbours that are folded flat onto each other.
 *
 * The list is empty exactly if no two triangles share a point besides the vertices and the edge that they have in common. It
 * stays valid until the next search for intersections with this detector, or until the detector is freed.
 *
 * The caller promises:
 * `positions` points to 3 * `vertex_count` numbers, `intersections` to a pointer, `count` to a number.
 */
selvedge_status selvedge_detector_intersections_f64(struct selvedge_detector *detector,
                                                    const double *positions,
                                                    size_t vertex_count,
                                                    const struct selvedge_intersection **intersections,
                                                    size_t *count);

/**
 * Decides whether the mesh at rest intersects itself. The search ends at the first intersection.
 *
 * The caller promises:
 * `positions` points to 3 * `vertex_count` numbers, `has_any` to one value of its type.
 */
selvedge_status selvedge_detector_has_intersections_f64(struct selvedge_detector *detector,
                                                        const double *positions,
                                                        size_t vertex_count,
                                                        bool *has_any);

/**
 * Computes the geometry of each contact at its time: the closest points, their weights, a normal along which the two sides were
 * certainly apart, and bounds of their distance.
 *
 * `contacts` may be this detector's own list or rows of the caller, of which kind, pair and time are read. The geometries have the
 * same order. A detector for float rounds a time down to a float. The list stays valid until the next call of this function for
 * this detector, or until the detector is freed.
 *
 * The caller promises:
 * `start` and `end` point to 3 * `vertex_count` numbers, `contacts` to `contact_count` rows, `geometries` to a pointer, `count`
 * to a number.
 */
selvedge_status selvedge_detector_contact_geometries_f64(struct selvedge_detector *detector,
                                                         const double *start,
                                                         const double *end,
                                                         size_t vertex_count,
                                                         const struct selvedge_contact *contacts,
                                                         size_t contact_count,
                                                         const struct selvedge_geometry **geometries,
                                                         size_t *count);

/**
 * Finds all pairs within `distance` of each other in a mesh at rest, with their closest points. None is missed; a pair that is a
 * little farther apart may be included, and each row has bounds of its distance.
 *
 * Rows ascend by kind and pair. Pairs that share a vertex, pairs without a moving vertex (selvedge_detector_set_moving) and pairs
 * that selvedge_detector_set_collision_filter excludes are left out. `distance` is in the unit of the positions; a detector for
 * float rounds it up to a float. The list stays valid until the next call of this function for this detector, or until the
 * detector is freed.
 *
 * The caller promises:
 * `positions` points to 3 * `vertex_count` numbers, `geometries` to a pointer, `count` to a number.
 */
selvedge_status selvedge_detector_near_f64(struct selvedge_detector *detector,
                                           const double *positions,
                                           size_t vertex_count,
                                           double distance,
                                           const struct selvedge_geometry **geometries,
                                           size_t *count);

/**
 * Moves each vertex from `start` towards `wanted` as far as its neighbourhood allows, and writes the positions to `end`. The step
 * from `start` to `end` is free of contact, except for pairs in contact at the start; their vertices rest. `*truncation` receives
 * the counts.
 *
 * `end` may be `wanted` or `start` itself: it is written last, and not by a call that fails.
 *
 * The caller promises:
 * `start` and `wanted` point to 3 * `vertex_count` numbers, `end` to room for as many, `truncation` to one value of its type.
 */
selvedge_status selvedge_detector_truncate_f64(struct selvedge_detector *detector,
                                               const double *start,
                                               const double *wanted,
                                               size_t vertex_count,
                                               double *end,
                                               struct selvedge_truncation *truncation);

/**
 * A world without meshes. `scalar` is a selvedge_scalar: the format that its positions will have. On the calling thread at first,
 * contacts within the default tolerance of that format.
 *
 * `*world` becomes the handle; selvedge_world_free gives back what it takes.
 *
 * The caller promises:
 * `world` points to a pointer.
 */
selvedge_status selvedge_world_new(uint32_t scalar,
                                   struct selvedge_world **world);

/**
 * Frees a world, its meshes and all that it has shown. NULL is well. One that another thread is using goes when that call has ended.
 */
selvedge_status selvedge_world_free(struct selvedge_world *world);

/**
 * As selvedge_detector_set_cancelled, for a world. A step that is cut short has begun: what was to move rests where it would have
 * ended unless it is told to move again.
 */
selvedge_status selvedge_world_set_cancelled(struct selvedge_world *world,
                                             int32_t cancelled);

/**
 * How many threads steps are split between, as of a detector.
 */
selvedge_status selvedge_world_set_threads(struct selvedge_world *world, size_t count);

/**
 * Contacts are pairs that cannot be proven to stay farther apart than `separation`, as of a detector. The next step fits all boxes
 * anew if the separation is another one.
 */
selvedge_status selvedge_world_set_within(struct selvedge_world *world,
                                          double separation,
                                          double tolerance);

/**
 * Contacts are only pairs that truly touch, decided exactly, as of a detector; of bodies that turn those within the tolerance.
 */
selvedge_status selvedge_world_set_touching(struct selvedge_world *world,
                                            double tolerance);

/**
 * Most pairs that a step may look at, as of a detector; UINT64_MAX, as at first: as many as there are.
 */
selvedge_status selvedge_world_set_pair_limit(struct selvedge_world *world, uint64_t limit);

/**
 * Takes a mesh out. Its number then names nothing, for good.
 */
selvedge_status selvedge_world_remove(struct selvedge_world *world, selvedge_mesh mesh);

/**
 * Which meshes this one is looked at with from now on, itself among them; NULL: with all.
 *
 * The caller promises:
 * `groups` points to one entry unless it is NULL.
 */
selvedge_status selvedge_world_set_groups(struct selvedge_world *world,
                                          selvedge_mesh mesh,
                                          const struct selvedge_groups *groups);

/**
 * The edges of a mesh by their numbers, each as its vertices, the smaller first; `count` becomes how many there are.
 *
 * They stay where they are until the mesh is removed, or the world freed.
 *
 * The caller promises:
 * `edges` points to a pointer, `count` to a number.
 */
selvedge_status selvedge_world_edges(const struct selvedge_world *world,
                                     selvedge_mesh mesh,
                                     const struct selvedge_pair **edges,
                                     size_t *count);

/**
 * Inserts a mesh that rests at these positions. `*mesh` receives its number.
 *
 * `groups` says which meshes it can collide with, itself included; NULL: with all. Triangles and positions are copied. Edges and
 * points of ropes, hair and particles are triangles that name a vertex twice or three times, as for a detector.
 *
 * The caller promises:
 * `triangles` points to 3 * `triangle_count` vertex numbers, `positions` to 3 * `vertex_count` numbers, `groups` to one entry unless it is
 * NULL, `mesh` to a number.
 */
selvedge_status selvedge_world_insert_f64(struct selvedge_world *world,
                                          size_t vertex_count,
                                          const uint32_t *triangles,
                                          size_t triangle_count,
                                          const double *positions,
                                          const struct selvedge_groups *groups,
                                          selvedge_mesh *mesh);

/**
 * Finds all contacts of a step in which the given meshes move. Each mesh is given at most once. All other meshes rest where their
 * last motion ended.
 *
 * The list stays valid until the next search for contacts in this world, or until the world is freed. An empty list is at NULL. A
 * refused call changes nothing; for a cancelled one see selvedge_world_set_cancelled.
 *
 * The caller promises:
 * `deforming` and `rigid` point to as many entries as their counts say, each frame to 3 * `vertex_count` numbers, `contacts` to a
 * pointer, `count` to a number.
 */
selvedge_status selvedge_world_contacts_f64(struct selvedge_world *world,
                                            const struct Deforming_f64 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            const struct selvedge_world_contact **contacts,
                                            size_t *count);

/**
 * Finds the earliest contact of such a step. The step is free of contact before its time.
 *
 * `*found` says whether there is one. If not, the whole step is free, and `*contact` stays unchanged.
 *
 * The caller promises:
 * As selvedge_world_contacts_f64; `found` and `contact` point to one value each.
 */
selvedge_status selvedge_world_earliest_f64(struct selvedge_world *world,
                                            const struct Deforming_f64 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            bool *found,
                                            struct selvedge_world_contact *contact);

/**
 * Decides whether such a step is certainly free of contact.
 *
 * The caller promises:
 * As selvedge_world_contacts_f64; `is_free` points to one value.
 */
selvedge_status selvedge_world_is_free_f64(struct selvedge_world *world,
                                           const struct Deforming_f64 *deforming,
                                           size_t deforming_count,
                                           const struct selvedge_rigid *rigid,
                                           size_t rigid_count,
                                           bool *is_free);

/**
 * How the two of each contact of the last step lie to each other at its time, in their order. They stay where they are until this
 * world's contact geometries are asked for again, or it is freed. The contacts may be the world's own.
 *
 * The last step is that of the last question: of an earlier step's contacts nothing is known any more.
 *
 * The caller promises:
 * `contacts` points to `contact_count` contacts, `geometries` to a pointer, `count` to a number.
 */
selvedge_status selvedge_world_contact_geometries(struct selvedge_world *world,
                                                  const struct selvedge_world_contact *contacts,
                                                  size_t contact_count,
                                                  const struct selvedge_world_geometry **geometries,
                                                  size_t *count);

/**
 * selvedge_detector_contacts_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_contacts_f64.
 */
selvedge_status selvedge_detector_contacts_f32(struct selvedge_detector *detector,
                                               const float *start,
                                               const float *end,
                                               size_t vertex_count,
                                               const struct selvedge_contact **contacts,
                                               size_t *count);

/**
 * selvedge_detector_contacts_of_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_contacts_of_f64.
 */
selvedge_status selvedge_detector_contacts_of_f32(struct selvedge_detector *detector,
                                                  const float *start,
                                                  const float *end,
                                                  size_t vertex_count,
                                                  const struct selvedge_pair *vertex_face,
                                                  size_t vertex_face_count,
                                                  const struct selvedge_pair *edge_edge,
                                                  size_t edge_edge_count,
                                                  const struct selvedge_contact **contacts,
                                                  size_t *count);

/**
 * selvedge_detector_earliest_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_earliest_f64.
 */
selvedge_status selvedge_detector_earliest_f32(struct selvedge_detector *detector,
                                               const float *start,
                                               const float *end,
                                               size_t vertex_count,
                                               bool *found,
                                               struct selvedge_contact *contact);

/**
 * selvedge_detector_is_free_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_is_free_f64.
 */
selvedge_status selvedge_detector_is_free_f32(struct selvedge_detector *detector,
                                              const float *start,
                                              const float *end,
                                              size_t vertex_count,
                                              bool *is_free);

/**
 * selvedge_detector_candidates_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_candidates_f64.
 */
selvedge_status selvedge_detector_candidates_f32(struct selvedge_detector *detector,
                                                 const float *start,
                                                 const float *end,
                                                 size_t vertex_count,
                                                 uint32_t boxes,
                                                 const struct selvedge_pair **vertex_face,
                                                 size_t *vertex_face_count,
                                                 const struct selvedge_pair **edge_edge,
                                                 size_t *edge_edge_count);

/**
 * selvedge_detector_intersections_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_intersections_f64.
 */
selvedge_status selvedge_detector_intersections_f32(struct selvedge_detector *detector,
                                                    const float *positions,
                                                    size_t vertex_count,
                                                    const struct selvedge_intersection **intersections,
                                                    size_t *count);

/**
 * selvedge_detector_has_intersections_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_has_intersections_f64.
 */
selvedge_status selvedge_detector_has_intersections_f32(struct selvedge_detector *detector,
                                                        const float *positions,
                                                        size_t vertex_count,
                                                        bool *has_any);

/**
 * selvedge_detector_contact_geometries_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_contact_geometries_f64.
 */
selvedge_status selvedge_detector_contact_geometries_f32(struct selvedge_detector *detector,
                                                         const float *start,
                                                         const float *end,
                                                         size_t vertex_count,
                                                         const struct selvedge_contact *contacts,
                                                         size_t contact_count,
                                                         const struct selvedge_geometry **geometries,
                                                         size_t *count);

/**
 * selvedge_detector_near_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_near_f64.
 */
selvedge_status selvedge_detector_near_f32(struct selvedge_detector *detector,
                                           const float *positions,
                                           size_t vertex_count,
                                           double distance,
                                           const struct selvedge_geometry **geometries,
                                           size_t *count);

/**
 * selvedge_detector_truncate_f64 for float.
 *
 * The caller promises:
 * As selvedge_detector_truncate_f64.
 */
selvedge_status selvedge_detector_truncate_f32(struct selvedge_detector *detector,
                                               const float *start,
                                               const float *wanted,
                                               size_t vertex_count,
                                               float *end,
                                               struct selvedge_truncation *truncation);

/**
 * selvedge_world_insert_f64 for float.
 *
 * The caller promises:
 * As selvedge_world_insert_f64.
 */
selvedge_status selvedge_world_insert_f32(struct selvedge_world *world,
                                          size_t vertex_count,
                                          const uint32_t *triangles,
                                          size_t triangle_count,
                                          const float *positions,
                                          const struct selvedge_groups *groups,
                                          selvedge_mesh *mesh);

/**
 * selvedge_world_contacts_f64 for float.
 *
 * The caller promises:
 * As selvedge_world_contacts_f64.
 */
selvedge_status selvedge_world_contacts_f32(struct selvedge_world *world,
                                            const struct Deforming_f32 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            const struct selvedge_world_contact **contacts,
                                            size_t *count);

/**
 * selvedge_world_earliest_f64 for float.
 *
 * The caller promises:
 * As selvedge_world_earliest_f64.
 */
selvedge_status selvedge_world_earliest_f32(struct selvedge_world *world,
                                            const struct Deforming_f32 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            bool *found,
                                            struct selvedge_world_contact *contact);

/**
 * selvedge_world_is_free_f64 for float.
 *
 * The caller promises:
 * As selvedge_world_is_free_f64.
 */
selvedge_status selvedge_world_is_free_f32(struct selvedge_world *world,
                                           const struct Deforming_f32 *deforming,
                                           size_t deforming_count,
                                           const struct selvedge_rigid *rigid,
                                           size_t rigid_count,
                                           bool *is_free);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SELVEDGE_H */
