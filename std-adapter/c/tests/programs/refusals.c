/* A wrong call returns a status for its error, with a message, and changes nothing: the detector answers as before.
 *
 * check.sh runs this under the sanitizers, which find invalid reads and leaks.
 */
#include "expect.h"
#include <math.h>
#include <stdlib.h>

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
  /* The counts are far too large; the library must not read an entry. */
  EXPECT(TOO_LARGE, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, SIZE_MAX, &made));
  EXPECT(TOO_LARGE, selvedge_detector_new(SELVEDGE_SCALAR_F64, VERTICES, TRIANGLES, (size_t)1 << 40, &made));
  EXPECT(TOO_LARGE, selvedge_detector_new(SELVEDGE_SCALAR_F64, SIZE_MAX, TRIANGLES, 2, &made));
  HOLDS(made == NULL);
}

/* 2^32 - 1 vertices can be numbered. Those without a triangle take no memory. */
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

  /* A failed call keeps the result of an earlier one. */
  EXPECT(OK, selvedge_detector_contacts_of_f64(detector, START, END, VERTICES, pairs, 1, NULL, 0, &contacts, &count));
  const selvedge_contact *before = contacts;
  EXPECT(WRONG_LENGTH, selvedge_detector_contacts_f64(detector, START, END, 0, &contacts, &count));
  HOLDS(contacts == before && count == 1 && contacts[0].pair.first == 3);
}

