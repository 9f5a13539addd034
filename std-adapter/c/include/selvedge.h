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
 * Of the header: it changes with what was there before.
 */
#define SELVEDGE_VERSION_MAJOR 0

/**
 * Of the header: below 1.0 it changes with what was there before.
 */
#define SELVEDGE_VERSION_MINOR 1

/**
 * Of the header.
 */
#define SELVEDGE_VERSION_PATCH 0

/**
 * Of the header, as one number. That of the library is selvedge_version().
 */
#define SELVEDGE_VERSION (((1000000 * SELVEDGE_VERSION_MAJOR) + (1000 * SELVEDGE_VERSION_MINOR)) + SELVEDGE_VERSION_PATCH)

/**
 * At first the tolerance of detectors for float: 2^-20, a micrometre where positions are in metres.
 */
#define SELVEDGE_DEFAULT_TOLERANCE_F32 9.5367431640625e-7

/**
 * At first the tolerance of detectors for double: 2^-30, a nanometre where positions are in metres.
 */
#define SELVEDGE_DEFAULT_TOLERANCE_F64 9.313225746154785e-10

/**
 * What became of a call.
 */
enum selvedge_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * All is well.
   */
  SELVEDGE_STATUS_OK = 0,
  /**
   * A pointer is NULL that must not be.
   */
  SELVEDGE_STATUS_NULL_POINTER = 1,
  /**
   * A pointer is not aligned as its type has to be.
   */
  SELVEDGE_STATUS_MISALIGNED_POINTER = 2,
  /**
   * A count is larger than memory, or than what may be asked for.
   */
  SELVEDGE_STATUS_BAD_COUNT = 3,
  /**
   * A number is none of its enumeration's.
   */
  SELVEDGE_STATUS_UNKNOWN_CONSTANT = 4,
  /**
   * There is no such detector: it was freed, or never made.
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
   * A list does not have an entry for each vertex.
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
   * The operating system refuses threads, or there are more of them than any machine has use for.
   */
  SELVEDGE_STATUS_NO_THREADS = 15,
  /**
   * The operating system refuses memory.
   */
  SELVEDGE_STATUS_NO_MEMORY = 16,
  /**
   * The process was forked after the detector, world or simulation has started threads; they are not in the child.
   */
  SELVEDGE_STATUS_FORKED = 17,
  /**
   * The detector or world is cancelled.
   */
  SELVEDGE_STATUS_CANCELLED = 18,
  /**
   * More pairs are near each other than may be looked at.
   */
  SELVEDGE_STATUS_TOO_MANY_PAIRS = 19,
  /**
   * A contact's time is not in [0, 1].
   */
  SELVEDGE_STATUS_BAD_TIME = 20,
  /**
   * A fault of the library's own. The detector, world or simulation can only be freed from now on.
   */
  SELVEDGE_STATUS_INTERNAL = 21,
  /**
   * There is no such world: it was freed, or never made.
   */
  SELVEDGE_STATUS_NO_SUCH_WORLD = 22,
  /**
   * The world has no such mesh: it was removed, or is of another world.
   */
  SELVEDGE_STATUS_NO_SUCH_MESH = 23,
  /**
   * Two motions are given for one mesh.
   */
  SELVEDGE_STATUS_MOVED_TWICE = 24,
  /**
   * A pose is none: a number is not finite, the quaternion is zero, or the mesh would be out of the range of numbers.
   */
  SELVEDGE_STATUS_BAD_POSE = 25,
  /**
   * There is no such simulation: it was freed, or never made.
   */
  SELVEDGE_STATUS_NO_SUCH_SIMULATION = 26,
  /**
   * A scene cannot be read or used: the words name its file, line and column where one is at fault.
   */
  SELVEDGE_STATUS_BAD_SCENE = 27,
  /**
   * A step found no motion without an intersection, in a scene that stops then. What is done of the step stays.
   */
  SELVEDGE_STATUS_BLOCKED = 28,
  /**
   * The scene has no such cloth, body, group of pins, or wind.
   */
  SELVEDGE_STATUS_NO_SUCH_PART = 29,
  /**
   * A body or a group of pins has a motion of its own: its scene does not say that it is driven.
   */
  SELVEDGE_STATUS_NOT_DRIVEN = 30,
  /**
   * A position or a velocity is not finite, or beyond its range.
   */
  SELVEDGE_STATUS_BAD_VALUE = 31,
  /**
   * Bytes are no checkpoint, are damaged, or are one of another scene.
   */
  SELVEDGE_STATUS_BAD_CHECKPOINT = 32,
  /**
   * There is no checkpoint after this step: one is every SELVEDGE_CHECKPOINT_STEPS steps.
   */
  SELVEDGE_STATUS_NO_CHECKPOINT = 33,
  /**
   * A text is not UTF-8, or has a zero before its end.
   */
  SELVEDGE_STATUS_BAD_TEXT = 34,
  /**
   * A scene starts with surfaces that pass through each other: the words say where first, and what the scene may say of it.
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
 * Which primitives a pair is made of.
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
 * Which boxes tell candidates.
 */
