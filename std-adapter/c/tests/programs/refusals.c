/* What is wrong is refused by its own status, says why, and changes nothing: the detector answers as before.
 *
 * Run under the sanitizers by check.sh: nothing is read that is not there, and nothing is lost.
 */
#include <math.h>
#include <selvedge.h>
#include <stdio.h>
#include <stdlib.h>
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

enum { VERTICES = 6 };
static const uint32_t TRIANGLES[6] = {0, 1, 2, 3, 4, 5};
static const double START[3 * VERTICES] = {-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, 0.2, 1, 0, 0.3, 0, 1, 0.4};
static const double END[3 * VERTICES] = {-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, -0.2, 1, 0, -0.1, 0, 1, 0};

/* The small triangle falls through the large one. */
static void answers_as_ever(selvedge_detector *detector) {
  const selvedge_contact *contacts = NULL;
  size_t count = 0;
  EXPECT(OK, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
  HOLDS(count == 3);
  for (size_t k = 0; k < count; k++) {
    HOLDS(contacts[k].kind == SELVEDGE_KIND_VERTEX_FACE && contacts[k].pair.second == 0);
    HOLDS(contacts[k].vertices[0] == contacts[k].pair.first && contacts[k].vertices[3] == 2);
    double exact = contacts[k].pair.first == 3 ? 0.5 : contacts[k].pair.first == 4 ? 0.75 : 1.0;
    HOLDS(contacts[k].time <= exact && contacts[k].time > exact - 1e-8);
  }
}

static void meshes(void) {
  selvedge_detector *made = NULL;
  uint32_t triangles[6] = {0, 1, 2, 3, 4, 6};
  EXPECT(NULL_POINTER, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, 2, NULL));
  EXPECT(NULL_POINTER, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, NULL, 2, &made));
  EXPECT(MISALIGNED_POINTER, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES,
                                                   (const uint32_t *)(const void *)((const char *)TRIANGLES + 1), 1, &made));
  EXPECT(NO_TRIANGLES, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, 0, &made));
  EXPECT(NO_TRIANGLES, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, NULL, 0, &made));
  EXPECT(VERTEX_OUT_OF_RANGE, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, triangles, 2, &made));
  triangles[5] = UINT32_MAX;
  EXPECT(VERTEX_OUT_OF_RANGE, selvedge_detector_new(SELVEDGE_SCALAR_F32, VERTICES, triangles, 2, &made));
  EXPECT(VERTEX_OUT_OF_RANGE, selvedge_detector_new(SELVEDGE_SCALAR_F32, 0, triangles, 1, &made));
  EXPECT(UNKNOWN_CONSTANT, selvedge_detector_new(2, VERTICES, TRIANGLES, 2, &made));
  EXPECT(UNKNOWN_CONSTANT, selvedge_detector_new(UINT32_MAX, VERTICES, TRIANGLES, 2, &made));
  /* Counts beyond reason, of which not one entry may be looked at. */
  EXPECT(TOO_LARGE, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, SIZE_MAX, &made));
  EXPECT(TOO_LARGE, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, (size_t)1 << 40, &made));
  EXPECT(TOO_LARGE, selvedge_detector_new(SELVEDGE_SCALAR_F64, SIZE_MAX, TRIANGLES, 2, &made));
  HOLDS(made == NULL);
}

/* 2^32 - 1 vertices can be numbered. Nothing is kept for those without a triangle. */
static void more_vertices_than_memory(void) {
  selvedge_detector *made = NULL;
  bool answer = true;
  EXPECT(OK, selvedge_detector_new(SELVEDGE_SCALAR_F64, UINT32_MAX, TRIANGLES, 2, &made));
  EXPECT(WRONG_LENGTH, selvedge_detector_is_free_f64(made, START, END, VERTICES, &answer));
  EXPECT(OK, selvedge_detector_free(made));
}

