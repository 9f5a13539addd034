/* A wrong call of a simulation returns a status for its error, with a message, and changes nothing: the simulation continues as
 * without the call.
 *
 * check.sh runs this under the sanitizers, which find invalid reads and writes, and leaks.
 */
#include "expect.h"
#include <math.h>
#include <selvedge_cloth.h>
#include <stdlib.h>

#define SAYS(words) HOLDS(strstr(selvedge_last_error(), words))

/* A sheet of 25 vertices above a small ball. The ball and the first of two groups of pins are driven. */
#define HEAD "time_step = 0.002\nduration = 1\n"
#define CLOTH                                                                                                             \
  "[cloth]\nshape = \"sheet\"\nsides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }\ncells = [4, 4]\ndensity = 0.15\n" \
  "[effects.gravity]\n[effects.stretch]\nstiffness = 500\n"
#define BALL "[[body]]\nname = \"ball\"\nshape = \"ball\"\ncentre = [0.2, 0.2, -0.2]\nradius = 0.1\naround = 8\n"
#define REST "[[body]]\nname = \"rest\"\nshape = \"ball\"\ncentre = [0.2, 0.2, -1]\nradius = 0.1\naround = 8\n"
static const char SCENE[] = HEAD BALL
    "driven = true\n" REST CLOTH
    "[effects.wind]\nvelocity = [0, 0, 0]\n"
    "[effects.self_collision]\nthickness = 0.005\n[effects.body_contact]\nthickness = 0.005\n"
    "[[effects.pins.group]]\npart = \"left\"\ndriven = true\n[[effects.pins.group]]\npart = \"right\"\n";
static const char CALM[] = HEAD CLOTH;

enum { CLOTH_VERTICES = 25, PINS = 5 };

static void scenes(void) {
  selvedge_simulation *made = NULL;
  EXPECT(NULL_POINTER, selvedge_simulation_new(NULL, NULL, 1, &made));
  EXPECT(NULL_POINTER, selvedge_simulation_new(SCENE, NULL, 1, NULL));
  EXPECT(NULL_POINTER, selvedge_simulation_read(NULL, 1, &made));
  EXPECT(BAD_TEXT, selvedge_simulation_new("name = \"\xff\"", NULL, 1, &made));
  EXPECT(BAD_TEXT, selvedge_simulation_new(SCENE, "\xff", 1, &made));
  EXPECT(BAD_TEXT, selvedge_simulation_read("\xff.toml", 1, &made));
  EXPECT(BAD_SCENE, selvedge_simulation_new("", NULL, 1, &made));
  EXPECT(BAD_SCENE, selvedge_simulation_new("time_step = \n", NULL, 1, &made));
  SAYS("scene.toml:1:");
  EXPECT(BAD_SCENE, selvedge_simulation_new(HEAD CLOTH "[effects.gravty]\n", "in/a/folder", 1, &made));
  SAYS("gravity");
  SAYS("in/a/folder");
  EXPECT(BAD_SCENE, selvedge_simulation_new(HEAD "[cloth]\nshape = \"file\"\nfile = \"none.obj\"\ndensity = 0.1\n", NULL, 1, &made));
  SAYS("none.obj");
  EXPECT(BAD_SCENE, selvedge_simulation_read("there-is-none.toml", 1, &made));
  SAYS("there-is-none.toml");
  EXPECT(NO_THREADS, selvedge_simulation_new(SCENE, NULL, 100000, &made));
  HOLDS(made == NULL);
}

