// Counts the failures of tests in C++: calls that should have failed, and conditions that should hold.
#pragma once
#include <cstdio>
#include <selvedge.hpp>

static int faults = 0;

template <class Action>
static void expect(int line, selvedge_status status, Action action) {
  try {
    action();
  } catch (const selvedge::error &failed) {
    if (failed.status() == status && *failed.what()) return;
    std::fprintf(stderr, "line %d: not that, but: %s\n", line, failed.what());
    faults++;
    return;
  }
  std::fprintf(stderr, "line %d: nothing was thrown\n", line);
  faults++;
}

static void holds(int line, bool condition) {
  if (condition) return;
  std::fprintf(stderr, "line %d: not so\n", line);
  faults++;
}