static void handles(selvedge_detector *detector) {
  size_t count = 7;
  int nothing = 0;
  selvedge_detector *stale = NULL;
  EXPECT(OK, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, 2, &stale));
  EXPECT(OK, selvedge_detector_free(stale));
  selvedge_detector *wrong[] = {stale, (selvedge_detector *)(void *)&nothing, (selvedge_detector *)(uintptr_t)-1};
  for (int k = 0; k < 3; k++) {
    const selvedge_contact *contacts = NULL;
    EXPECT(NO_SUCH_DETECTOR, selvedge_detector_contacts_f64(wrong[k], START, END, VERTICES, &contacts, &count));
    EXPECT(NO_SUCH_DETECTOR, selvedge_detector_set_threads(wrong[k], 2));
    EXPECT(NO_SUCH_DETECTOR, selvedge_detector_threads(wrong[k], &count));
    EXPECT(NO_SUCH_DETECTOR, selvedge_detector_free(wrong[k]));
    HOLDS(contacts == NULL);
  }
  EXPECT(NULL_POINTER, selvedge_detector_threads(NULL, &count));
  EXPECT(OK, selvedge_detector_free(NULL));
  HOLDS(count == 7);
  answers_as_ever(detector);
}

static void settings(selvedge_detector *detector) {
  const double none[] = {-1, -1e-300, (double)NAN, (double)INFINITY, -(double)INFINITY};
  for (int k = 0; k < 5; k++) {
    EXPECT(BAD_LIMIT, selvedge_detector_set_within(detector, none[k], 0));
    EXPECT(BAD_LIMIT, selvedge_detector_set_within(detector, 0, none[k]));
    EXPECT(BAD_LIMIT, selvedge_detector_set_touching(detector, none[k]));
  }
  const uint8_t moving[VERTICES + 1] = {0};
  EXPECT(WRONG_LENGTH, selvedge_detector_set_moving(detector, moving, VERTICES + 1));
  EXPECT(WRONG_LENGTH, selvedge_detector_set_moving(detector, moving, 0));
  EXPECT(WRONG_LENGTH, selvedge_detector_set_moving(detector, moving, SIZE_MAX));
  EXPECT(NULL_POINTER, selvedge_detector_set_moving(detector, NULL, VERTICES));
  EXPECT(NO_THREADS, selvedge_detector_set_threads(detector, 100000));
  EXPECT(NO_THREADS, selvedge_detector_set_threads(detector, SIZE_MAX));
  EXPECT(NULL_POINTER, selvedge_detector_threads(detector, NULL));
  const selvedge_pair *edges = NULL;
  size_t count = 7;
  EXPECT(NULL_POINTER, selvedge_detector_edges(detector, NULL, &count));
  EXPECT(NULL_POINTER, selvedge_detector_edges(detector, &edges, NULL));
  HOLDS(edges == NULL && count == 7);
  answers_as_ever(detector);
}

