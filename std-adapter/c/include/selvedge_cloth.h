
/* Selvedge's cloth: a simulation of which no state ever has an intersection.
 *
 * Made by cbindgen from std-adapter/c/src; do not edit. README.md beside it has an example; what a scene may say stands in
 * std-adapter/cloth/scenes/README.md.
 *
 * For a library that was built with the feature "cloth", as `make install CLOTH=yes` does. Statuses, words and threads are as
 * in selvedge.h. All is in SI units. Names and paths are UTF-8 with a zero at the end.
 */

#ifndef SELVEDGE_CLOTH_H
#define SELVEDGE_CLOTH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "selvedge.h"

/**
 * A checkpoint can be taken before the first step, after so many steps, and again after so many more.
 */
#define SELVEDGE_CHECKPOINT_STEPS 200

/**
 * A scene in motion. Only pointers to it exist; they are numbers, and nothing is behind them.
 *
 * One thread at a time, as for a detector.
 */
typedef struct selvedge_simulation selvedge_simulation;

/**
 * How much of what there is in a scene, which no step changes. Vertices and triangles are those of each cloth, then those of
 * bodies, in the order of the scene.
 */
typedef struct selvedge_sizes {
  /**
   * Of cloth and bodies.
   */
  size_t vertex_count;
  /**
   * Of cloth and bodies.
   */
  size_t triangle_count;
  /**
   * How many of the vertices are of cloth.
   */
  size_t cloth_vertex_count;
  /**
   * How many of the triangles are of cloth.
   */
  size_t cloth_triangle_count;
  /**
   * How many edges belong to no triangle: of ropes, laces and fringes.
   */
  size_t loose_edge_count;
  /**
   * How many cloths there are, numbered from 0 on.
   */
  size_t cloth_count;
  /**
   * How many bodies there are, numbered from 0 on.
   */
  size_t body_count;
  /**
   * Of a step, in seconds.
   */
  double time_step;
  /**
   * As many as the scene's duration has.
   */
  uint64_t steps;
  /**
   * From one frame to the next.
   */
  uint64_t steps_per_frame;
} selvedge_sizes;

/**
 * How far a simulation is, and what is promised of its state.
 */
typedef struct selvedge_progress {
  /**
   * So far.
   */
  uint64_t steps_done;
  /**
   * Simulated so far, in seconds.
   */
  double time;
  /**
   * How far bodies and pins are behind their keyframes, in seconds.
   */
  double lag;
  /**
   * Steps in which bodies or pins had to wait, or to be let pass.
   */
  uint64_t blocked_steps;
  /**
   * Pairs that have left the promise since the start, in a scene that tolerates what is tangled there.
   */
  size_t tolerated_pairs;
  /**
   * Whether the state is certified to be free of intersections of whatever the scene's contact effects name: not without any,
   * not while a body is let pass, and not while what was tangled at the start is tolerated.
   */
  bool is_certified;
} selvedge_progress;

/**
 * A cloth or a body, among others and among the vertices.
 */
typedef struct selvedge_part {
  /**
   * Among the cloths, or the bodies, from 0 on.
   */
  size_t number;
  /**
   * The first of its vertices.
   */
  size_t first_vertex;
  /**
   * They come one after another.
   */
  size_t vertex_count;
} selvedge_part;

/**
 * A vertex and a face, or two edges, that came near each other in the last step.
 */
typedef struct selvedge_near_pair {
  /**
   * Vertex and face, or first edge and second edge; bodies' vertices come after the cloth's.
   */
  uint32_t vertices[4];
  /**
   * Of each vertex in the way between the closest points: positive on the first side, where they add up to one, negative on the other.
   */
  double weights[4];
  /**
   * From the second side to the first, of length one.
   */
  double normal[3];
  /**
   * How far apart the pair is to be, in metres.
   */
  double thickness;
} selvedge_near_pair;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * A simulation of the scene that `scene` is the text of, TOML as std-adapter/cloth/scenes/README.md explains, on `threads` threads
 * (0: one for each core): their number changes no bit of the result. Paths in the text are relative to `folder`; NULL is the
 * process's own.
 *
 * Texts are UTF-8, with a zero at the end, and copied. Words about the scene call it scene.toml. `*simulation` becomes the handle;
 * selvedge_simulation_free gives back what it takes.
 *
 * The caller promises:
 * `scene`, and `folder` unless it is NULL, point to texts that a zero ends, `simulation` to a pointer.
 */