enum selvedge_boxes
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * Those at the start and at the end of the step, that are not in one order along an axis at both. Fewer pairs, in less time.
   */
  SELVEDGE_BOXES_MOVING = 0,
  /**
   * Those that primitives sweep, that overlap: what other systems call candidates.
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
 * Which primitives intersect.
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
 * A mesh, and what is kept of it from step to step. Only pointers to it exist; they are numbers, and nothing is behind them.
 *
 * One thread at a time: a call on a detector that another thread is using fails with SELVEDGE_STATUS_BUSY and changes nothing.
 * Detectors do not know of each other: each may be used by a thread of its own.
 */
typedef struct selvedge_detector selvedge_detector;

/**
 * Meshes that come and go, and move as they like. Only pointers to it exist; they are numbers, and nothing is behind them.
 *
 * One thread at a time, as for a detector.
 */
typedef struct selvedge_world selvedge_world;

/**
 * What a vertex belongs to, and what it collides with, a bit for each group: two vertices collide if each is in a group that the
 * other's filter has.
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
 * A vertex and a face, two edges, or two vertices, as those of an edge, by their numbers.
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
 * A pair for which contact during the step is not excluded.
 */
typedef struct selvedge_contact {
  /**
   * When, in [0, 1] of the step: not after the exact time. Of a detector for float it is a float, widened without rounding.
   */
  double time;
  /**
   * A selvedge_kind.
   */
  uint32_t kind;
  /**
   * The vertex and the face, or the two edges. Faces are numbered as the triangles, edges as by selvedge_detector_edges.
   */
  struct selvedge_pair pair;
  /**
   * The vertex and the face's three, or the ends of the first edge and of the second.
   */
  uint32_t vertices[4];
} selvedge_contact;

/**
 * Two primitives of a mesh at rest that have a point in common, and no vertex.
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
 * Two primitives and how they lie to each other at some time: at that of a contact, or at rest. Lengths are in the unit of the
 * positions; all is computed in double, for float too.
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
   * Whether there is a normal. There is none where the two cannot be shown to have been apart: where they touch when the step
   * begins, or have done so before; at rest, where they touch.
   */
  bool has_normal;
  /**
   * Of the four vertices, in [0, 1]: barycentric. Those of each side add up to one.
   */
  double weights[4];
  /**
   * The points of the first and of the second side that have these weights: the closest.
   */
  double points[2][3];
  /**
   * From the second side to the first, of length one; zeros if there is none.
   */
  double normal[3];
  /**
   * When the sides were certainly apart along the normal: at the time of contact, or a little before. 0 without a normal.
   */
  double separated_at;
  /**
   * The distance of the two sides at that time is certainly not less than the first, not more than the second.
   */
  double distance[2];
  /**
   * How fast the first point moves away from the second along the normal, in lengths a step: less than zero if they come
   * nearer, zero without a normal.
   */
  double speed;
} selvedge_geometry;

/**
 * What came of a step of which each vertex goes as far as it may.
 */
typedef struct selvedge_truncation {
  /**
   * Vertices that go less than the whole of their way.
   */
  size_t held_back;
  /**
   * Pairs that are in contact at the start already. Their vertices rest. Where there are none, the step is certainly free of
   * contact.
   */
  size_t in_contact;
  /**
   * How often contacts were looked for.
   */
  size_t rounds;
} selvedge_truncation;

/**
 * A mesh of a world, as a number that is never 0. It stays its name for good: no other mesh of the world gets the same one.
 */
typedef uint64_t selvedge_mesh;

/**
 * A mesh of a world whose vertices move, each straight and at constant velocity: cloth, soft bodies. Such a mesh can also meet
 * itself.
 */
