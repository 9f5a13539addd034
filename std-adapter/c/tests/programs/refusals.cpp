// Tests the additions of C++ to refusals.c: exceptions, owners that can be moved, frames of two lengths.
#include "expect.hpp"
#include <type_traits>
#include <utility>
#include <vector>

template <class Scalar>
static void try_all() {
  using detector = selvedge::detector<Scalar>;
  static_assert(!std::is_copy_constructible_v<detector> && std::is_nothrow_move_constructible_v<detector>);
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 3, 4, 5};
  const std::vector<Scalar> start = {-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, Scalar(0.2), 1, 0, Scalar(0.3), 0, 1, Scalar(0.4)};
  std::vector<Scalar> end = start;
  for (std::size_t k = 11; k < end.size(); k += 3) end[k] -= Scalar(0.4);

  expect(__LINE__, SELVEDGE_STATUS_VERTEX_OUT_OF_RANGE, [&] { detector(5, triangles); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { detector(6, std::vector<std::uint32_t>{0, 1}); });

  detector first(6, triangles);
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.contacts(start, {end.data(), 5}); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.is_free(std::vector<Scalar>(18 + 1), end); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.earliest({start.data(), 5}, {end.data(), 5}); });
  expect(__LINE__, SELVEDGE_STATUS_UNKNOWN_CONSTANT, [&] { first.candidates(start, end, static_cast<selvedge_boxes>(9)); });
  expect(__LINE__, SELVEDGE_STATUS_BAD_LIMIT, [&] { first.set_within(-1, 0); });

  // The detector still works after these errors.
  first.set_within(0, 1e-7);
  holds(__LINE__, first.contacts(start, end).size() >= 2 && !first.is_free(start, end) && first.is_free(start, start));
  holds(__LINE__, !first.earliest(start, start).has_value() && first.earliest(start, end)->pair.first == 3);
  const auto candidates = first.candidates(start, end);
  holds(__LINE__, first.contacts_of(start, end, candidates).size() == first.contacts(start, end).size());
  holds(__LINE__, first.edges().size() == 6 && first.edges()[0].first == 0 && first.edges()[0].second == 1);
  holds(__LINE__, !first.has_intersections(start) && first.intersections(start).empty() && first.has_intersections(end));
  holds(__LINE__, first.intersections(end)[0].kind == SELVEDGE_INTERSECTION_KIND_EDGE_FACE);
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.has_intersections({start.data(), 5}); });

  const auto contacts = first.contacts(start, end);
  const auto geometries = first.contact_geometries(start, end, contacts);
  holds(__LINE__, geometries.size() == contacts.size() && geometries[0].vertices[0] == contacts[0].vertices[0]);
  holds(__LINE__, first.near_pairs(start, 0.25).size() == 1 && first.near_pairs(start, 0.125).empty());
  expect(__LINE__, SELVEDGE_STATUS_BAD_LIMIT, [&] { first.near_pairs(start, -1); });
  std::vector<Scalar> free_end(start.size()), too_short(start.size() - 3);
  holds(__LINE__, first.truncate(start, end, free_end).held_back > 0 && first.is_free(start, free_end));
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.truncate(start, end, too_short); });
  std::vector<Scalar> in_place = end;
  first.truncate(start, in_place, in_place);
  holds(__LINE__, in_place == free_end);

  const std::vector<selvedge_groups> ghosts = {{1, 1}, {1, 1}, {1, 1}, {1, 0}, {1, 0}, {1, 0}};
  const std::uint32_t one_patch[6] = {0, 0, 0, 0, 0, 0};
  const selvedge_pair apart[] = {{3, 6}};
  first.set_collision_filter({{ghosts.data(), 6}, {}, {}});
  holds(__LINE__, first.is_free(start, end));
  expect(__LINE__, SELVEDGE_STATUS_VERTEX_OUT_OF_RANGE, [&] { first.set_collision_filter({{}, {}, {apart, 1}}); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.set_collision_filter({{ghosts.data(), 6}, {one_patch, 5}, {}}); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.set_collision_filter({{}, {one_patch, 5}, {}}); });
  first.set_collision_filter({{}, {one_patch, 6}, {}});
  holds(__LINE__, first.is_free(start, end));
  first.set_collision_filter({});
  holds(__LINE__, !first.is_free(start, end));

  first.set_pair_limit(1);
  expect(__LINE__, SELVEDGE_STATUS_TOO_MANY_PAIRS, [&] { first.contacts(start, end); });
  first.set_pair_limit(UINT64_MAX);
  first.set_memory_limit(1);
  expect(__LINE__, SELVEDGE_STATUS_TOO_MUCH_MEMORY, [&] { first.contacts(start, end); });
  first.set_memory_limit(UINT64_MAX);
  first.set_cancelled(true);
  expect(__LINE__, SELVEDGE_STATUS_CANCELLED, [&] { first.contacts(start, end); });
  first.set_cancelled(false);
  holds(__LINE__, !first.contacts(start, end).empty());
  first.set_touching(1e-7);
  first.set_coherent(true);
  first.set_threads(2);
  holds(__LINE__, first.threads() == 2 && !first.contacts(start, end).empty());

  const std::vector<std::uint8_t> moving(6, 0);
  first.set_moving(moving.data(), moving.size());
  holds(__LINE__, first.is_free(start, end));
  first.set_all_moving();
  holds(__LINE__, !first.is_free(start, end));

  detector second = std::move(first);
  holds(__LINE__, second.threads() == 2);
  expect(__LINE__, SELVEDGE_STATUS_NULL_POINTER, [&] { (void)first.threads(); });
  second = detector(6, triangles);
  holds(__LINE__, second.threads() == 1);
  selvedge_detector_free(second.get());
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_DETECTOR, [&] { second.set_threads(1); });
}