/* Tests the geometry of contacts, near pairs, and truncation. */
static void places(selvedge_detector *detector) {
  const selvedge_contact *contacts = NULL;
  const selvedge_geometry *geometries = NULL;
  selvedge_truncation truncation = {7, 7, 7};
  size_t count = 0, other = 7;
  double end[3 * VERTICES] = {7}, wrong[3 * VERTICES];
  const float single[3 * VERTICES] = {0};
  float single_end[3 * VERTICES] = {7};
  EXPECT(OK, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
  HOLDS(count == 3);
  memcpy(wrong, END, sizeof wrong);
  wrong[16] = (double)NAN;

#define GEOMETRIES(start, end, length, rows, rows_count) \
  selvedge_detector_contact_geometries_f64(detector, start, end, length, rows, rows_count, &geometries, &other)
  EXPECT(NULL_POINTER, GEOMETRIES(NULL, END, VERTICES, contacts, count));
  EXPECT(NULL_POINTER, GEOMETRIES(START, END, VERTICES, NULL, 1));
  EXPECT(NULL_POINTER, selvedge_detector_contact_geometries_f64(detector, START, END, VERTICES, contacts, count, NULL, &other));
  EXPECT(NULL_POINTER,
         selvedge_detector_contact_geometries_f64(detector, START, END, VERTICES, contacts, count, &geometries, NULL));
  EXPECT(WRONG_LENGTH, GEOMETRIES(START, END, SIZE_MAX, contacts, count));
  EXPECT(NOT_FINITE, GEOMETRIES(START, wrong, VERTICES, contacts, count));
  EXPECT(BAD_COUNT, GEOMETRIES(START, END, VERTICES, contacts, SIZE_MAX));
  EXPECT(WRONG_SCALAR, selvedge_detector_contact_geometries_f32(detector, single, single, VERTICES, contacts, count, &geometries,
                                                                &other));
  selvedge_contact row = contacts[0];
  row.kind = 2;
  EXPECT(UNKNOWN_CONSTANT, GEOMETRIES(START, END, VERTICES, &row, 1));
  row = contacts[0];
  row.pair.second = 2;
  EXPECT(NO_SUCH_PAIR, GEOMETRIES(START, END, VERTICES, &row, 1));
  const double never[] = {-1e-300, 1.0000000001, (double)NAN, (double)INFINITY};
  for (int k = 0; k < 4; k++) {
    row = contacts[0];
    row.time = never[k];
    EXPECT(BAD_TIME, GEOMETRIES(START, END, VERTICES, &row, 1));
  }
  HOLDS(geometries == NULL && other == 7);
  EXPECT(OK, GEOMETRIES(START, END, VERTICES, NULL, 0));
  HOLDS(geometries == NULL && other == 0);
  /* The list of contacts is still valid, and the library does not read the vertices of a caller's row. */
  EXPECT(OK, GEOMETRIES(START, END, VERTICES, contacts, count));
  HOLDS(other == 3 && geometries[0].pair.first == contacts[0].pair.first && geometries[0].vertices[3] == 2);
  HOLDS(geometries[0].has_normal && geometries[0].normal[2] == 1 && fabs(geometries[0].speed + 0.4) < 1e-12);
  HOLDS(fabs(geometries[0].points[0][2]) < 1e-8 && geometries[0].weights[0] == 1);
  HOLDS(geometries[0].distance[0] <= geometries[0].distance[1] && geometries[0].distance[1] < 1e-8);
  const selvedge_geometry *shown = geometries;
  row = contacts[0];
  row.time = 0;
  for (int k = 0; k < 4; k++) row.vertices[k] = UINT32_MAX;
  row.kind = 2;
  EXPECT(UNKNOWN_CONSTANT, GEOMETRIES(START, END, VERTICES, &row, 1));
  HOLDS(geometries == shown && other == 3 && geometries[0].normal[2] == 1);
  row.kind = SELVEDGE_KIND_VERTEX_FACE;
  EXPECT(OK, GEOMETRIES(START, END, VERTICES, &row, 1));
  HOLDS(other == 1 && geometries[0].vertices[3] == 2);

  const selvedge_geometry *near_each_other = NULL;
  size_t near_count = 7;
#define NEAR(positions, length, distance) \
  selvedge_detector_near_f64(detector, positions, length, distance, &near_each_other, &near_count)
  EXPECT(NULL_POINTER, NEAR(NULL, VERTICES, 1));
  EXPECT(NULL_POINTER, selvedge_detector_near_f64(detector, START, VERTICES, 1, NULL, &near_count));
  EXPECT(NULL_POINTER, selvedge_detector_near_f64(detector, START, VERTICES, 1, &near_each_other, NULL));
  EXPECT(WRONG_LENGTH, NEAR(START, VERTICES - 1, 1));
  EXPECT(NOT_FINITE, NEAR(wrong, VERTICES, 1));
  EXPECT(WRONG_SCALAR, selvedge_detector_near_f32(detector, single, VERTICES, 1, &near_each_other, &near_count));
  const double none[] = {-1, (double)NAN, (double)INFINITY};
  for (int k = 0; k < 3; k++) EXPECT(BAD_LIMIT, NEAR(START, VERTICES, none[k]));
  HOLDS(near_each_other == NULL && near_count == 7);
  EXPECT(OK, NEAR(START, VERTICES, 0.1));
  HOLDS(near_each_other == NULL && near_count == 0);
  EXPECT(OK, NEAR(START, VERTICES, 0.25));
  HOLDS(near_count == 1 && near_each_other[0].pair.first == 3 && near_each_other[0].has_normal);
  HOLDS(near_each_other[0].distance[0] <= 0.2 && near_each_other[0].distance[1] >= 0.2);
  /* This list differs from the other one: nothing moves in it. */
  HOLDS(near_each_other[0].speed == 0 && other == 1 && fabs(geometries[0].speed + 0.4) < 1e-12);

#define TRUNCATE(start, wanted, length, end) selvedge_detector_truncate_f64(detector, start, wanted, length, end, &truncation)
  EXPECT(NULL_POINTER, TRUNCATE(NULL, END, VERTICES, end));
  EXPECT(NULL_POINTER, TRUNCATE(START, NULL, VERTICES, end));
  HOLDS(strstr(selvedge_last_error(), "wanted"));
  EXPECT(NULL_POINTER, TRUNCATE(START, END, VERTICES, NULL));
  EXPECT(NULL_POINTER, selvedge_detector_truncate_f64(detector, START, END, VERTICES, end, NULL));
  EXPECT(MISALIGNED_POINTER, TRUNCATE(START, END, VERTICES, (double *)(void *)((char *)end + 4)));
  EXPECT(WRONG_LENGTH, TRUNCATE(START, END, VERTICES + 1, end));
  EXPECT(NOT_FINITE, TRUNCATE(START, wrong, VERTICES, end));
  EXPECT(WRONG_SCALAR, selvedge_detector_truncate_f32(detector, single, single, VERTICES, single_end, &truncation));
  EXPECT(OK, selvedge_detector_set_cancelled(detector, 1));
  EXPECT(CANCELLED, TRUNCATE(START, END, VERTICES, end));
  EXPECT(CANCELLED, NEAR(START, VERTICES, 0.25));
  EXPECT(OK, selvedge_detector_set_cancelled(detector, 0));
  HOLDS(end[0] == 7 && single_end[0] == 7 && truncation.held_back == 7 && truncation.rounds == 7);
  HOLDS(near_count == 1 && near_each_other[0].pair.first == 3);
  EXPECT(OK, TRUNCATE(START, END, VERTICES, end));
  HOLDS(truncation.held_back > 0 && truncation.in_contact == 0 && truncation.rounds > 1);
  bool is_free = false;
  EXPECT(OK, selvedge_detector_is_free_f64(detector, START, end, VERTICES, &is_free));
  HOLDS(is_free && end[11] > 0 && end[11] < START[11]);
  /* The end is replaced in place. */
  memcpy(wrong, END, sizeof wrong);
  EXPECT(OK, TRUNCATE(START, wrong, VERTICES, wrong));
  HOLDS(memcmp(wrong, end, sizeof end) == 0);
  answers_as_ever(detector);
}

static size_t contact_count(selvedge_detector *detector) {
  const selvedge_contact *contacts = NULL;
  size_t count = 7;
  EXPECT(OK, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
  return count;
}

/* A filter that is rejected leaves the one before. */
static void filters(selvedge_detector *detector) {
  const selvedge_groups groups[VERTICES + 1] = {{1, 2}, {1, 2}, {1, 2}, {2, 1}, {4, 4}, {4, 4}, {1, 1}};
  const uint32_t patches[VERTICES] = {0, 0, 0, 0, 1, 1};
  const selvedge_pair excluded[] = {{4, 0}, {1, 4}, {2, 4}, {0, 6}};
#define FILTER(groups, patches, length, excluded, count) \
  selvedge_detector_set_collision_filter(detector, groups, patches, length, excluded, count)
  EXPECT(OK, FILTER(groups, NULL, VERTICES, NULL, 0));
  HOLDS(contact_count(detector) == 1);
  const size_t lengths[] = {0, VERTICES - 1, VERTICES + 1, SIZE_MAX};
  for (int k = 0; k < 4; k++) {
    EXPECT(WRONG_LENGTH, FILTER(groups, NULL, lengths[k], NULL, 0));
    EXPECT(WRONG_LENGTH, FILTER(NULL, patches, lengths[k], NULL, 0));
  }
  EXPECT(VERTEX_OUT_OF_RANGE, FILTER(NULL, NULL, 0, excluded, 4));
  HOLDS(strstr(selvedge_last_error(), "vertex 6"));
  EXPECT(VERTEX_OUT_OF_RANGE, FILTER(groups, patches, VERTICES, excluded, 4));
  EXPECT(NULL_POINTER, FILTER(NULL, NULL, 0, NULL, 1));
  EXPECT(BAD_COUNT, FILTER(NULL, NULL, 0, excluded, SIZE_MAX));
  const selvedge_groups *odd_groups = (const selvedge_groups *)(const void *)((const char *)groups + 1);
  const uint32_t *odd_patches = (const uint32_t *)(const void *)((const char *)patches + 2);
  EXPECT(MISALIGNED_POINTER, FILTER(odd_groups, NULL, VERTICES, NULL, 0));
  EXPECT(MISALIGNED_POINTER, FILTER(NULL, odd_patches, VERTICES, NULL, 0));
  HOLDS(contact_count(detector) == 1);
  EXPECT(OK, FILTER(NULL, patches, VERTICES, NULL, 0));
  HOLDS(contact_count(detector) == 2);
  EXPECT(OK, FILTER(NULL, NULL, 0, excluded, 3));
  HOLDS(contact_count(detector) == 2);
  EXPECT(OK, FILTER(groups, patches, VERTICES, excluded, 3));
  HOLDS(contact_count(detector) == 0);
  EXPECT(OK, FILTER(NULL, NULL, 0, NULL, 0));
  answers_as_ever(detector);
}

/* An interrupted search leaves the detector, and its results, as they were. */
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
  EXPECT(OK, selvedge_detector_set_memory_limit(detector, 2 * 48));
  EXPECT(TOO_MUCH_MEMORY, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
  EXPECT(OK, selvedge_detector_set_memory_limit(detector, UINT64_MAX));
  EXPECT(OK, selvedge_detector_contacts_f64(detector, START, END, VERTICES, &contacts, &count));
}

/* The sanitizer would find a leak here. */
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
  places(detector);
  filters(detector);
  cut_short(detector);
  come_and_go();
  EXPECT(OK, selvedge_detector_free(detector));
  return faults == 0 ? 0 : 1;
}