typedef struct selvedge_deforming_f64 {
  /**
   * Which mesh.
   */
  selvedge_mesh mesh;
  /**
   * 3 * `vertex_count` numbers: the positions at the start.
   */
  const double *start;
  /**
   * And at the end.
   */
  const double *end;
  /**
   * As many as the mesh has.
   */
  size_t vertex_count;
} selvedge_deforming_f64;

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
 * selvedge_deforming_f64 for float.
 */
typedef struct selvedge_deforming_f32 {
  /**
   * Which mesh.
   */
  selvedge_mesh mesh;
  /**
   * 3 * `vertex_count` numbers: the positions at the start.
   */
  const float *start;
  /**
   * And at the end.
   */
  const float *end;
  /**
   * As many as the mesh has.
   */
  size_t vertex_count;
} selvedge_deforming_f32;

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

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The library's version in words, as "0.1.0". Never NULL; valid for ever.
 */
const char *selvedge_version_string(void);

/**
 * The library's version as a number: 1,000,000 * major + 1,000 * minor + patch. That of the header is SELVEDGE_VERSION.
 */
uint32_t selvedge_version(void);

/**
 * What the last call that failed on this thread has to say, in words; empty if none has. Never NULL.
 *
 * Valid until the next call that fails on this thread, or the thread's end. A call that succeeds leaves it.
 */
const char *selvedge_last_error(void);

/**
 * A selvedge_status in a few words, for any number. Never NULL; valid for ever.
 */
const char *selvedge_status_string(int32_t status);

/**
 * A detector for a mesh. `scalar` is a selvedge_scalar: the format that its positions will have. On the calling thread at first,
 * all vertices moving, steps not coherent, contacts within the default tolerance.
 *
 * Edges and points that belong to no triangle, of ropes, hair and particles, are triangles that name a vertex twice, (a, b, b), or
 * three times, (p, p, p): they collide as what they are. A vertex that nothing names touches nothing.
 *
 * The triangles are copied. `*detector` becomes the handle; selvedge_detector_free gives back what it takes.
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
 * Cuts the question short that another thread is asking, and each one from now on: it fails with SELVEDGE_STATUS_CANCELLED,
 * unless it is as good as answered. `cancelled` is not 0; 0 takes it back. Afterwards the detector answers as if nothing had
 * been.
 *
 * For any thread at any time: the only function that a detector in use does not refuse, but for selvedge_detector_free.
 */
selvedge_status selvedge_detector_set_cancelled(struct selvedge_detector *detector,
                                                int32_t cancelled);

/**
 * Frees a detector and tells its threads to end; all that it has shown is gone with it. NULL is well. One that another thread is
 * using goes when that call has ended.
 */
selvedge_status selvedge_detector_free(struct selvedge_detector *detector);

/**
 * How many threads steps are split between: 1, as at first, is the one that calls; more are the detector's own; 0 is one for
 * each core. Answers are the same bit for bit. More than four for each core, and more than 256, are refused.
 */
selvedge_status selvedge_detector_set_threads(struct selvedge_detector *detector,
                                              size_t count);

/**
 * Contacts are pairs that cannot be proven to stay farther apart than `separation`; those that only come within `tolerance` of it
 * may be among them. At first the separation is 0, the tolerance SELVEDGE_DEFAULT_TOLERANCE_F32 or _F64.
 *
 * Both in the unit of the positions. For a detector for float they are rounded up to a float.
 */
selvedge_status selvedge_detector_set_within(struct selvedge_detector *detector,
                                             double separation,
                                             double tolerance);

/**
 * Contacts are only pairs that truly touch, decided exactly. A time may be as much too early as the pair needs to come closer by
 * `tolerance`.
 *
 * In the unit of the positions. For a detector for float it is rounded up to a float.
 */
selvedge_status selvedge_detector_set_touching(struct selvedge_detector *detector,
                                               double tolerance);

/**
 * Names the vertices that move: for each of them a byte that is not 0. NULL and 0: all of them, as at first.
 *
 * From the next step on pairs of which no vertex moves are not looked at. Positions of vertices that do not move are taken from
 * the next step, and not looked at again until this is called anew. The bytes are copied.
 *
 * The caller promises:
 * `moving` points to `count` bytes.
 */
selvedge_status selvedge_detector_set_moving(struct selvedge_detector *detector,
                                             const uint8_t *moving,
                                             size_t count);

