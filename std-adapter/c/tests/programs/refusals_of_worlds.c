/* A wrong call of a world returns a status for its error, with a message, and changes nothing. See refusals.c. */
#include "expect.h"
#include <math.h>
#include <stdlib.h>

/* A floor, and a triangle that falls onto it. */
static const double ABOVE[9] = {0, 0, 0.25, 1, 0, 0.25, 0, 1, 0.25}, BELOW[9] = {0, 0, -0.25, 1, 0, -0.25, 0, 1, -0.25};

static void world_answers(selvedge_world *world, selvedge_mesh mesh) {
  const selvedge_world_contact *contacts = NULL;
  const selvedge_world_geometry *geometries = NULL;
  size_t count = 0, shown = 0;
  const selvedge_deforming_f64 falls = {mesh, ABOVE, BELOW, 3};
  EXPECT(OK, selvedge_world_contacts_f64(world, &falls, 1, NULL, 0, &contacts, &count));
  HOLDS(count == 3 && contacts[0].meshes[0] == mesh && contacts[0].contact.pair.second == 0);
  EXPECT(OK, selvedge_world_contact_geometries(world, contacts, count, &geometries, &shown));
  HOLDS(shown == 3 && geometries[0].meshes[0] == mesh && geometries[0].geometry.normal[2] == 1);
}