selvedge_status selvedge_simulation_new(const char *scene,
                                        const char *folder,
                                        size_t threads,
                                        struct selvedge_simulation **simulation);

/**
 * selvedge_simulation_new of a scene file. Paths in it are relative to its folder.
 *
 * The caller promises:
 * `path` points to a text that a zero ends, `simulation` to a pointer.
 */
selvedge_status selvedge_simulation_read(const char *path, size_t threads, struct selvedge_simulation **simulation);

/**
 * Does one step. SELVEDGE_STATUS_BLOCKED: no motion was found that leaves the cloth free of intersections, in a scene that stops
 * then; what is done of the step stays, and the words say what was in the way. The state is as free as it was before.
 */
selvedge_status selvedge_simulation_step(struct selvedge_simulation *simulation);

/**
 * Frees a simulation and all that it has shown. NULL is well. One that another thread is using goes when that call has ended.
 */
selvedge_status selvedge_simulation_free(struct selvedge_simulation *simulation);

/**
 * How much of what there is.
 *
 * The caller promises:
 * `sizes` points to one entry.
 */
selvedge_status selvedge_simulation_sizes(const struct selvedge_simulation *simulation, struct selvedge_sizes *sizes);

/**
 * How far it is, and whether its state is certified.
 *
 * The caller promises:
 * `progress` points to one entry.
 */
selvedge_status selvedge_simulation_progress(const struct selvedge_simulation *simulation,
                                             struct selvedge_progress *progress);

/**
 * The body of this name.
 *
 * The caller promises:
 * `name` points to a text that a zero ends, `part` to one entry.
 */
selvedge_status selvedge_simulation_body(const struct selvedge_simulation *simulation,
                                         const char *name,
                                         struct selvedge_part *part);

/**
 * The cloth of this name.
 *
 * The caller promises:
 * As selvedge_simulation_body.
 */
selvedge_status selvedge_simulation_cloth(const struct selvedge_simulation *simulation,
                                          const char *name,
                                          struct selvedge_part *part);

/**
 * Copies where all vertices are, in metres. `vertex_count` is that of selvedge_simulation_sizes.
 *
 * The caller promises:
 * `positions` has room for 3 * `vertex_count` numbers.
 */
selvedge_status selvedge_simulation_positions(const struct selvedge_simulation *simulation,
                                              double *positions,
                                              size_t vertex_count);

/**
 * Copies how fast all vertices move, in m/s.
 *
 * The caller promises:
 * `velocities` has room for 3 * `vertex_count` numbers.
 */
selvedge_status selvedge_simulation_velocities(const struct selvedge_simulation *simulation,
                                               double *velocities,
                                               size_t vertex_count);

/**
 * Copies which way the surface faces at each vertex: the mean direction of its triangles, weighted by area, of length one; zero
 * where it has none.
 *
 * The caller promises:
 * `normals` has room for 3 * `vertex_count` numbers.
 */
selvedge_status selvedge_simulation_normals(const struct selvedge_simulation *simulation,
                                            double *normals,
                                            size_t vertex_count);

/**
 * Copies all triangles, three vertex numbers each. A step changes them only where cloth tears: then there are more vertices as well, and
 * selvedge_simulation_sizes has new counts. `triangle_count` is that of selvedge_simulation_sizes.
 *
 * The caller promises:
 * `triangles` has room for 3 * `triangle_count` numbers.
 */
selvedge_status selvedge_simulation_triangles(const struct selvedge_simulation *simulation,
                                              uint32_t *triangles,
                                              size_t triangle_count);