/**
 * Which pairs are looked at from the next step on, in place of what was said before. Vertices do not collide whose groups do
 * not, that are of one patch, or that are an excluded pair, in either order; a pair is not looked at if no vertex of one side
 * collides with any of the other. NULL: no such rule. All three NULL: all pairs are looked at, as at first.
 *
 * `groups` and `patches` have an entry for each vertex, `vertex_count` of them; it is not looked at if both are NULL. Pairs of
 * selvedge_detector_contacts_of_f64 are looked at whatever this says. All is copied.
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
 * Whether steps go on from one another, as those of a simulation do: 0, as at first, or not 0. Then a step takes less time where
 * vertices move by much less than an edge. The contacts are the same, in ascending order of their pairs' numbers.
 */
selvedge_status selvedge_detector_set_coherent(struct selvedge_detector *detector,
                                               int32_t coherent);

/**
 * Most pairs that a question may look at, of those that boxes leave; UINT64_MAX, as at first: as many as there are. One with
 * more fails with SELVEDGE_STATUS_TOO_MANY_PAIRS, on any number of threads.
 */
selvedge_status selvedge_detector_set_pair_limit(struct selvedge_detector *detector,
                                                 uint64_t limit);

/**
 * How many threads a step uses.
 *
 * The caller promises:
 * `count` points to a number.
 */
selvedge_status selvedge_detector_threads(const struct selvedge_detector *detector, size_t *count);

/**
 * The edges of the mesh by their numbers, each as its vertices, the smaller first; `count` becomes how many there are.
 *
 * They stay where they are until the detector is freed.
 *
 * The caller promises:
 * `edges` points to a pointer, `count` to a number.
 */
selvedge_status selvedge_detector_edges(const struct selvedge_detector *detector,
                                        const struct selvedge_pair **edges,
                                        size_t *count);

/**
 * All contacts of the step from `start` to `end`. They stay where they are until this detector's contacts are asked for again,
 * in either way, or it is freed. If there are none they are at NULL.
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
 * The contacts among pairs that the caller has, in their order: so many of a vertex and a face, and so many of two edges. They
 * stay as those of selvedge_detector_contacts_f64. The pairs may be this detector's own candidates.
 *
 * The caller promises:
 * As selvedge_detector_contacts_f64; `vertex_face` and `edge_edge` point to so many pairs.
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
 * The earliest contact of the step: of several at the same time the one with the smallest numbers. `*found` becomes whether
 * there is one. Then `*contact` becomes it, and the step is free of contact before its time; otherwise the whole step is, and
 * `*contact` stays.
 *
 * The caller promises:
 * `start` and `end` point to 3 * `vertex_count` numbers, `found` and `contact` to one of their type.
 */
selvedge_status selvedge_detector_earliest_f64(struct selvedge_detector *detector,
                                               const double *start,
                                               const double *end,
                                               size_t vertex_count,
                                               bool *found,
                                               struct selvedge_contact *contact);

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
 * Whether the step is certainly free of contact. Ends at the first contact.
 *
 * The caller promises:
 * `start` and `end` point to 3 * `vertex_count` numbers, `is_free` to one of its type.
 */
selvedge_status selvedge_detector_is_free_f64(struct selvedge_detector *detector,
                                              const double *start,
                                              const double *end,
                                              size_t vertex_count,
                                              bool *is_free);

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
 * The pairs that boxes leave; all others are certainly farther apart than the separation throughout the step. `boxes`
 * is a selvedge_boxes. They stay where they are until this detector's candidates are asked for again, or it is freed.
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
 * All edges and faces that meet where the mesh is at `positions`, at rest, touching included, exactly; and vertices and faces,
 * and edges, that touch where neighbours are folded flat onto each other. None exactly if no two triangles have a point in
 * common besides the vertices and the edge that they share. They stay where they are until this detector's intersections are
 * asked for again, or it is freed.
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
 * Whether there is any intersection. Ends at the first.
 *
 * The caller promises:
 * `positions` points to 3 * `vertex_count` numbers, `has_any` to one of its type.
 */