template <class Scalar>
static void try_worlds() {
  using world = selvedge::world<Scalar>;
  using motions = selvedge::motions<Scalar>;
  static_assert(!std::is_copy_constructible_v<world> && std::is_nothrow_move_constructible_v<world>);
  const std::vector<std::uint32_t> triangle = {0, 1, 2};
  const std::vector<Scalar> floor = {-5, -5, 0, 5, -5, 0, 0, 5, 0}, above = {0, 0, 1, 1, 0, 1, 0, 1, 1}, below = {0, 0, -1, 1, 0, -1, 0, 1, -1};
  world first;
  const auto ground = first.insert(triangle, floor), sheet = first.insert(triangle, above), gone = first.insert(triangle, above);
  first.remove(gone);
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_MESH, [&] { first.remove(gone); });
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_MESH, [&] { first.edges(gone); });
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_MESH, [&] { first.set_groups(gone, {1, 1}); });
  expect(__LINE__, SELVEDGE_STATUS_VERTEX_OUT_OF_RANGE, [&] { first.insert(std::vector<std::uint32_t>{0, 1, 3}, floor); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { motions().deforms(sheet, above, {below.data(), 2}); });
  expect(__LINE__, SELVEDGE_STATUS_BAD_LIMIT, [&] { first.set_within(-1, 0); });
  holds(__LINE__, first.edges(ground).size() == 3 && first.is_free({}));

  const auto falls = motions().deforms(sheet, above, below);
  const auto contacts = first.contacts(falls);
  holds(__LINE__, contacts.size() == 3 && contacts[0].meshes[0] == sheet && contacts[0].meshes[1] == ground);
  const auto geometries = first.contact_geometries(contacts);
  holds(__LINE__, geometries.size() == 3 && geometries[0].geometry.normal[2] == 1 && geometries[0].geometry.speed == -2);
  holds(__LINE__, !first.is_free(falls) && first.earliest(falls)->contact.time <= 0.5);

  const selvedge_pose here = {{0, 0, 0, 1}, {0, 0, 0}}, down = {{0, 0, 0, 1}, {0, 0, -2}}, none = {{0, 0, 0, 0}, {0, 0, 0}};
  auto goes = motions().goes(sheet, here, down);
  holds(__LINE__, first.contacts(goes).size() == 3);
  expect(__LINE__, SELVEDGE_STATUS_MOVED_TWICE, [&] { first.contacts(goes.deforms(sheet, above, below)); });
  goes.clear();
  expect(__LINE__, SELVEDGE_STATUS_BAD_POSE, [&] { first.is_free(goes.goes(sheet, here, none)); });

  first.set_groups(sheet, {2, 2});
  first.set_groups(ground, {1, 1});
  holds(__LINE__, first.is_free(falls));
  first.set_groups(ground, {UINT32_MAX, UINT32_MAX});
  first.set_groups(sheet, {UINT32_MAX, UINT32_MAX});
  first.set_threads(2);
  first.set_touching(1e-7);
  first.set_pair_limit(0);
  expect(__LINE__, SELVEDGE_STATUS_TOO_MANY_PAIRS, [&] { first.contacts(falls); });
  first.set_pair_limit(UINT64_MAX);
  first.set_cancelled(true);
  expect(__LINE__, SELVEDGE_STATUS_CANCELLED, [&] { first.contacts(falls); });
  first.set_cancelled(false);
  world second = std::move(first);
  holds(__LINE__, second.contacts(falls).size() == 3);
  expect(__LINE__, SELVEDGE_STATUS_NULL_POINTER, [&] { first.remove(sheet); });
  selvedge_world_free(second.get());
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_WORLD, [&] { second.set_threads(1); });
}

int main() {
  try_all<float>();
  try_all<double>();
  try_worlds<float>();
  try_worlds<double>();
  return faults == 0 ? 0 : 1;
}