/* The ball is in the sheet. */
static void tangled(void) {
  static const char in_ball[] = "[[body]]\nname = \"ball\"\nshape = \"ball\"\ncentre = [0.2, 0.2, 0]\nradius = 0.1\n" CLOTH
                                "[effects.body_contact]\nthickness = 0.005\n";
  static const char head[] = "tangled_start = \"tolerate\"\n" HEAD;
  char tolerated[sizeof head + sizeof in_ball] = "", refused[sizeof HEAD + sizeof in_ball] = "";
  strcat(strcat(tolerated, head), in_ball);
  strcat(strcat(refused, HEAD), in_ball);
  selvedge_simulation *it = NULL;
  EXPECT(TANGLED, selvedge_simulation_new(refused, NULL, 1, &it));
  SAYS("'ball'");
  SAYS("tangled_start");
  HOLDS(it == NULL);
  selvedge_progress progress = {0};
  EXPECT(OK, selvedge_simulation_new(tolerated, NULL, 1, &it));
  EXPECT(OK, selvedge_simulation_progress(it, &progress));
  HOLDS(progress.tolerated_pairs > 0 && !progress.is_certified);
  EXPECT(OK, selvedge_simulation_free(it));
}

static void handles(void) {
  int nothing = 0;
  selvedge_simulation *stale = NULL;
  EXPECT(OK, selvedge_simulation_new(CALM, NULL, 1, &stale));
  EXPECT(OK, selvedge_simulation_free(stale));
  EXPECT(OK, selvedge_simulation_free(NULL));
  EXPECT(NULL_POINTER, selvedge_simulation_step(NULL));
  selvedge_detector *detector = NULL;
  const uint32_t triangle[] = {0, 1, 2};
  EXPECT(OK, selvedge_detector_new(SELVEDGE_SCALAR_F64, 3, triangle, 1, &detector));
  selvedge_simulation *wrong[] = {stale, (selvedge_simulation *)(void *)&nothing, (selvedge_simulation *)(void *)detector};
  for (int k = 0; k < 3; k++) {
    selvedge_sizes sizes = {0};
    double positions[3 * CLOTH_VERTICES];
    EXPECT(NO_SUCH_SIMULATION, selvedge_simulation_step(wrong[k]));
    EXPECT(NO_SUCH_SIMULATION, selvedge_simulation_sizes(wrong[k], &sizes));
    EXPECT(NO_SUCH_SIMULATION, selvedge_simulation_positions(wrong[k], positions, CLOTH_VERTICES));
    EXPECT(NO_SUCH_SIMULATION, selvedge_simulation_set_wind(wrong[k], 0, 0, 0));
    EXPECT(NO_SUCH_SIMULATION, selvedge_simulation_free(wrong[k]));
    HOLDS(sizes.vertex_count == 0);
  }
  EXPECT(OK, selvedge_detector_free(detector));
}

static void questions(selvedge_simulation *it, size_t vertices) {
  double *numbers = malloc(3 * vertices * sizeof *numbers);
  if (!numbers) exit(1);
  const size_t lengths[] = {0, vertices - 1, vertices + 1, SIZE_MAX};
  for (int k = 0; k < 4; k++) {
    EXPECT(WRONG_LENGTH, selvedge_simulation_positions(it, numbers, lengths[k]));
    EXPECT(WRONG_LENGTH, selvedge_simulation_velocities(it, numbers, lengths[k]));
    EXPECT(WRONG_LENGTH, selvedge_simulation_normals(it, numbers, lengths[k]));
    EXPECT(WRONG_LENGTH, selvedge_simulation_triangles(it, (uint32_t *)(void *)numbers, lengths[k]));
  }
  EXPECT(NULL_POINTER, selvedge_simulation_positions(it, NULL, vertices));
  double *odd = (double *)(void *)((char *)numbers + 4);
  EXPECT(MISALIGNED_POINTER, selvedge_simulation_velocities(it, odd, vertices));
  EXPECT(OK, selvedge_simulation_normals(it, numbers, vertices));
  HOLDS(fabs(numbers[0]) + fabs(numbers[1]) + fabs(numbers[2]) > 0.9);

  selvedge_part part = {7, 7, 7};
  EXPECT(NULL_POINTER, selvedge_simulation_sizes(it, NULL));
  EXPECT(NULL_POINTER, selvedge_simulation_progress(it, NULL));
  EXPECT(NULL_POINTER, selvedge_simulation_body(it, NULL, &part));
  EXPECT(NULL_POINTER, selvedge_simulation_body(it, "ball", NULL));
  EXPECT(BAD_TEXT, selvedge_simulation_cloth(it, "\xff", &part));
  EXPECT(NO_SUCH_PART, selvedge_simulation_body(it, "bal", &part));
  SAYS("\"ball\"");
  EXPECT(NO_SUCH_PART, selvedge_simulation_cloth(it, "ball", &part));
  HOLDS(part.number == 7);
  EXPECT(OK, selvedge_simulation_cloth(it, "cloth", &part));
  HOLDS(part.number == 0 && part.first_vertex == 0 && part.vertex_count == CLOTH_VERTICES);
  EXPECT(OK, selvedge_simulation_body(it, "rest", &part));
  HOLDS(part.number == 1 && part.first_vertex + part.vertex_count == vertices);

  const selvedge_near_pair *pairs = NULL;
  size_t count = 7;
  EXPECT(NULL_POINTER, selvedge_simulation_near_pairs(it, NULL, &count));
  EXPECT(NULL_POINTER, selvedge_simulation_near_pairs(it, &pairs, NULL));
  HOLDS(count == 7);
  free(numbers);
}