static void questions(selvedge_detector *detector) {
  const selvedge_contact *contacts = NULL;
  selvedge_contact contact = {0};
  size_t count = 7, other = 7;
  const selvedge_pair *vf = NULL, *ee = NULL;
  bool answer = true;
  const float single[3 * VERTICES] = {0};
  double wrong[3 * VERTICES];

  EXPECT(NULL_POINTER, selvedge_detector_contacts_f64(detector, NULL, END, VERTICES, &contacts, &count));
  EXPECT(NULL_POINTER, selvedge_detector_contacts_f64(detector, START, NULL, VERTICES, &contacts, &count));
  EXPECT(NULL_POINTER, selvedge_detector_contacts_f64(detector, START, END, VERTICES, NULL, &count));
  EXPECT(NULL_POINTER, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, NULL));
  EXPECT(NULL_POINTER, selvedge_detector_earliest_f64(detector, START, END, VERTICES, NULL, &contact));
  EXPECT(NULL_POINTER, selvedge_detector_earliest_f64(detector, START, END, VERTICES, &answer, NULL));
  EXPECT(NULL_POINTER, selvedge_detector_is_free_f64(detector, START, END, VERTICES, NULL));
  EXPECT(NULL_POINTER, selvedge_detector_candidates_f64(detector, START, END, VERTICES, 0, NULL, &count, &ee, &other));
  EXPECT(NULL_POINTER, selvedge_detector_candidates_f64(detector, START, END, VERTICES, 0, &vf, &count, &ee, NULL));

  const size_t lengths[] = {0, 5, 7, (size_t)1 << 62, SIZE_MAX};
  for (int k = 0; k < 5; k++) {
    EXPECT(WRONG_LENGTH, selvedge_detector_contacts_f64(detector, START, END, lengths[k], &contacts, &count));
    EXPECT(WRONG_LENGTH, selvedge_detector_earliest_f64(detector, START, END, lengths[k], &answer, &contact));
  }
  const double *odd = (const double *)(const void *)((const char *)START + 4);
  EXPECT(MISALIGNED_POINTER, selvedge_detector_contacts_f64(detector, odd, END, VERTICES, &contacts, &count));
  EXPECT(WRONG_SCALAR, selvedge_detector_contacts_f32(detector, single, single, VERTICES, &contacts, &count));
  EXPECT(WRONG_SCALAR, selvedge_detector_is_free_f32(detector, single, single, VERTICES, &answer));

  const double none[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
  for (int k = 0; k < 3; k++) {
    memcpy(wrong, END, sizeof wrong);
    wrong[16] = none[k];
    EXPECT(NOT_FINITE, selvedge_detector_contacts_f64(detector, START, wrong, VERTICES, &contacts, &count));
    HOLDS(strstr(selvedge_last_error(), "end frame") && strstr(selvedge_last_error(), "vertex 5"));
    EXPECT(NOT_FINITE, selvedge_detector_earliest_f64(detector, wrong, END, VERTICES, &answer, &contact));
    EXPECT(NOT_FINITE, selvedge_detector_is_free_f64(detector, wrong, END, VERTICES, &answer));
    EXPECT(NOT_FINITE, selvedge_detector_candidates_f64(detector, wrong, END, VERTICES, 0, &vf, &count, &ee, &other));
  }
  EXPECT(UNKNOWN_CONSTANT, selvedge_detector_candidates_f64(detector, START, END, VERTICES, 2, &vf, &count, &ee, &other));

  const selvedge_intersection *intersections = NULL;
  EXPECT(NULL_POINTER, selvedge_detector_intersections_f64(detector, NULL, VERTICES, &intersections, &count));
  EXPECT(NULL_POINTER, selvedge_detector_intersections_f64(detector, START, VERTICES, NULL, &count));
  EXPECT(NULL_POINTER, selvedge_detector_has_intersections_f64(detector, START, VERTICES, NULL));
  EXPECT(NOT_FINITE, selvedge_detector_intersections_f64(detector, wrong, VERTICES, &intersections, &count));
  EXPECT(WRONG_LENGTH, selvedge_detector_has_intersections_f64(detector, START, SIZE_MAX, &answer));
  EXPECT(WRONG_SCALAR, selvedge_detector_has_intersections_f32(detector, single, VERTICES, &answer));
  HOLDS(intersections == NULL);

  const selvedge_pair pairs[] = {{3, 0}, {6, 0}, {3, 2}, {UINT32_MAX, UINT32_MAX}};
  for (int k = 1; k < 4; k++) {
    EXPECT(NO_SUCH_PAIR,
           selvedge_detector_contacts_of_f64(detector, START, END, VERTICES, pairs + k, 1, NULL, 0, &contacts, &count));
  }
  EXPECT(NO_SUCH_PAIR,
         selvedge_detector_contacts_of_f64(detector, START, END, VERTICES, NULL, 0, pairs + 1, 1, &contacts, &count));
  EXPECT(NULL_POINTER, selvedge_detector_contacts_of_f64(detector, START, END, VERTICES, NULL, 1, pairs, 1, &contacts, &count));
  EXPECT(BAD_COUNT,
         selvedge_detector_contacts_of_f64(detector, START, END, VERTICES, pairs, SIZE_MAX, pairs, 1, &contacts, &count));
  HOLDS(contacts == NULL && vf == NULL && ee == NULL && count == 7 && other == 7 && answer && contact.time == 0);
  answers_as_ever(detector);

  /* A failed call leaves what an earlier one has shown. */
  EXPECT(OK, selvedge_detector_contacts_of_f64(detector, START, END, VERTICES, pairs, 1, NULL, 0, &contacts, &count));
  const selvedge_contact *before = contacts;
  EXPECT(WRONG_LENGTH, selvedge_detector_contacts_f64(detector, START, END, 0, &contacts, &count));
  HOLDS(contacts == before && count == 1 && contacts[0].pair.first == 3);
}