static void worlds(void) {
  selvedge_world *world = NULL, *stale = NULL;
  selvedge_mesh floor = 0, mesh = 0, gone = 0;
  EXPECT(NULL_POINTER, selvedge_world_new(SELVEDGE_SCALAR_F64, NULL));
  EXPECT(UNKNOWN_CONSTANT, selvedge_world_new(2, &world));
  EXPECT(OK, selvedge_world_new(SELVEDGE_SCALAR_F64, &world));
  EXPECT(OK, selvedge_world_new(SELVEDGE_SCALAR_F64, &stale));
  EXPECT(OK, selvedge_world_free(stale));
  EXPECT(NO_SUCH_WORLD, selvedge_world_free(stale));
  EXPECT(NO_SUCH_WORLD, selvedge_world_set_threads(stale, 1));
  EXPECT(NULL_POINTER, selvedge_world_set_threads(NULL, 1));
  EXPECT(OK, selvedge_world_free(NULL));

#define INSERT(vertices, triangles, count, positions, groups, mesh) \
  selvedge_world_insert_f64(world, vertices, triangles, count, positions, groups, mesh)
  EXPECT(OK, INSERT(3, TRIANGLES, 1, START, NULL, &floor));
  EXPECT(OK, INSERT(3, TRIANGLES, 1, ABOVE, NULL, &mesh));
  EXPECT(OK, INSERT(3, TRIANGLES, 1, ABOVE, NULL, &gone));
  EXPECT(OK, selvedge_world_remove(world, gone));
  HOLDS(floor != 0 && mesh != 0 && floor != mesh);
  world_answers(world, mesh);

  selvedge_mesh none = 7;
  const double not_finite[9] = {(double)NAN};
  const float single[9] = {0};
  const selvedge_groups *odd = (const selvedge_groups *)(const void *)((const char *)TRIANGLES + 1);
  EXPECT(NULL_POINTER, INSERT(3, NULL, 1, ABOVE, NULL, &none));
  EXPECT(NULL_POINTER, INSERT(3, TRIANGLES, 1, NULL, NULL, &none));
  EXPECT(NULL_POINTER, INSERT(3, TRIANGLES, 1, ABOVE, NULL, NULL));
  EXPECT(MISALIGNED_POINTER, INSERT(3, TRIANGLES, 1, ABOVE, odd, &none));
  EXPECT(NO_TRIANGLES, INSERT(3, TRIANGLES, 0, ABOVE, NULL, &none));
  EXPECT(VERTEX_OUT_OF_RANGE, INSERT(2, TRIANGLES, 1, ABOVE, NULL, &none));
  EXPECT(TOO_LARGE, INSERT(3, TRIANGLES, SIZE_MAX, ABOVE, NULL, &none));
  EXPECT(TOO_LARGE, INSERT(SIZE_MAX / 2, TRIANGLES, 1, ABOVE, NULL, &none));
  EXPECT(NOT_FINITE, INSERT(3, TRIANGLES, 1, not_finite, NULL, &none));
  EXPECT(WRONG_SCALAR, selvedge_world_insert_f32(world, 3, TRIANGLES, 1, single, NULL, &none));
  HOLDS(none == 7);

  const selvedge_mesh strange[] = {0, gone, UINT64_MAX, (selvedge_mesh)1 << 32};
  const selvedge_pair *edges = NULL;
  const selvedge_world_contact *contacts = NULL;
  selvedge_world_contact contact = {0};
  const selvedge_world_geometry *geometries = NULL;
  size_t count = 7;
  bool answer = true;
#define CONTACTS(deforming, deforming_count, rigid, rigid_count) \
  selvedge_world_contacts_f64(world, deforming, deforming_count, rigid, rigid_count, &contacts, &count)
  const selvedge_deforming_f64 falls = {mesh, ABOVE, BELOW, 3};
  const selvedge_pose here = {{0, 0, 0, 1}, {0, 0, 0}}, nowhere = {{0, 0, 0, 0}, {0, 0, 0}}, far = {{0, 0, 0, 1}, {0, 0, (double)NAN}};
  selvedge_rigid rigid = {mesh, here, here};
  for (int k = 0; k < 4; k++) {
    selvedge_deforming_f64 other = falls;
    other.mesh = rigid.mesh = strange[k];
    EXPECT(NO_SUCH_MESH, selvedge_world_remove(world, strange[k]));
    EXPECT(NO_SUCH_MESH, selvedge_world_set_groups(world, strange[k], NULL));
    EXPECT(NO_SUCH_MESH, selvedge_world_edges(world, strange[k], &edges, &count));
    EXPECT(NO_SUCH_MESH, CONTACTS(&other, 1, NULL, 0));
    EXPECT(NO_SUCH_MESH, CONTACTS(NULL, 0, &rigid, 1));
    EXPECT(NO_SUCH_MESH, selvedge_world_earliest_f64(world, &other, 1, NULL, 0, &answer, &contact));
    EXPECT(NO_SUCH_MESH, selvedge_world_is_free_f64(world, NULL, 0, &rigid, 1, &answer));
  }
  const size_t lengths[] = {0, 2, 4, SIZE_MAX};
  for (int k = 0; k < 4; k++) {
    selvedge_deforming_f64 other = falls;
    other.vertex_count = lengths[k];
    EXPECT(WRONG_LENGTH, CONTACTS(&other, 1, NULL, 0));
  }
  selvedge_deforming_f64 other = falls;
  other.end = NULL;
  EXPECT(NULL_POINTER, CONTACTS(&other, 1, NULL, 0));
  other.end = not_finite;
  EXPECT(NOT_FINITE, CONTACTS(&other, 1, NULL, 0));
  other.end = (const double *)(const void *)((const char *)BELOW + 4);
  EXPECT(MISALIGNED_POINTER, CONTACTS(&other, 1, NULL, 0));
  rigid.mesh = mesh;
  rigid.end = nowhere;
  EXPECT(BAD_POSE, CONTACTS(NULL, 0, &rigid, 1));
  rigid.end = far;
  EXPECT(BAD_POSE, CONTACTS(NULL, 0, &rigid, 1));
  rigid.end = here;
  EXPECT(MOVED_TWICE, CONTACTS(&falls, 1, &rigid, 1));
  EXPECT(NULL_POINTER, CONTACTS(NULL, 1, NULL, 0));
  EXPECT(NULL_POINTER, CONTACTS(NULL, 0, NULL, 1));
  EXPECT(BAD_COUNT, CONTACTS(&falls, SIZE_MAX, NULL, 0));
  EXPECT(BAD_COUNT, CONTACTS(NULL, 0, &rigid, SIZE_MAX));
  EXPECT(NULL_POINTER, selvedge_world_contacts_f64(world, &falls, 1, NULL, 0, NULL, &count));
  EXPECT(NULL_POINTER, selvedge_world_earliest_f64(world, &falls, 1, NULL, 0, NULL, &contact));
  EXPECT(NULL_POINTER, selvedge_world_is_free_f64(world, &falls, 1, NULL, 0, NULL));
  const selvedge_deforming_f32 as_float = {mesh, single, single, 3};
  EXPECT(WRONG_SCALAR, selvedge_world_is_free_f32(world, &as_float, 1, NULL, 0, &answer));
  EXPECT(BAD_LIMIT, selvedge_world_set_within(world, -1, 0));
  EXPECT(BAD_LIMIT, selvedge_world_set_touching(world, (double)NAN));
  EXPECT(NO_THREADS, selvedge_world_set_threads(world, 100000));
  HOLDS(contacts == NULL && edges == NULL && count == 7 && answer && contact.contact.time == 0);

  EXPECT(OK, CONTACTS(&falls, 1, NULL, 0));
  HOLDS(count == 3);
  selvedge_world_contact row = contacts[0];
  size_t shown = 7;
#define GEOMETRY(rows, rows_count) selvedge_world_contact_geometries(world, rows, rows_count, &geometries, &shown)
  row.meshes[1] = gone;
  EXPECT(NO_SUCH_MESH, GEOMETRY(&row, 1));
  row = contacts[0];
  row.contact.kind = 2;
  EXPECT(UNKNOWN_CONSTANT, GEOMETRY(&row, 1));
  row = contacts[0];
  row.contact.pair.second = 1;
  EXPECT(NO_SUCH_PAIR, GEOMETRY(&row, 1));
  row = contacts[0];
  row.contact.time = (double)NAN;
  EXPECT(BAD_TIME, GEOMETRY(&row, 1));
  EXPECT(NULL_POINTER, GEOMETRY(NULL, 1));
  EXPECT(BAD_COUNT, GEOMETRY(contacts, SIZE_MAX));
  HOLDS(geometries == NULL && shown == 7);

  EXPECT(OK, selvedge_world_set_pair_limit(world, 0));
  EXPECT(TOO_MANY_PAIRS, CONTACTS(&falls, 1, NULL, 0));
  EXPECT(OK, selvedge_world_set_pair_limit(world, UINT64_MAX));
  EXPECT(OK, selvedge_world_set_memory_limit(world, 0));
  EXPECT(TOO_MUCH_MEMORY, CONTACTS(&falls, 1, NULL, 0));
  EXPECT(OK, selvedge_world_set_memory_limit(world, UINT64_MAX));
  EXPECT(OK, selvedge_world_set_cancelled(world, 1));
  EXPECT(CANCELLED, CONTACTS(&falls, 1, NULL, 0));
  EXPECT(OK, selvedge_world_set_cancelled(world, 0));
  HOLDS(count == 3 && contacts[0].meshes[0] == mesh);
  world_answers(world, mesh);
  EXPECT(OK, selvedge_world_free(world));

  for (int k = 0; k < 100; k++) {
    EXPECT(OK, selvedge_world_new(SELVEDGE_SCALAR_F64, &world));
    EXPECT(OK, INSERT(3, TRIANGLES, 1, START, NULL, &floor));
    EXPECT(OK, INSERT(3, TRIANGLES, 1, ABOVE, NULL, &mesh));
    if (k % 50 == 0) EXPECT(OK, selvedge_world_set_threads(world, 2));
    world_answers(world, mesh);
    EXPECT(OK, selvedge_world_free(world));
  }
}

int main(void) {
  worlds();
  return faults == 0 ? 0 : 1;
}