static void leading(selvedge_simulation *it) {
  const selvedge_pose here = {{0, 0, 0, 1}, {0, 0, 0}};
  selvedge_pose wrong = here;
  bool is_known = true;
  EXPECT(NULL_POINTER, selvedge_simulation_place_body(it, 0, NULL));
  EXPECT(NO_SUCH_PART, selvedge_simulation_place_body(it, 2, &here));
  EXPECT(NO_SUCH_PART, selvedge_simulation_place_body(it, SIZE_MAX, &here));
  EXPECT(NOT_DRIVEN, selvedge_simulation_place_body(it, 1, &here));
  SAYS("driven = true");
  wrong.origin[1] = (double)NAN;
  EXPECT(BAD_VALUE, selvedge_simulation_place_body(it, 0, &wrong));
  wrong = here;
  wrong.rotation[3] = 0;
  EXPECT(BAD_VALUE, selvedge_simulation_place_body(it, 0, &wrong));
  EXPECT(NO_SUCH_PART, selvedge_simulation_placement(it, 2, &is_known, &wrong));
  EXPECT(NULL_POINTER, selvedge_simulation_placement(it, 0, NULL, &wrong));
  EXPECT(NULL_POINTER, selvedge_simulation_placement(it, 0, &is_known, NULL));
  EXPECT(OK, selvedge_simulation_placement(it, 1, &is_known, &wrong));
  HOLDS(!is_known);

  double pins[3 * (PINS + 1)] = {0};
  EXPECT(NULL_POINTER, selvedge_simulation_move_pins(it, 0, NULL, PINS));
  EXPECT(WRONG_LENGTH, selvedge_simulation_move_pins(it, 0, pins, PINS + 1));
  EXPECT(WRONG_LENGTH, selvedge_simulation_move_pins(it, 0, pins, 0));
  EXPECT(WRONG_LENGTH, selvedge_simulation_move_pins(it, 0, pins, SIZE_MAX));
  EXPECT(WRONG_LENGTH, selvedge_simulation_move_body(it, 0, pins, PINS));
  EXPECT(NOT_DRIVEN, selvedge_simulation_move_pins(it, 1, pins, PINS));
  EXPECT(NO_SUCH_PART, selvedge_simulation_move_pins(it, 2, pins, PINS));
  EXPECT(NOT_DRIVEN, selvedge_simulation_move_body(it, 1, pins, PINS));
  EXPECT(NO_SUCH_PART, selvedge_simulation_move_body(it, 2, pins, PINS));
  const double none[] = {(double)NAN, (double)INFINITY, 1e300};
  for (int k = 0; k < 3; k++) {
    pins[3 * PINS - 1] = none[k];
    EXPECT(BAD_VALUE, selvedge_simulation_move_pins(it, 0, pins, PINS));
    EXPECT(BAD_VALUE, selvedge_simulation_set_wind(it, none[k], 0, 0));
  }
}