/**
 * Copies all loose edges, of ropes, laces and fringes: two vertex numbers each. A step changes them only where cloth tears.
 * `loose_edge_count` is that of selvedge_simulation_sizes.
 *
 * The caller promises:
 * `loose_edges` has room for 2 * `loose_edge_count` numbers.
 */
selvedge_status selvedge_simulation_loose_edges(const struct selvedge_simulation *simulation,
                                                uint32_t *loose_edges,
                                                size_t loose_edge_count);

/**
 * The pairs that came near each other in the last part of the last step, as contact saw them at its start. None without a contact
 * effect.
 *
 * `*pairs` is the simulation's, until its near pairs are asked for again, or it is freed.
 *
 * The caller promises:
 * `pairs` points to a pointer, `count` to a number.
 */
selvedge_status selvedge_simulation_near_pairs(struct selvedge_simulation *simulation,
                                               const struct selvedge_near_pair **pairs,
                                               size_t *count);

/**
 * Leads the body `body`, which the scene says is driven, to another placement in the next step: its mesh as the scene has it, turned
 * and then moved. It turns about its origin, the shorter way round, and moves along, both evenly. Unless it is told again it stays
 * there; a step that is cut or has to wait leaves it on the way, where selvedge_simulation_placement says.
 *
 * The caller promises:
 * `placement` points to one entry.
 */
selvedge_status selvedge_simulation_place_body(struct selvedge_simulation *simulation,
                                               size_t body,
                                               const selvedge_pose *placement);

/**
 * Where a driven body stands now. `*is_known` tells whether it does: not of any other, nor of one that was moved vertex by vertex,
 * and `*placement` is then left as it is.
 *
 * The caller promises:
 * `is_known` and `placement` point to one entry each.
 */
selvedge_status selvedge_simulation_placement(const struct selvedge_simulation *simulation,
                                              size_t body,
                                              bool *is_known,
                                              selvedge_pose *placement);

/**
 * Leads each vertex of a driven body straight to a position, in metres, in the next step: a body that changes its shape, such as a
 * skinned figure. Pins that follow it know no way to go then, and stay: move them on their own.
 *
 * The caller promises:
 * `positions` points to 3 * `vertex_count` numbers.
 */
selvedge_status selvedge_simulation_move_body(struct selvedge_simulation *simulation,
                                              size_t body,
                                              const double *positions,
                                              size_t vertex_count);

/**
 * The same for a group of pins that is driven, by its number in the scene, from 0 on.
 *
 * The caller promises:
 * As selvedge_simulation_move_body.
 */
selvedge_status selvedge_simulation_move_pins(struct selvedge_simulation *simulation,
                                              size_t group,
                                              const double *positions,
                                              size_t vertex_count);

/**
 * Lets the wind that the scene has blow so from now on, in m/s.
 */
selvedge_status selvedge_simulation_set_wind(struct selvedge_simulation *simulation, double x, double y, double z);

/**
 * All that the rest of the simulation depends on, as bytes to keep. What the next step was told, and the wind, is not in it.
 * SELVEDGE_STATUS_NO_CHECKPOINT unless SELVEDGE_CHECKPOINT_STEPS divides the steps done.
 *
 * `*bytes` is the simulation's, until its next checkpoint is taken, or it is freed.
 *
 * The caller promises:
 * `bytes` points to a pointer, `count` to a number.
 */
selvedge_status selvedge_simulation_checkpoint(struct selvedge_simulation *simulation,
                                               const uint8_t **bytes,
                                               size_t *count);

/**
 * Goes on from a checkpoint of the same scene, with the same bits as if that simulation had never ended. The bytes are copied, and
 * may be this simulation's own.
 *
 * The caller promises:
 * `bytes` points to `count` bytes.
 */
selvedge_status selvedge_simulation_resume(struct selvedge_simulation *simulation,
                                           const uint8_t *bytes,
                                           size_t count);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SELVEDGE_CLOTH_H */