selvedge_status selvedge_detector_has_intersections_f64(struct selvedge_detector *detector,
                                                        const double *positions,
                                                        size_t vertex_count,
                                                        bool *has_any);

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
 * How the two of each contact lie to each other at its time: the closest points, their weights, a normal along which they were
 * certainly apart, the range that their distance is in. `contacts` may be this detector's own list, or any rows of the caller's,
 * of which kind, pair and time are looked at; the geometries are in their order. For a detector for float a time is rounded down
 * to a float. They stay where they are until this detector's contact geometries are asked for again, or it is freed.
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
 * All pairs that are within `distance` of each other where the mesh is at `positions`, at rest, with their closest points: none
 * missed; a pair a little farther away may be among them, each tells the range that its distance is in. Ascending by kind and
 * pair. Not asked are pairs that share a vertex, pairs of which no vertex moves (selvedge_detector_set_moving) and those that
 * selvedge_detector_set_collision_filter excludes.
 *
 * `distance` is in the unit of the positions; for a detector for float it is rounded up to a float. The list stays where it is
 * until this detector is asked for what is near again, or it is freed.
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
 * Lets each vertex go from `start` to where it is `wanted` as far as its neighbourhood lets it: `end` becomes positions on these
 * ways such that the step from `start` to `end` is free of contact, but for pairs that are in contact at the start, whose
 * vertices rest. `*truncation` becomes what was done.
 *
 * `end` may be `wanted` or `start` itself: it is written to when all else is done, and not by a call that fails.
 *
 * The caller promises:
 * `start` and `wanted` point to 3 * `vertex_count` numbers, `end` to room for as many, `truncation` to one of its type.
 */
selvedge_status selvedge_detector_truncate_f64(struct selvedge_detector *detector,
                                               const double *start,
                                               const double *wanted,
                                               size_t vertex_count,
                                               double *end,
                                               struct selvedge_truncation *truncation);

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
 * A new mesh that rests at these positions. `groups` say which meshes it is looked at with, itself among them; NULL: with all.
 * `*mesh` becomes its number.
 *
 * Triangles and positions are copied. Edges and points of ropes, hair and particles are triangles that name a vertex twice or three times,
 * as of a detector.
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
 * All contacts of a step in which these meshes move, each listed once, and all others rest: those that have moved rest where their last
 * motion ended. The contacts stay where they are until this world's contacts are asked for again, or it is freed. If there are none
 * they are at NULL.
 *
 * If the question is refused nothing has changed; for one that is cut short see selvedge_world_set_cancelled.
 *
 * The caller promises:
 * `deforming` and `rigid` point to so many entries, each frame to 3 * `vertex_count` numbers, `contacts` to a pointer, `count` to a
 * number.
 */
selvedge_status selvedge_world_contacts_f64(struct selvedge_world *world,
                                            const struct selvedge_deforming_f64 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            const struct selvedge_world_contact **contacts,
                                            size_t *count);

/**
 * selvedge_world_contacts_f64 for float.
 *
 * The caller promises:
 * As selvedge_world_contacts_f64.
 */
selvedge_status selvedge_world_contacts_f32(struct selvedge_world *world,
                                            const struct selvedge_deforming_f32 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            const struct selvedge_world_contact **contacts,
                                            size_t *count);

/**
 * The earliest contact of such a step, before which it is free of contact. `*found` becomes whether there is one; if there is none the
 * whole step is free, and nothing is written to `contact`.
 *
 * The caller promises:
 * As selvedge_world_contacts_f64; `found` and `contact` point to one each.
 */
selvedge_status selvedge_world_earliest_f64(struct selvedge_world *world,
                                            const struct selvedge_deforming_f64 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            bool *found,
                                            struct selvedge_world_contact *contact);

/**
 * selvedge_world_earliest_f64 for float.
 *
 * The caller promises:
 * As selvedge_world_earliest_f64.
 */
selvedge_status selvedge_world_earliest_f32(struct selvedge_world *world,
                                            const struct selvedge_deforming_f32 *deforming,
                                            size_t deforming_count,
                                            const struct selvedge_rigid *rigid,
                                            size_t rigid_count,
                                            bool *found,
                                            struct selvedge_world_contact *contact);

/**
 * Whether such a step is certainly free of contact.
 *
 * The caller promises:
 * As selvedge_world_contacts_f64; `is_free` points to one.
 */
selvedge_status selvedge_world_is_free_f64(struct selvedge_world *world,
                                           const struct selvedge_deforming_f64 *deforming,
                                           size_t deforming_count,
                                           const struct selvedge_rigid *rigid,
                                           size_t rigid_count,
                                           bool *is_free);

/**
 * selvedge_world_is_free_f64 for float.
 *
 * The caller promises:
 * As selvedge_world_is_free_f64.
 */
selvedge_status selvedge_world_is_free_f32(struct selvedge_world *world,
                                           const struct selvedge_deforming_f32 *deforming,
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

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SELVEDGE_H */
