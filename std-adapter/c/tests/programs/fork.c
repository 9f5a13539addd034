/* A child process has none of its parent's threads: detectors with threads fail there, and can be freed; others still work. */
#define _POSIX_C_SOURCE 200809L
#include <selvedge.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

static const uint32_t TRIANGLES[6] = {0, 1, 2, 3, 4, 5};
static const double POSITIONS[18] = {-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, 0.2, 1, 0, 0.3, 0, 1, 0.4};

static selvedge_status ask(selvedge_detector *detector) {
  bool is_free = false;
  selvedge_status status = selvedge_detector_is_free_f64(detector, POSITIONS, POSITIONS, 6, &is_free);
  return status == SELVEDGE_STATUS_OK && !is_free ? SELVEDGE_STATUS_INTERNAL : status;
}

static int expect(const char *what, selvedge_status expected, selvedge_status found) {
  if (found == expected) return 0;
  fprintf(stderr, "%s: %s\n", what, selvedge_status_string(found));
  return 1;
}

int main(void) {
  selvedge_detector *with_threads = NULL, *without = NULL;
  int faults = expect("new", SELVEDGE_STATUS_OK, selvedge_detector_new(SELVEDGE_SCALAR_F64, 6, TRIANGLES, 2, &with_threads));
  faults += expect("new", SELVEDGE_STATUS_OK, selvedge_detector_new(SELVEDGE_SCALAR_F64, 6, TRIANGLES, 2, &without));
  faults += expect("threads", SELVEDGE_STATUS_OK, selvedge_detector_set_threads(with_threads, 3));
  faults += expect("ask", SELVEDGE_STATUS_OK, ask(with_threads));

  pid_t child = fork();
  if (child == 0) {
    alarm(20); /* rather than to wait for threads that are not there */
    faults += expect("child, with threads", SELVEDGE_STATUS_FORKED, ask(with_threads));
    faults += expect("child, without", SELVEDGE_STATUS_OK, ask(without));
    faults += expect("child, free", SELVEDGE_STATUS_OK, selvedge_detector_free(with_threads));
    faults += expect("child, free", SELVEDGE_STATUS_OK, selvedge_detector_free(without));
    _exit(faults);
  }
  int status = 1;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0) faults++;
  faults += expect("parent", SELVEDGE_STATUS_OK, ask(with_threads));
  faults += expect("free", SELVEDGE_STATUS_OK, selvedge_detector_free(with_threads));
  faults += expect("free", SELVEDGE_STATUS_OK, selvedge_detector_free(without));
  return faults == 0 ? 0 : 1;
}
