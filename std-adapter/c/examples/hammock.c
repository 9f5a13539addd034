/* A ball of an engine falls into a held sheet and comes to rest there. The engine moves the ball, and the sheet makes it yield:
 *
 *   the engine moves its ball  -->  bring_body  -->  advance  -->  the engine takes over placement and the impulse of proxy_load
 *
 * The load is part of the sheet's own solve. So the ball may be much lighter than the sheet, and no step need be short for it.
 */
#include <selvedge_cloth.h>
#include <stdio.h>

/* std-adapter/cloth/scenes/README.md describes scenes. */
static const char SCENE[] =
    "duration = \"10 s\"\n"
    "frames_per_second = 60\n"
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
    "mass = \"200 g\"\n"
    "proxy = true\n"
    "locked = [\"rotation_x\", \"rotation_y\", \"rotation_z\"]\n"
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

static const double FRAME = 1.0 / 60, GRAVITY = 9.81, BALL = 0.2;
enum { FRAMES = 600 };

int main(void) {
  selvedge_simulation *sheet = NULL;
  selvedge_status status = selvedge_simulation_new(SCENE, NULL, 1, &sheet);

  /* The engine's ball. Its placement moves the ball of the scene, and this engine does not turn it. */
  selvedge_brought_body ball = {.placement = {.rotation = {0, 0, 0, 1}}};
  selvedge_wrench load = {0};
  int certified = 0;
  for (int frame = 1; frame <= FRAMES && status == SELVEDGE_STATUS_OK; frame++) {
    /* The engine's step. */
    ball.velocity[2] -= FRAME * GRAVITY;
    for (int k = 0; k < 3; k++) ball.placement.origin[k] += FRAME * ball.velocity[k];

    selvedge_progress progress = {0};
    bool is_proxy = false, is_known = false;
    status = selvedge_simulation_bring_body(sheet, 0, &ball);
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_advance(sheet, FRAME, 64, NULL);
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_placement(sheet, 0, &is_known, &ball.placement);
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_proxy_load(sheet, 0, &is_proxy, &load);
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_progress(sheet, &progress);
    if (status != SELVEDGE_STATUS_OK) break;
    for (int k = 0; k < 3; k++) ball.velocity[k] += FRAME * load.force[k] / BALL;
    certified += progress.is_certified;
    if (frame % 50 == 0) printf("%.1f s: %.4f m, %.3f N\n", frame * FRAME, 0.1 + ball.placement.origin[2], load.force[2]);
  }
  if (status == SELVEDGE_STATUS_OK) {
    printf("the sheet carries %.4f of the ball's weight; %d of %d states are certified\n", load.force[2] / (BALL * GRAVITY),
           certified, (int)FRAMES);
  } else {
    fprintf(stderr, "%s: %s\n", selvedge_status_string(status), selvedge_last_error());
  }
  selvedge_simulation_free(sheet);
  return status == SELVEDGE_STATUS_OK ? 0 : 1;
}
