/* Selvedge for C++17: selvedge.h with owners and exceptions. Nothing is compiled into a library of its own. */

#ifndef SELVEDGE_HPP
#define SELVEDGE_HPP

#include "selvedge.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace selvedge {

/// A failed call. It has changed nothing.
class error : public std::runtime_error {
 public:
  error(selvedge_status status, const std::string &words) : std::runtime_error(words), status_(status) {}

  /// The status of the call.
  selvedge_status status() const noexcept { return status_; }

 private:
  selvedge_status status_;
};

/// Throws an `error` with the last message of this thread if the call failed.
inline void check(selvedge_status status) {
  if (status != SELVEDGE_STATUS_OK) {
    throw error(status, std::string(selvedge_status_string(status)) + ": " + selvedge_last_error());
  }
}

/// A view of a list with another owner. The function that returns it says how long it stays valid.
template <class T>
class list {
 public:
  list() = default;
  list(const T *first, std::size_t count) noexcept : first_(first), count_(count) {}

  const T *data() const noexcept { return first_; }
  const T *begin() const noexcept { return first_; }
  const T *end() const noexcept { return first_ + count_; }
  std::size_t size() const noexcept { return count_; }
  bool empty() const noexcept { return count_ == 0; }
  const T &operator[](std::size_t index) const noexcept { return first_[index]; }

 private:
  const T *first_ = nullptr;
  std::size_t count_ = 0;
};

/// A view of the caller's positions or triangles: groups of three numbers. Construct it from a pointer and the number of groups,
/// or from a container of numbers with data() and size(), such as std::vector.
template <class T>
class triples {
 public:
  triples(const T *first, std::size_t count) noexcept : first_(first), count_(count) {}

  template <class Numbers, class = std::enable_if_t<std::is_same_v<decltype(std::declval<const Numbers &>().data()), const T *>>>
  triples(const Numbers &numbers) : first_(numbers.data()), count_(numbers.size() / 3) {
    if (numbers.size() % 3 != 0) {
      throw error(SELVEDGE_STATUS_WRONG_LENGTH, std::to_string(numbers.size()) + " numbers are not three for each");
    }
  }

  const T *data() const noexcept { return first_; }
  std::size_t size() const noexcept { return count_; }

 private:
  const T *first_;
  std::size_t count_;
};

/// The candidates of a step.
struct candidate_pairs {
  list<selvedge_pair> vertex_face;
  list<selvedge_pair> edge_edge;
};

/// The pairs to skip. An empty list omits its rule.
struct collision_filter {
  /// One entry per vertex: two vertices collide if each is in a group of the other's filter.
  list<selvedge_groups> groups;
  /// One entry per vertex: two vertices of the same patch do not collide.
  list<std::uint32_t> patches;
  /// Pairs of vertices that do not collide.
  list<selvedge_pair> excluded;
};