static void loads(selvedge_simulation *it) {
  const double here[] = {0, 0, 0};
  const uint32_t first[] = {0}, beyond[] = {CLOTH_VERTICES};
  const double none[] = {(double)NAN, 0, 0};
  EXPECT(NULL_POINTER, selvedge_simulation_add_forces(it, NULL, here, 1));
  EXPECT(NULL_POINTER, selvedge_simulation_add_forces(it, first, NULL, 1));
  EXPECT(WRONG_LENGTH, selvedge_simulation_add_forces(it, first, here, SIZE_MAX));
  EXPECT(NO_SUCH_PART, selvedge_simulation_add_forces(it, beyond, here, 1));
  EXPECT(BAD_VALUE, selvedge_simulation_add_forces(it, first, none, 1));
  EXPECT(OK, selvedge_simulation_add_forces(it, NULL, NULL, 0));
  selvedge_body_load on_body = {0};
  selvedge_wrench wrench = {0};
  EXPECT(NULL_POINTER, selvedge_simulation_body_load(it, 0, NULL, &on_body));
  EXPECT(NULL_POINTER, selvedge_simulation_mean_body_load(it, 0, here, NULL));
  EXPECT(NO_SUCH_PART, selvedge_simulation_body_load(it, 2, here, &on_body));
  EXPECT(NO_SUCH_PART, selvedge_simulation_pin_load(it, 2, here, &wrench));
  SAYS("pins");
  EXPECT(NO_SUCH_PART, selvedge_simulation_mean_attachment_load(it, 0, here, &wrench));
  EXPECT(OK, selvedge_simulation_mean_pin_load(it, 0, here, &wrench));
  const selvedge_contact_load *contacts = NULL;
  size_t count = 7;
  EXPECT(NULL_POINTER, selvedge_simulation_contact_loads(it, 0, NULL, &count));
  EXPECT(NO_SUCH_PART, selvedge_simulation_contact_loads(it, 2, &contacts, &count));
  HOLDS(count == 7);
}

/* A ball of 0.5 kg that falls away from a sheet. */
static void free_bodies(void) {
  static const char falling[] = HEAD BALL "mass = 0.5\nvelocity = [0, 0, -1]\nspin = [0, 3, 0]\n" REST "driven = true\n" CLOTH
                                "[effects.body_contact]\nthickness = 0.005\n";
  selvedge_simulation *it = NULL;
  selvedge_free_body_state state = {0}, untouched = {0};
  selvedge_pose pose = {{0, 0, 0, 1}, {0, 0, 0}};
  bool is_free = false;
  EXPECT(BAD_SCENE, selvedge_simulation_new(HEAD BALL "mass = 0.5\ndensity = 100\n" CLOTH, NULL, 1, &it));
  SAYS("scene.toml:10:");
  SAYS("`mass` or `density`, not both");
  EXPECT(OK, selvedge_simulation_new(falling, NULL, 1, &it));
  EXPECT(NULL_POINTER, selvedge_simulation_body_motion(it, 0, NULL, &state));
  EXPECT(NULL_POINTER, selvedge_simulation_body_motion(it, 0, &is_free, NULL));
  EXPECT(NO_SUCH_PART, selvedge_simulation_body_motion(it, 2, &is_free, &state));
  SAYS("body 2");
  HOLDS(!is_free && state.mass == 0);
  EXPECT(NOT_DRIVEN, selvedge_simulation_place_body(it, 0, &pose));
  for (int step = 0; step < 100; step++) EXPECT(OK, selvedge_simulation_step(it));
  EXPECT(OK, selvedge_simulation_body_motion(it, 0, &is_free, &state));
  HOLDS(is_free && state.mass == 0.5 && fabs(state.velocity[2] - (-1 - 9.81 * 0.2)) < 1e-9 && fabs(state.spin[1] - 3) < 1e-9);
  HOLDS(state.angular_momentum[1] > 0);
  /* The mesh turns about its centre of mass, which is not at its origin. */
  bool is_known = false;
  EXPECT(OK, selvedge_simulation_placement(it, 0, &is_known, &pose));
  HOLDS(is_known && pose.rotation[1] > 0.2 && fabs(pose.origin[2]) > 0.1);
  EXPECT(OK, selvedge_simulation_body_motion(it, 1, &is_free, &untouched));
  HOLDS(!is_free && untouched.mass == 0);
  EXPECT(OK, selvedge_simulation_free(it));
  EXPECT(NO_SUCH_SIMULATION, selvedge_simulation_body_motion(it, 0, &is_free, &state));
}

