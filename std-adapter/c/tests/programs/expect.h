/* Counts calls whose status is another than expected, and the mesh of the programs that make wrong calls. */
#ifndef EXPECT_H
#define EXPECT_H

#include <selvedge.h>
#include <stdio.h>
#include <string.h>

static int faults = 0;

static void fault(int line, const char *what, selvedge_status expected, selvedge_status found) {
  fprintf(stderr, "line %d: %s: expected \"%s\", not \"%s\"\n", line, what, selvedge_status_string(expected),
          selvedge_status_string(found));
  faults++;
}

#define EXPECT(expected, call)                                                                              \
  do {                                                                                                      \
    selvedge_status found_ = (call);                                                                        \
    if (found_ != SELVEDGE_STATUS_##expected) fault(__LINE__, #call, SELVEDGE_STATUS_##expected, found_);   \
    if (found_ != SELVEDGE_STATUS_OK && strlen(selvedge_last_error()) < 10) fault(__LINE__, "words", 0, 0); \
  } while (0)

#define HOLDS(condition)                                                \
  do {                                                                  \
    if (!(condition)) {                                                 \
      fprintf(stderr, "line %d: not so: %s\n", __LINE__, #condition);   \
      faults++;                                                         \
    }                                                                   \
  } while (0)

/* A small triangle that falls through a large one. */
enum { VERTICES = 6 };
static const uint32_t TRIANGLES[6] = {0, 1, 2, 3, 4, 5};
static const double START[3 * VERTICES] = {-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, 0.2, 1, 0, 0.3, 0, 1, 0.4};
static const double END[3 * VERTICES] = {-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, -0.2, 1, 0, -0.1, 0, 1, 0};

#endif
