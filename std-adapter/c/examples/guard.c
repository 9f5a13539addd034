/* Puts certified steps behind another simulator: a recipe in one function, guard_step.
 *
 * The simulator here makes vertices of a sheet fall and jitter, and knows of no board below them. The program runs it without and
 * with the guard, and counts the states in which the sheet passes through itself or the board, by an exact test.
 */
#include <math.h>
#include <selvedge.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 12, SHEET = SIDE * SIDE, BOARD = 4, VERTICES = SHEET + BOARD, STEPS = 100 };
enum { TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) + 2 };

/* A vertex that is held back stops this far from what it meets. Lengths are in metres. */
static const double SEPARATION = 1e-4, TOLERANCE = 1e-9, TIME_STEP = 2e-3;

/* Writes the certified positions of a step from `before` to `after` to `end`, and returns true. Returns false and writes nothing
 * if the step cannot be certified: the caller must keep `before`, which nothing has changed.
 *
 * `before` must be free of intersections: the last certified positions, or a start that selvedge_detector_has_intersections_f64
 * finds free. Vertices from `first_driven` on belong to bodies that must reach their ends.
 */
static bool guard_step(selvedge_detector *detector, const double *before, const double *after, size_t vertex_count,
                       size_t first_driven, double *end, size_t *held_back) {
  selvedge_truncation done = {0};
  double *positions = malloc(3 * vertex_count * sizeof *positions);
  if (!positions) return false;
  /* Numbers that are not finite, and steps with too many pairs, are errors here. */
  selvedge_status status = selvedge_detector_truncate_f64(detector, before, after, vertex_count, positions, &done);
  if (status == SELVEDGE_STATUS_OK && done.in_contact > 0) {
    /* Pairs that start within the separation rest, though they are apart. The exact test lets them leave. */
    status = selvedge_detector_set_touching(detector, TOLERANCE);
    if (status == SELVEDGE_STATUS_OK) {
      status = selvedge_detector_truncate_f64(detector, before, after, vertex_count, positions, &done);
    }
    selvedge_status restored = selvedge_detector_set_within(detector, SEPARATION, TOLERANCE);
    if (status == SELVEDGE_STATUS_OK) status = restored;
  }
  size_t driven = 3 * (vertex_count - first_driven) * sizeof *positions;
  bool is_free = status == SELVEDGE_STATUS_OK && done.in_contact == 0 &&
                 memcmp(positions + 3 * first_driven, after + 3 * first_driven, driven) == 0;
  if (is_free) {
    memcpy(end, positions, 3 * vertex_count * sizeof *positions);
    *held_back = done.held_back;
  } else if (status != SELVEDGE_STATUS_OK) {
    fprintf(stderr, "%s: %s\n", selvedge_status_string(status), selvedge_last_error());
  }
  free(positions);
  return is_free;
}

/* Numbers in [-1, 1) that are the same everywhere. */
static double random_number(uint32_t *state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / 8388608.0 - 1.0;
}

static void build(uint32_t *triangles, double *positions) {
  for (uint32_t i = 0; i < SIDE; i++) {
    for (uint32_t j = 0; j < SIDE; j++) {
      double *vertex = positions + 3 * (i * SIDE + j);
      vertex[0] = 0.04 * i, vertex[1] = 0.04 * j, vertex[2] = 0.02;
      if (i + 1 == SIDE || j + 1 == SIDE) continue;
      uint32_t corner = i * SIDE + j, square[] = {corner, corner + SIDE, corner + 1, corner + 1, corner + SIDE, corner + SIDE + 1};
      memcpy(triangles, square, sizeof square);
      triangles += 6;
    }
  }
  const uint32_t board[] = {SHEET, SHEET + 1, SHEET + 2, SHEET + 1, SHEET + 3, SHEET + 2};
  memcpy(triangles, board, sizeof board);
  const double corners[] = {0.11, 0.11, 0, 0.33, 0.11, 0, 0.11, 0.33, 0, 0.33, 0.33, 0};
  memcpy(positions + 3 * SHEET, corners, sizeof corners);
}

/* Runs the simulator, and prints how many states intersect. Returns false if the library fails or a step is not free. */
static bool run(bool is_guarded) {
  static uint32_t triangles[3 * TRIANGLES];
  static double before[3 * VERTICES], after[3 * VERTICES], velocities[3 * SHEET];
  memset(velocities, 0, sizeof velocities);
  build(triangles, before);
  selvedge_detector *detector = NULL;
  selvedge_status status = selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, triangles, TRIANGLES, &detector);
  if (status == SELVEDGE_STATUS_OK) status = selvedge_detector_set_within(detector, SEPARATION, TOLERANCE);
  /* What starts tangled cannot be guarded. */
  bool is_tangled = true;
  if (status == SELVEDGE_STATUS_OK) status = selvedge_detector_has_intersections_f64(detector, before, VERTICES, &is_tangled);
  uint32_t random = 1;
  size_t intersecting = 0, held = 0;
  bool is_free = !is_tangled;
  for (size_t step = 0; step < STEPS && status == SELVEDGE_STATUS_OK && is_free; step++) {
    memcpy(after, before, sizeof after);
    for (size_t k = 0; k < 3 * SHEET; k++) {
      velocities[k] += 0.2 * random_number(&random) - (k % 3 == 2 ? 9.81 * TIME_STEP : 0);
      after[k] += TIME_STEP * velocities[k];
    }
    if (is_guarded) {
      size_t held_back = 0;
      is_free = guard_step(detector, before, after, VERTICES, SHEET, after, &held_back);
      if (!is_free) break;
      /* What was held back has the velocity that it really had, or it pushes again. */
      for (size_t k = 0; k < 3 * SHEET; k++) velocities[k] = (after[k] - before[k]) / TIME_STEP;
      held += held_back;
    }
    bool has_any = false;
    status = selvedge_detector_has_intersections_f64(detector, after, VERTICES, &has_any);
    intersecting += has_any;
    memcpy(before, after, sizeof before);
  }
  if (status != SELVEDGE_STATUS_OK) fprintf(stderr, "%s: %s\n", selvedge_status_string(status), selvedge_last_error());
  printf("%s the guard: %zu of %d states intersect", is_guarded ? "with" : "without", intersecting, (int)STEPS);
  if (is_guarded) printf(", %zu vertices were held back", held);
  printf("\n");
  if (is_guarded) {
    /* A simulator that has exploded: the guard finds no free step, and the caller keeps the positions before. */
    after[0] = NAN;
    is_free = is_free && !guard_step(detector, before, after, VERTICES, SHEET, after, &held);
    if (is_free) printf("a step to a number that is not finite is not free\n");
  }
  selvedge_detector_free(detector);
  return status == SELVEDGE_STATUS_OK && is_free && (!is_guarded || intersecting == 0);
}

int main(void) { return run(false) && run(true) ? 0 : 1; }