/// A detector for one mesh. `Scalar` is float or double, the format of the positions.
///
/// It can be moved but not copied. One thread at a time may use it; another one gets SELVEDGE_STATUS_BUSY, except for
/// set_cancelled. All functions throw `error`.
template <class Scalar>
class detector {
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>, "positions are float or double");
  static constexpr bool is_single = std::is_same_v<Scalar, float>;

 public:
  detector(std::size_t vertex_count, triples<std::uint32_t> triangles) {
    selvedge_detector *made = nullptr;
    const std::uint32_t scalar = is_single ? SELVEDGE_SCALAR_F32 : SELVEDGE_SCALAR_F64;
    check(selvedge_detector_new(scalar, vertex_count, triangles.data(), triangles.size(), &made));
    handle_.reset(made);
  }

  /// Sets the number of threads of a step: 1 is the calling thread, 0 one for each core.
  void set_threads(std::size_t count) { check(selvedge_detector_set_threads(get(), count)); }

  /// Reports pairs that may come within the separation of each other; a pair within separation + tolerance may be among them.
  void set_within(double separation, double tolerance) { check(selvedge_detector_set_within(get(), separation, tolerance)); }

  /// Reports only pairs that truly touch.
  void set_touching(double tolerance) { check(selvedge_detector_set_touching(get(), tolerance)); }

  /// Names the moving vertices: a byte for each vertex, not 0 if it moves.
  void set_moving(const std::uint8_t *moving, std::size_t count) { check(selvedge_detector_set_moving(get(), moving, count)); }

  /// Lets all vertices move.
  void set_all_moving() { check(selvedge_detector_set_moving(get(), nullptr, 0)); }

  /// Sets the pairs to skip from the next step on; `{}`: none. The lists are copied.
  void set_collision_filter(const collision_filter &filter) {
    const auto &[groups, patches, excluded] = filter;
    if (!groups.empty() && !patches.empty() && groups.size() != patches.size()) {
      throw error(SELVEDGE_STATUS_WRONG_LENGTH, "there are " + std::to_string(groups.size()) + " groups, but " +
                                                    std::to_string(patches.size()) + " patches");
    }
    check(selvedge_detector_set_collision_filter(get(), groups.empty() ? nullptr : groups.data(),
                                                 patches.empty() ? nullptr : patches.data(),
                                                 groups.empty() ? patches.size() : groups.size(), excluded.data(),
                                                 excluded.size()));
  }

  /// Sets whether each step starts where the last one ended; such steps are faster.
  void set_coherent(bool coherent) { check(selvedge_detector_set_coherent(get(), coherent ? 1 : 0)); }

  /// Limits the number of candidate pairs of a call; UINT64_MAX: no limit.
  void set_pair_limit(std::uint64_t limit) { check(selvedge_detector_set_pair_limit(get(), limit)); }

  /// Limits the memory of the pairs and contacts of a call, in bytes; UINT64_MAX: no limit.
  void set_memory_limit(std::uint64_t limit) { check(selvedge_detector_set_memory_limit(get(), limit)); }

  /// Cancels the call of another thread and all later calls, until this is called with false. Any thread may call it at any time.
  void set_cancelled(bool cancelled) { check(selvedge_detector_set_cancelled(get(), cancelled ? 1 : 0)); }

  /// Returns the number of threads of a step.
  std::size_t threads() const {
    std::size_t count = 0;
    check(selvedge_detector_threads(get(), &count));
    return count;
  }

  /// Returns the edges in the order of their numbers, each as its two vertices. The list lives as long as the detector.
  list<selvedge_pair> edges() const {
    const selvedge_pair *first = nullptr;
    std::size_t count = 0;
    check(selvedge_detector_edges(get(), &first, &count));
    return {first, count};
  }

  /// Finds all contacts of the step. The list is valid until the next search for contacts with this detector, or its end.
  list<selvedge_contact> contacts(triples<Scalar> start, triples<Scalar> end) {
    const selvedge_contact *first = nullptr;
    std::size_t count = 0;
    const std::size_t vertices = common_size(start, end);
    if constexpr (is_single) {
      check(selvedge_detector_contacts_f32(get(), start.data(), end.data(), vertices, &first, &count));
    } else {
      check(selvedge_detector_contacts_f64(get(), start.data(), end.data(), vertices, &first, &count));
    }
    return {first, count};
  }

  /// Finds the contacts among the given pairs. The list is valid as for `contacts`.
  list<selvedge_contact> contacts_of(triples<Scalar> start, triples<Scalar> end, const candidate_pairs &pairs) {
    const selvedge_contact *first = nullptr;
    std::size_t count = 0;
    const std::size_t vertices = common_size(start, end);
    const auto &[vf, ee] = pairs;
    if constexpr (is_single) {
      check(selvedge_detector_contacts_of_f32(get(), start.data(), end.data(), vertices, vf.data(), vf.size(), ee.data(),
                                              ee.size(), &first, &count));
    } else {
      check(selvedge_detector_contacts_of_f64(get(), start.data(), end.data(), vertices, vf.data(), vf.size(), ee.data(),
                                              ee.size(), &first, &count));
    }
    return {first, count};
  }

  /// Finds the earliest contact; the step is free before its time. Returns none if the whole step is free.
  std::optional<selvedge_contact> earliest(triples<Scalar> start, triples<Scalar> end) {
    bool found = false;
    selvedge_contact contact{};
    const std::size_t vertices = common_size(start, end);
    if constexpr (is_single) {
      check(selvedge_detector_earliest_f32(get(), start.data(), end.data(), vertices, &found, &contact));
    } else {
      check(selvedge_detector_earliest_f64(get(), start.data(), end.data(), vertices, &found, &contact));
    }
    return found ? std::optional<selvedge_contact>(contact) : std::nullopt;
  }

  /// Decides whether the step is certainly free of contact.
  bool is_free(triples<Scalar> start, triples<Scalar> end) {
    bool free = false;
    const std::size_t vertices = common_size(start, end);
    if constexpr (is_single) {
      check(selvedge_detector_is_free_f32(get(), start.data(), end.data(), vertices, &free));
    } else {
      check(selvedge_detector_is_free_f64(get(), start.data(), end.data(), vertices, &free));
    }
    return free;
  }

  /// Computes the geometry of each contact at its time, in the same order. The list is valid until the next call for this
  /// detector, or its end.
  list<selvedge_geometry> contact_geometries(triples<Scalar> start, triples<Scalar> end, list<selvedge_contact> contacts) {
    const selvedge_geometry *first = nullptr;
    std::size_t count = 0;
    const std::size_t vertices = common_size(start, end);
    if constexpr (is_single) {
      check(selvedge_detector_contact_geometries_f32(get(), start.data(), end.data(), vertices, contacts.data(),
                                                     contacts.size(), &first, &count));
    } else {
      check(selvedge_detector_contact_geometries_f64(get(), start.data(), end.data(), vertices, contacts.data(),
                                                     contacts.size(), &first, &count));
    }
    return {first, count};
  }

  /// Moves each vertex as far as its neighbourhood allows. The step from `start` to `end` is free of contact, except for pairs in
  /// contact at the start. `end` is a container with data() and size(), such as std::vector, with as many numbers as `start`; it
  /// may be one of the other two.
  template <class Numbers>
  selvedge_truncation truncate(triples<Scalar> start, triples<Scalar> wanted, Numbers &end) {
    selvedge_truncation truncation{};
    const std::size_t vertices = common_size(start, wanted);
    if (triples<Scalar>(end).size() != vertices) {
      throw error(SELVEDGE_STATUS_WRONG_LENGTH, "there is room for " + std::to_string(end.size()) + " numbers, not for " +
                                                    std::to_string(vertices) + " positions");
    }
    if constexpr (is_single) {
      check(selvedge_detector_truncate_f32(get(), start.data(), wanted.data(), vertices, end.data(), &truncation));
    } else {
      check(selvedge_detector_truncate_f64(get(), start.data(), wanted.data(), vertices, end.data(), &truncation));
    }
    return truncation;
  }

  /// Finds the pairs that bounding boxes keep. The lists are valid until the next call for this detector, or its end.
  candidate_pairs candidates(triples<Scalar> start, triples<Scalar> end, selvedge_boxes boxes = SELVEDGE_BOXES_MOVING) {
    const selvedge_pair *vf = nullptr, *ee = nullptr;
    std::size_t vf_count = 0, ee_count = 0;
    const std::size_t vertices = common_size(start, end);
    if constexpr (is_single) {
      check(selvedge_detector_candidates_f32(get(), start.data(), end.data(), vertices, boxes, &vf, &vf_count, &ee, &ee_count));
    } else {
      check(selvedge_detector_candidates_f64(get(), start.data(), end.data(), vertices, boxes, &vf, &vf_count, &ee, &ee_count));
    }
    return {{vf, vf_count}, {ee, ee_count}};
  }

  /// Finds all intersections at rest, exactly. The list is valid until the next call for this detector, or its end.
  list<selvedge_intersection> intersections(triples<Scalar> positions) {
    const selvedge_intersection *first = nullptr;
    std::size_t count = 0;
    if constexpr (is_single) {
      check(selvedge_detector_intersections_f32(get(), positions.data(), positions.size(), &first, &count));
    } else {
      check(selvedge_detector_intersections_f64(get(), positions.data(), positions.size(), &first, &count));
    }
    return {first, count};
  }

  /// Decides whether there is any intersection at rest.
  bool has_intersections(triples<Scalar> positions) {
    bool has_any = false;
    if constexpr (is_single) {
      check(selvedge_detector_has_intersections_f32(get(), positions.data(), positions.size(), &has_any));
    } else {
      check(selvedge_detector_has_intersections_f64(get(), positions.data(), positions.size(), &has_any));
    }
    return has_any;
  }

  /// Finds all pairs within a distance of each other at rest, with their closest points. The list is valid until the next call
  /// for this detector, or its end. (The name is not `near`, which is a macro on Windows.)
  list<selvedge_geometry> near_pairs(triples<Scalar> positions, double distance) {
    const selvedge_geometry *first = nullptr;
    std::size_t count = 0;
    if constexpr (is_single) {
      check(selvedge_detector_near_f32(get(), positions.data(), positions.size(), distance, &first, &count));
    } else {
      check(selvedge_detector_near_f64(get(), positions.data(), positions.size(), distance, &first, &count));
    }
    return {first, count};
  }

  /// Returns the handle for functions of selvedge.h. This object still owns it.
  selvedge_detector *get() const noexcept { return handle_.get(); }

 private:
  struct freed {
    void operator()(selvedge_detector *handle) const noexcept { selvedge_detector_free(handle); }
  };

  static std::size_t common_size(const triples<Scalar> &start, const triples<Scalar> &end) {
    if (start.size() != end.size()) {
      throw error(SELVEDGE_STATUS_WRONG_LENGTH, "the start frame has " + std::to_string(start.size()) +
                                                    " positions, the end frame " + std::to_string(end.size()));
    }
    return start.size();
  }

  std::unique_ptr<selvedge_detector, freed> handle_;
};