/* A question that is cut short leaves the detector, and what it has shown. */
static void cut_short(selvedge_detector *detector) {
  const selvedge_contact *contacts = NULL;
  const selvedge_pair *vf = NULL, *ee = NULL;
  size_t count = 0, vf_count = 0, ee_count = 0;
  bool answer = true;
  EXPECT(OK, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
  EXPECT(OK,
         selvedge_detector_candidates_f64(detector, START, END, VERTICES, SELVEDGE_BOXES_SWEPT, &vf, &vf_count, &ee, &ee_count));
  HOLDS(vf_count >= 3 && vf[0].second == 0);
  const selvedge_pair first = vf[0];

  for (int cancelled = 0; cancelled < 2; cancelled++) {
    EXPECT(OK, cancelled ? selvedge_detector_set_cancelled(detector, 1) : selvedge_detector_set_pair_limit(detector, 0));
#define CUT(call) \
  if (cancelled) \
    EXPECT(CANCELLED, call); \
  else \
    EXPECT(TOO_MANY_PAIRS, call)
    CUT(selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
    CUT(selvedge_detector_candidates_f64(detector, START, END, VERTICES, SELVEDGE_BOXES_SWEPT, &vf, &vf_count, &ee, &ee_count));
    CUT(selvedge_detector_is_free_f64(detector, START, END, VERTICES, &answer));
    HOLDS(count == 3 && contacts[0].kind == SELVEDGE_KIND_VERTEX_FACE && contacts[0].pair.second == 0);
    HOLDS(vf[0].first == first.first && vf[0].second == 0 && answer);
    EXPECT(OK, selvedge_detector_set_cancelled(detector, 0));
    EXPECT(OK, selvedge_detector_set_pair_limit(detector, UINT64_MAX));
    answers_as_ever(detector);
    EXPECT(OK, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
  }
}

/* A leak would be found here, by the sanitizer. */
static void come_and_go(void) {
  for (int k = 0; k < 300; k++) {
    selvedge_detector *made = NULL;
    EXPECT(OK, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, 2, &made));
    if (k % 50 == 0) EXPECT(OK, selvedge_detector_set_threads(made, 2));
    answers_as_ever(made);
    EXPECT(OK, selvedge_detector_free(made));
  }
}

int main(void) {
  HOLDS(selvedge_version() == SELVEDGE_VERSION);
  HOLDS(*selvedge_last_error() == '\0');
  selvedge_detector *detector = NULL;
  EXPECT(OK, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, 2, &detector));
  answers_as_ever(detector);
  meshes();
  more_vertices_than_memory();
  handles(detector);
  settings(detector);
  questions(detector);
  cut_short(detector);
  come_and_go();
  EXPECT(OK, selvedge_detector_free(detector));
  return faults == 0 ? 0 : 1;
}