/* A ball of another engine below a sheet, which rises by a centimetre in each step of 2 ms until it meets the sheet. */
static void proxies(void) {
  static const char rising[] = HEAD BALL "mass = 0.1\nproxy = true\n" REST "driven = true\n" CLOTH
                               "[effects.body_contact]\nthickness = 0.005\n";
  selvedge_simulation *it = NULL;
  selvedge_brought_body to = {{{0, 0, 0, 1}, {0, 0, 0}}, {0, 0, 5}, {0, 0, 0}}, wrong = to;
  selvedge_wrench load = {0}, untouched = {0};
  selvedge_pose pose = {{0, 0, 0, 1}, {0, 0, 0}};
  bool is_proxy = false, is_known = false;
  EXPECT(OK, selvedge_simulation_new(rising, NULL, 1, &it));
  EXPECT(NULL_POINTER, selvedge_simulation_bring_body(it, 0, NULL));
  EXPECT(NO_SUCH_PART, selvedge_simulation_bring_body(it, 2, &to));
  EXPECT(NOT_DRIVEN, selvedge_simulation_bring_body(it, 1, &to));
  SAYS("proxy = true");
  wrong.spin[2] = (double)NAN;
  EXPECT(BAD_VALUE, selvedge_simulation_bring_body(it, 0, &wrong));
  SAYS("spin");
  wrong = to;
  wrong.placement.rotation[3] = 0;
  EXPECT(BAD_VALUE, selvedge_simulation_bring_body(it, 0, &wrong));
  EXPECT(NOT_DRIVEN, selvedge_simulation_place_body(it, 0, &pose));
  EXPECT(NULL_POINTER, selvedge_simulation_proxy_load(it, 0, NULL, &load));
  EXPECT(NULL_POINTER, selvedge_simulation_proxy_load(it, 0, &is_proxy, NULL));
  EXPECT(NO_SUCH_PART, selvedge_simulation_proxy_load(it, 2, &is_proxy, &load));
  SAYS("body 2");
  EXPECT(OK, selvedge_simulation_proxy_load(it, 1, &is_proxy, &untouched));
  HOLDS(!is_proxy && untouched.force[2] == 0);
  double momentum = 0;
  for (int step = 0; step < 20; step++) {
    to.placement = pose;
    to.placement.origin[2] += 0.002 * to.velocity[2];
    EXPECT(OK, selvedge_simulation_bring_body(it, 0, &to));
    EXPECT(OK, selvedge_simulation_step(it));
    EXPECT(OK, selvedge_simulation_placement(it, 0, &is_known, &pose));
    EXPECT(OK, selvedge_simulation_proxy_load(it, 0, &is_proxy, &load));
    HOLDS(is_known && is_proxy);
    to.velocity[2] += 0.002 * load.force[2] / 0.1;
    momentum += 0.002 * load.force[2];
  }
  HOLDS(momentum < -0.01 && to.velocity[2] < 4.9 && pose.origin[2] > 0.1);
  /* A metre in a step is beyond 100 m/s. Then nothing moves. */
  selvedge_pose after = pose;
  to.placement.origin[2] += 1;
  EXPECT(OK, selvedge_simulation_bring_body(it, 0, &to));
  EXPECT(BLOCKED, selvedge_simulation_step(it));
  SAYS("'ball'");
  EXPECT(OK, selvedge_simulation_placement(it, 0, &is_known, &after));
  HOLDS(after.origin[2] == pose.origin[2]);
  EXPECT(OK, selvedge_simulation_free(it));
  EXPECT(NO_SUCH_SIMULATION, selvedge_simulation_bring_body(it, 0, &to));
}