/// The motions of a step of a world; meshes without a motion rest. `Scalar` is that of the world. The caller owns the positions
/// and keeps them until the call returns.
template <class Scalar>
class motions {
 public:
  using deforming_type = std::conditional_t<std::is_same_v<Scalar, float>, selvedge_deforming_f32, selvedge_deforming_f64>;

  /// Moves the vertices straight from their positions at the start to those at the end.
  motions &deforms(selvedge_mesh mesh, triples<Scalar> start, triples<Scalar> end) {
    if (start.size() != end.size()) {
      throw error(SELVEDGE_STATUS_WRONG_LENGTH, "the start frame has " + std::to_string(start.size()) +
                                                    " positions, the end frame " + std::to_string(end.size()));
    }
    deforming_.push_back({mesh, start.data(), end.data(), start.size()});
    return *this;
  }

  /// Moves the mesh as a rigid body from one pose to another; it rotates the short way.
  motions &goes(selvedge_mesh mesh, const selvedge_pose &start, const selvedge_pose &end) {
    rigid_.push_back({mesh, start, end});
    return *this;
  }

  /// Removes all motions, for another step.
  void clear() noexcept {
    deforming_.clear();
    rigid_.clear();
  }

  const std::vector<deforming_type> &deforming() const noexcept { return deforming_; }
  const std::vector<selvedge_rigid> &rigid() const noexcept { return rigid_; }

