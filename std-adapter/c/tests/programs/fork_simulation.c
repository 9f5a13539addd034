/* A child process has none of its parent's threads: simulations with threads fail there, and can be freed; others still work. */
#define _POSIX_C_SOURCE 200809L
#include <selvedge_cloth.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

static const char SCENE[] =
    "time_step = 0.002\nduration = 1\n"
    "[cloth]\nshape = \"sheet\"\nsides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }\ncells = [4, 4]\ndensity = 0.15\n"
    "[effects.gravity]\n";

static int expect(const char *what, selvedge_status expected, selvedge_status found) {
  if (found == expected) return 0;
  fprintf(stderr, "%s: %s\n", what, selvedge_status_string(found));
  return 1;
}

int main(void) {
  selvedge_simulation *with_threads = NULL, *without = NULL;
  int faults = expect("new", SELVEDGE_STATUS_OK, selvedge_simulation_new(SCENE, NULL, 3, &with_threads));
  faults += expect("new", SELVEDGE_STATUS_OK, selvedge_simulation_new(SCENE, NULL, 1, &without));
  faults += expect("step", SELVEDGE_STATUS_OK, selvedge_simulation_step(with_threads));

  pid_t child = fork();
  if (child == 0) {
    alarm(20); /* rather than to wait for threads that are not there */
    faults += expect("child, with threads", SELVEDGE_STATUS_FORKED, selvedge_simulation_step(with_threads));
    faults += expect("child, without", SELVEDGE_STATUS_OK, selvedge_simulation_step(without));
    faults += expect("child, free", SELVEDGE_STATUS_OK, selvedge_simulation_free(with_threads));
    faults += expect("child, free", SELVEDGE_STATUS_OK, selvedge_simulation_free(without));
    _exit(faults);
  }
  int status = 1;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0) faults++;
  faults += expect("parent", SELVEDGE_STATUS_OK, selvedge_simulation_step(with_threads));
  faults += expect("free", SELVEDGE_STATUS_OK, selvedge_simulation_free(with_threads));
  faults += expect("free", SELVEDGE_STATUS_OK, selvedge_simulation_free(without));
  return faults == 0 ? 0 : 1;
}