static void checkpoints(selvedge_simulation *it) {
  const uint8_t *bytes = NULL;
  size_t count = 7;
  EXPECT(NO_CHECKPOINT, selvedge_simulation_checkpoint(it, &bytes, &count));
  SAYS("after step 200");
  EXPECT(NULL_POINTER, selvedge_simulation_checkpoint(it, NULL, &count));
  EXPECT(NULL_POINTER, selvedge_simulation_resume(it, NULL, 9));
  EXPECT(BAD_CHECKPOINT, selvedge_simulation_resume(it, NULL, 0));
  EXPECT(BAD_CHECKPOINT, selvedge_simulation_resume(it, (const uint8_t *)SCENE, sizeof SCENE));
  selvedge_simulation *other = NULL;
  EXPECT(OK, selvedge_simulation_new(CALM, NULL, 1, &other));
  EXPECT(NO_SUCH_PART, selvedge_simulation_set_wind(other, 1, 0, 0));
  SAYS("[effects.wind]");
  EXPECT(OK, selvedge_simulation_checkpoint(other, &bytes, &count));
  EXPECT(BAD_CHECKPOINT, selvedge_simulation_resume(it, bytes, count));
  SAYS("another scene");
  EXPECT(BAD_CHECKPOINT, selvedge_simulation_resume(other, bytes, count - 1));
  EXPECT(OK, selvedge_simulation_resume(other, bytes, count));
  EXPECT(OK, selvedge_simulation_free(other));
}

#define SEAM "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\nl 2 6\n"

static void write_seam(const char *content) {
  FILE *out = fopen("seam.obj", "w");
  if (!out) exit(1);
  fputs(content, out);
  fclose(out);
}

/* A file with a split seam is read, and a cloth of it is numbered as it is. */
static void files(void) {
  write_seam(SEAM "surf 0 1 0 1 1 2 3\n");
  selvedge_file *file = NULL;
  selvedge_mesh_lists mesh = {0};
  const char *missing = NULL, *notes = NULL;
  EXPECT(NULL_POINTER, selvedge_file_new(NULL, &file));
  EXPECT(BAD_TEXT, selvedge_file_new("\xff.obj", &file));
  EXPECT(BAD_FILE, selvedge_file_new("none.obj", &file));
  SAYS("none.obj: there is no such file");
  EXPECT(NO_SUCH_FILE, selvedge_file_mesh((selvedge_file *)(void *)&mesh, &mesh, &missing, &notes));
  EXPECT(OK, selvedge_file_new("seam.obj", &file));
  EXPECT(NULL_POINTER, selvedge_file_mesh(file, NULL, &missing, &notes));
  EXPECT(NULL_POINTER, selvedge_file_mesh(file, &mesh, NULL, &notes));
  EXPECT(OK, selvedge_file_mesh(file, &mesh, &missing, &notes));
  HOLDS(mesh.vertex_count == 6 && mesh.triangle_count == 2 && mesh.loose_edge_count == 1 && !mesh.points && !mesh.point_count);
  HOLDS(mesh.positions[3] == 1 && mesh.triangles[3] == 3 && mesh.loose_edges[1] == 5);
  HOLDS(missing && strcmp(missing, "1 line 'surf' (line 10)") == 0);
  HOLDS(notes && strstr(notes, "surf"));
  EXPECT(OK, selvedge_file_free(file));
  EXPECT(NO_SUCH_FILE, selvedge_file_free(file));
  EXPECT(OK, selvedge_file_free(NULL));

  write_seam(SEAM);
  selvedge_simulation *it = NULL;
  const uint32_t *number_of = NULL;
  size_t count = 0;
  EXPECT(OK, selvedge_simulation_new(HEAD "[cloth]\nshape = \"file\"\nfile = \"seam.obj\"\nweld = 0\ndensity = 0.1\n"
                                          "linear_density = 0.1\n[effects.gravity]\n", NULL, 1, &it));
  EXPECT(OK, selvedge_simulation_step(it));
  EXPECT(NULL_POINTER, selvedge_simulation_mesh_in_files(it, &mesh, NULL, &count));
  EXPECT(OK, selvedge_simulation_mesh_in_files(it, &mesh, &number_of, &count));
  HOLDS(mesh.vertex_count == 6 && count == 4 && number_of[2] == 2 && number_of[3] == 5);
  HOLDS(mesh.triangle_count == 2 && mesh.triangles[4] == 4 && mesh.positions[14] == mesh.positions[8] && mesh.positions[8] < 0);
  EXPECT(OK, selvedge_simulation_free(it));
  remove("seam.obj");
}