 private:
  std::vector<deforming_type> deforming_;
  std::vector<selvedge_rigid> rigid_;
};

/// A world of meshes that come and go and move independently. `Scalar` is float or double, the format of the positions.
///
/// It can be moved but not copied. One thread at a time may use it, as for a detector. All functions throw `error`.
template <class Scalar>
class world {
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>, "positions are float or double");
  static constexpr bool is_single = std::is_same_v<Scalar, float>;

 public:
  world() {
    selvedge_world *made = nullptr;
    check(selvedge_world_new(is_single ? SELVEDGE_SCALAR_F32 : SELVEDGE_SCALAR_F64, &made));
    handle_.reset(made);
  }

  /// Sets the number of threads of a step: 1 is the calling thread, 0 one for each core.
  void set_threads(std::size_t count) { check(selvedge_world_set_threads(get(), count)); }

  /// Reports pairs that may come within the separation of each other; a pair within separation + tolerance may be among them.
  void set_within(double separation, double tolerance) { check(selvedge_world_set_within(get(), separation, tolerance)); }

  /// Reports only pairs that truly touch.
  void set_touching(double tolerance) { check(selvedge_world_set_touching(get(), tolerance)); }

  /// Limits the number of candidate pairs of a step; UINT64_MAX: no limit.
  void set_pair_limit(std::uint64_t limit) { check(selvedge_world_set_pair_limit(get(), limit)); }

  /// Limits the memory of the contacts of a step, in bytes; UINT64_MAX: no limit.
  void set_memory_limit(std::uint64_t limit) { check(selvedge_world_set_memory_limit(get(), limit)); }

  /// Cancels the call of another thread and all later calls, until this is called with false. Any thread may call it at any time.
  void set_cancelled(bool cancelled) { check(selvedge_world_set_cancelled(get(), cancelled ? 1 : 0)); }

  /// Inserts a mesh that rests at these positions. The groups say which meshes it can collide with, itself included.
  selvedge_mesh insert(triples<std::uint32_t> triangles, triples<Scalar> positions,
                       const selvedge_groups &groups = {UINT32_MAX, UINT32_MAX}) {
    selvedge_mesh mesh = 0;
    if constexpr (is_single) {
      check(selvedge_world_insert_f32(get(), positions.size(), triangles.data(), triangles.size(), positions.data(), &groups, &mesh));
    } else {
      check(selvedge_world_insert_f64(get(), positions.size(), triangles.data(), triangles.size(), positions.data(), &groups, &mesh));
    }
    return mesh;
  }

  /// Removes a mesh. Its number is never used again.
  void remove(selvedge_mesh mesh) { check(selvedge_world_remove(get(), mesh)); }

  /// Sets which meshes this one can collide with from now on, itself included.
  void set_groups(selvedge_mesh mesh, const selvedge_groups &groups) { check(selvedge_world_set_groups(get(), mesh, &groups)); }

  /// Returns the edges of a mesh, each as its two vertices. The list is valid until the mesh is removed, or the world's end.
  list<selvedge_pair> edges(selvedge_mesh mesh) const {
    const selvedge_pair *first = nullptr;
    std::size_t count = 0;
    check(selvedge_world_edges(get(), mesh, &first, &count));
    return {first, count};
  }

  /// Finds all contacts of a step in which these meshes move and all others rest. The list is valid until the next search for
  /// contacts in this world, or its end.
  list<selvedge_world_contact> contacts(const motions<Scalar> &moving) {
    const selvedge_world_contact *first = nullptr;
    std::size_t count = 0;
    const auto &[deforming, rigid] = parts(moving);
    if constexpr (is_single) {
      check(selvedge_world_contacts_f32(get(), deforming.data(), deforming.size(), rigid.data(), rigid.size(), &first, &count));
    } else {
      check(selvedge_world_contacts_f64(get(), deforming.data(), deforming.size(), rigid.data(), rigid.size(), &first, &count));
    }
    return {first, count};
  }

  /// Finds the earliest contact; the step is free before its time. Returns none if the whole step is free.
  std::optional<selvedge_world_contact> earliest(const motions<Scalar> &moving) {
    bool found = false;
    selvedge_world_contact contact{};
    const auto &[deforming, rigid] = parts(moving);
    if constexpr (is_single) {
      check(selvedge_world_earliest_f32(get(), deforming.data(), deforming.size(), rigid.data(), rigid.size(), &found, &contact));
    } else {
      check(selvedge_world_earliest_f64(get(), deforming.data(), deforming.size(), rigid.data(), rigid.size(), &found, &contact));
    }
    return found ? std::optional<selvedge_world_contact>(contact) : std::nullopt;
  }

  /// Decides whether such a step is certainly free of contact.
  bool is_free(const motions<Scalar> &moving) {
    bool free = false;
    const auto &[deforming, rigid] = parts(moving);
    if constexpr (is_single) {
      check(selvedge_world_is_free_f32(get(), deforming.data(), deforming.size(), rigid.data(), rigid.size(), &free));
    } else {
      check(selvedge_world_is_free_f64(get(), deforming.data(), deforming.size(), rigid.data(), rigid.size(), &free));
    }
    return free;
  }

  /// Computes the geometry of each contact of the last step at its time, in the same order. The list is valid until the next call
  /// for this world, or its end.
  list<selvedge_world_geometry> contact_geometries(list<selvedge_world_contact> contacts) {
    const selvedge_world_geometry *first = nullptr;
    std::size_t count = 0;
    check(selvedge_world_contact_geometries(get(), contacts.data(), contacts.size(), &first, &count));
    return {first, count};
  }

  /// Returns the handle for functions of selvedge.h. This object still owns it.
  selvedge_world *get() const noexcept { return handle_.get(); }

 private:
  struct freed {
    void operator()(selvedge_world *handle) const noexcept { selvedge_world_free(handle); }
  };

  static auto parts(const motions<Scalar> &moving) { return std::tie(moving.deforming(), moving.rigid()); }

  std::unique_ptr<selvedge_world, freed> handle_;
};

}  // namespace selvedge

#endif
