/* A ball of an engine falls into a held sheet and comes to rest there. The engine moves the ball, and Selvedge the sheet:
 *
 *   the engine moves its ball  -->  place_body  -->  step  -->  mean_body_load  -->  the engine's next step has this force
 *
 * So the engine's force is one step late. That is stable for a body that is heavier than half of the cloth that it carries, and
 * while the step is short beside its swing: h * sqrt(k / m) < 2. Lighter bodies are free bodies of the scene (`mass`), which move
 * in the same solve as the cloth.
 */
#include <selvedge_cloth.h>
#include <stdio.h>

/* std-adapter/cloth/scenes/README.md describes scenes. */
static const char SCENE[] =
    "time_step = \"4 ms\"\n"
    "duration = \"6 s\"\n"
    "[cloth]\n"
    "shape = \"sheet\"\n"
    "corner = [-0.2, -0.2, 0]\n"
    "sides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }\n"
    "cells = [16, 16]\n"
    "density = \"150 g/m2\"\n"
    "[[body]]\n"
    "name = \"ball\"\n"
    "shape = \"ball\"\n"
    "centre = [0, 0, 0.1]\n"
    "radius = \"5 cm\"\n"
    "around = 24\n"
    "driven = true\n"
    "[effects.gravity]\n"
    "[effects.stretch]\n"
    "stiffness = \"400 N/m\"\n"
    "[effects.shear]\n"
    "stiffness = \"80 N/m\"\n"
    "[effects.body_contact]\n"
    "thickness = \"2 mm\"\n"
    "[effects.friction]\n"
    "coefficient = 0.3\n"
    "[[effects.pins.group]]\n"
    "part = \"left\"\n"
    "[[effects.pins.group]]\n"
    "part = \"right\"\n";

static const double STEP = 4e-3, GRAVITY = 9.81;
/* The weight of the sheet in kg, and that of the ball. */
static const double SHEET = 0.4 * 0.4 * 0.150, BALL = 0.2;
/* The engine's own damping, in 1/s. */
static const double DAMPING = 4.0;

int main(void) {
  if (BALL < 0.5 * SHEET) fprintf(stderr, "the ball is too light to feel its load a step late\n");
  selvedge_simulation *sheet = NULL;
  selvedge_status status = selvedge_simulation_new(SCENE, NULL, 1, &sheet);
  selvedge_sizes sizes = {0};
  if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_sizes(sheet, &sizes);

  /* Where the ball's centre has moved from its place in the scene, and how fast. */
  double moved[3] = {0}, velocity[3] = {0};
  const double centre[3] = {0, 0, 0.1};
  selvedge_body_load load = {0};
  size_t certified = 0;
  for (size_t step = 0; step < sizes.steps && status == SELVEDGE_STATUS_OK; step++) {
    selvedge_pose placement = {.rotation = {0, 0, 0, 1}};
    double about[3];
    for (int k = 0; k < 3; k++) {
      double force = load.contact.force[k] + load.friction.force[k] + (k == 2 ? -BALL * GRAVITY : 0);
      velocity[k] = (velocity[k] + STEP * force / BALL) * (1 - STEP * DAMPING);
      moved[k] += STEP * velocity[k];
      placement.origin[k] = moved[k];
      about[k] = centre[k] + moved[k];
    }
    status = selvedge_simulation_place_body(sheet, 0, &placement);
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_step(sheet);
    /* The torque about the centre would turn the ball; this engine does not turn it. */
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_mean_body_load(sheet, 0, about, &load);
    selvedge_progress progress = {0};
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_progress(sheet, &progress);
    if (status != SELVEDGE_STATUS_OK) break;
    certified += progress.is_certified;
    if (step % 150 == 149) printf("%.1f s: %.4f m, %.3f N\n", (double)(step + 1) * STEP, about[2], load.contact.force[2]);
  }
  if (status == SELVEDGE_STATUS_OK) {
    double carried = load.contact.force[2] + load.friction.force[2];
    printf("the sheet carries %.4f of the ball's weight; %zu of %d states are certified\n", carried / (BALL * GRAVITY), certified,
           (int)sizes.steps);
  } else {
    fprintf(stderr, "%s: %s\n", selvedge_status_string(status), selvedge_last_error());
  }
  selvedge_simulation_free(sheet);
  return status == SELVEDGE_STATUS_OK ? 0 : 1;
}