/* The ball moves into a sheet of which every vertex is pinned: there is no way out. */
static void blocked(void) {
  selvedge_simulation *it = NULL;
  EXPECT(OK, selvedge_simulation_new(HEAD "on_blocked = \"stop\"\n" BALL "driven = true\n" CLOTH
                                     "[effects.body_contact]\nthickness = 0.005\n"
                                     "[[effects.pins.group]]\nbox = { lower = [-1, -1, -1], upper = [1, 1, 1] }\n", NULL, 1, &it));
  const selvedge_pose above = {{0, 0, 0, 1}, {0, 0, 0.2}};
  selvedge_progress before = {0}, after = {0};
  EXPECT(OK, selvedge_simulation_step(it));
  EXPECT(OK, selvedge_simulation_progress(it, &before));
  EXPECT(OK, selvedge_simulation_place_body(it, 0, &above));
  EXPECT(BLOCKED, selvedge_simulation_step(it));
  SAYS("'ball'");
  EXPECT(OK, selvedge_simulation_progress(it, &after));
  HOLDS(before.steps_done == 1 && after.steps_done == 1 && after.is_certified);
  EXPECT(OK, selvedge_simulation_free(it));
}

int main(void) {
  scenes();
  tangled();
  handles();
  files();
  blocked();
  free_bodies();
  proxies();

  /* One simulation gets all wrong calls after each step, the other none. */
  selvedge_simulation *asked = NULL, *quiet = NULL;
  selvedge_sizes sizes = {0};
  EXPECT(OK, selvedge_simulation_new(SCENE, NULL, 2, &asked));
  EXPECT(OK, selvedge_simulation_new(SCENE, NULL, 1, &quiet));
  EXPECT(OK, selvedge_simulation_sizes(asked, &sizes));
  HOLDS(sizes.cloth_vertex_count == CLOTH_VERTICES && sizes.body_count == 2 && sizes.steps == 500 && sizes.time_step == 0.002);
  const size_t vertices = sizes.vertex_count, bytes = 3 * vertices * sizeof(double);
  double *first = malloc(bytes), *second = malloc(bytes);
  if (!first || !second) return 1;
  for (int step = 0; step < 20; step++) {
    const selvedge_pose up = {{0, 0, 0, 1}, {0, 0, 0.005 * step}};
    selvedge_simulation *both[] = {asked, quiet};
    for (int k = 0; k < 2; k++) {
      EXPECT(OK, selvedge_simulation_place_body(both[k], 0, &up));
      EXPECT(OK, selvedge_simulation_set_wind(both[k], 0, step, 1));
      if (k == 0 && step > 0) {
        questions(asked, vertices);
        leading(asked);
        loads(asked);
        checkpoints(asked);
      }
      EXPECT(OK, selvedge_simulation_step(both[k]));
    }
    EXPECT(OK, selvedge_simulation_positions(asked, first, vertices));
    EXPECT(OK, selvedge_simulation_positions(quiet, second, vertices));
    HOLDS(memcmp(first, second, bytes) == 0);
  }
  EXPECT(OK, selvedge_simulation_free(asked));
  EXPECT(OK, selvedge_simulation_free(quiet));
  free(first);
  free(second);
  return faults == 0 ? 0 : 1;
}
