/* A flag in a wind that turns: 500 steps of 2 ms. Prints where the flag's free corner is, and whether each state is certified to
 * be free of intersections.
 */
#include <selvedge_cloth.h>
#include <stdio.h>
#include <stdlib.h>

/* std-adapter/cloth/scenes/README.md describes scenes. */
static const char SCENE[] =
    "time_step = \"2 ms\"\n"
    "duration = \"1 s\"\n"
    "[cloth]\n"
    "shape = \"sheet\"\n"
    "corner = [0, 0, 1]\n"
    "sides = { first = [0.9, 0, 0], second = [0, 0, 0.6] }\n"
    "cells = [18, 12]\n"
    "density = \"120 g/m2\"\n"
    "[effects.gravity]\n"
    "[effects.wind]\n"
    "velocity = [0, 0, 0]\n"
    "[effects.air_drag]\n"
    "rate = \"0.1 1/s\"\n"
    "[effects.stretch]\n"
    "stiffness = \"1 kN/m\"\n"
    "[effects.shear]\n"
    "stiffness = \"200 N/m\"\n"
    "[effects.bend]\n"
    "stiffness = \"20 uN m\"\n"
    "[effects.self_collision]\n"
    "thickness = \"5 mm\"\n"
    "[[effects.pins.group]]\n"
    "part = \"left\"\n";

/* The velocities of the wind in m/s, for 100 steps each. */
static const double WINDS[5][3] = {{6, 1, 0}, {6, -4, 0}, {-5, 3, 0}, {12, 0, 1}, {0, 0, 0}};

int main(void) {
  selvedge_simulation *flag = NULL;
  selvedge_status status = selvedge_simulation_new(SCENE, NULL, 1, &flag);
  selvedge_sizes sizes = {0};
  if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_sizes(flag, &sizes);
  double *positions = calloc(3 * sizes.vertex_count + 1, sizeof *positions);
  if (!positions) return 1;

  size_t certified = 0;
  for (size_t step = 0; step < sizes.steps && status == SELVEDGE_STATUS_OK; step++) {
    const double *wind = WINDS[step / 100 % 5];
    status = selvedge_simulation_set_wind(flag, wind[0], wind[1], wind[2]);
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_step(flag);

    selvedge_progress progress = {0};
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_progress(flag, &progress);
    if (status == SELVEDGE_STATUS_OK) status = selvedge_simulation_positions(flag, positions, sizes.vertex_count);
    if (status != SELVEDGE_STATUS_OK) break;
    certified += progress.is_certified;
    if (progress.steps_done % 50 != 0) continue;
    const double *corner = positions + 3 * (sizes.vertex_count - 1);
    printf("step %3d: %.17g %.17g %.17g %s\n", (int)progress.steps_done, corner[0], corner[1], corner[2],
           progress.is_certified ? "certified" : "not certified");
  }
  if (status == SELVEDGE_STATUS_OK) {
    printf("%zu of %d states are certified\n", certified, (int)sizes.steps);
  } else {
    fprintf(stderr, "%s: %s\n", selvedge_status_string(status), selvedge_last_error());
  }
  free(positions);
  selvedge_simulation_free(flag);
  return status == SELVEDGE_STATUS_OK ? 0 : 1;
}
