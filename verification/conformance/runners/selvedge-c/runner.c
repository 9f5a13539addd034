/* Answers the cases of the conformance suite by Selvedge for C. With the argument `exact`, only pairs that truly touch count.
 *
 * Pairs go through a detector, too: a vertex is the triangle (p, p, p), an edge (a, b, b).
 */
#define _POSIX_C_SOURCE 200809L
#include <selvedge.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LARGEST = 4096 };

static double numbers[2][LARGEST];
static float narrow[2][LARGEST];

/* The next word of the line, or an empty text. */
static const char *word(void) {
  const char *next = strtok(NULL, " \n");
  return next ? next : "";
}

static size_t read_points(double *to, size_t count) {
  for (size_t i = 0; i < 3 * count; i++) to[i] = strtod(word(), NULL);
  return count;
}

static bool ask(selvedge_detector *detector, bool single, bool intersects, bool moves, size_t count, bool *found, double *time) {
  selvedge_contact contact = {0};
  selvedge_status status = SELVEDGE_STATUS_OK;
  *found = false;
  *time = 0;
  if (intersects)
    status = single ? selvedge_detector_has_intersections_f32(detector, narrow[0], count, found)
                    : selvedge_detector_has_intersections_f64(detector, numbers[0], count, found);
  if (status != SELVEDGE_STATUS_OK || *found || !moves) return status == SELVEDGE_STATUS_OK;
  status = single ? selvedge_detector_earliest_f32(detector, narrow[0], narrow[1], count, found, &contact)
                  : selvedge_detector_earliest_f64(detector, numbers[0], numbers[1], count, found, &contact);
  *time = contact.time;
  return status == SELVEDGE_STATUS_OK;
}

static void answer(char *line, bool exact) {
  static uint32_t triangles[LARGEST];
  const char *name = strtok(line, " \n"), *question = word();
  bool single = strcmp(word(), "f32") == 0, intersects = true, moves = true;
  size_t count = 6, faces = 2;
  if (strcmp(question, "vertex-face") == 0 || strcmp(question, "edge-edge") == 0) {
    static const uint32_t of_face[] = {0, 0, 0, 1, 2, 3}, of_edges[] = {0, 1, 1, 2, 3, 3};
    memcpy(triangles, question[0] == 'v' ? of_face : of_edges, sizeof of_face);
    intersects = false;
    read_points(numbers[0], count = 4);
    read_points(numbers[1], count);
  } else if (strcmp(question, "moving-triangle") == 0 || strcmp(question, "triangles") == 0) {
    for (uint32_t i = 0; i < 6; i++) triangles[i] = i;
    read_points(numbers[0], count);
    moves = question[0] == 'm';
    memcpy(numbers[1], numbers[0], sizeof numbers[0]);
    double move[3] = {0};
    if (moves) read_points(move, 1);
    for (size_t i = 9; i < 18; i++) numbers[1][i] += move[i % 3];
  } else {
    count = strtoul(word(), NULL, 10);
    faces = strtoul(word(), NULL, 10);
    word();
    moves = strcmp(question, "moving-mesh") == 0;
    intersects = !moves;
    read_points(numbers[0], count);
    if (moves) read_points(numbers[1], count);
    for (size_t i = 0; i < 3 * faces; i++) triangles[i] = (uint32_t)strtoul(word(), NULL, 10);
  }
  for (size_t i = 0; i < 3 * count; i++)
    for (int end = 0; end < 2; end++) narrow[end][i] = (float)numbers[end][i];

  selvedge_detector *detector = NULL;
  uint32_t scalar = single ? SELVEDGE_SCALAR_F32 : SELVEDGE_SCALAR_F64;
  bool fine = selvedge_detector_new(scalar, count, triangles, faces, &detector) == SELVEDGE_STATUS_OK, found = false;
  double tolerance = single ? SELVEDGE_DEFAULT_TOLERANCE_F32 : SELVEDGE_DEFAULT_TOLERANCE_F64, first = 0;
  if (fine && exact) fine = selvedge_detector_set_touching(detector, tolerance) == SELVEDGE_STATUS_OK;
  long best = -1;
  for (int i = 0; i < 3 && fine; i++) {
    struct timespec begin, end;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    fine = ask(detector, single, intersects, moves, count, &found, &first);
    clock_gettime(CLOCK_MONOTONIC, &end);
    long took = (end.tv_sec - begin.tv_sec) * 1000000000L + end.tv_nsec - begin.tv_nsec;
    if (best < 0 || took < best) best = took;
  }
  selvedge_detector_free(detector);
  if (!fine)
    printf("%s refused - 0 %s\n", name, selvedge_last_error());
  else if (found && moves)
    printf("%s touches %a %ld\n", name, first, best);
  else
    printf("%s %s - %ld\n", name, found ? "touches" : "none", best);
}

int main(int argc, char **argv) {
  static char line[1 << 17];
  bool exact = argc > 1 && strcmp(argv[1], "exact") == 0;
  printf("ready %s\n", selvedge_version_string());
  fflush(stdout);
  while (fgets(line, sizeof line, stdin)) {
    answer(line, exact);
    fflush(stdout);
  }
  return 0;
}
