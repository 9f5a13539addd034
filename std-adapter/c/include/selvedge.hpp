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

/// A call that failed. It has changed nothing.
class error : public std::runtime_error {
 public:
  error(selvedge_status status, const std::string &words) : std::runtime_error(words), status_(status) {}

  /// Why, as a number.
  selvedge_status status() const noexcept { return status_; }

 private:
  selvedge_status status_;
};

/// Throws what the last call on this thread has to say, if it failed.
inline void check(selvedge_status status) {
  if (status != SELVEDGE_STATUS_OK) {
    throw error(status, std::string(selvedge_status_string(status)) + ": " + selvedge_last_error());
  }
}

/// A list that someone else owns: the function that returns it says how long it stays.
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

/// Groups of three numbers in a row, that the caller owns: positions or triangles. Made of a pointer and how many groups there
/// are, or of anything with data() and size() that holds the numbers, as std::vector.
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

/// Candidates of a step.
struct candidate_pairs {
  list<selvedge_pair> vertex_face;
  list<selvedge_pair> edge_edge;
};

/// Which pairs are not looked at. An empty list: no such rule.
struct collision_filter {
  /// For each vertex: two collide if each is in a group that the other's filter has.
  list<selvedge_groups> groups;
  /// For each vertex: two of one patch do not collide.
  list<std::uint32_t> patches;
  /// Two vertices that do not collide.
  list<selvedge_pair> excluded;
};

/// A mesh, and what is kept of it from step to step. `Scalar` is float or double, the format of the positions.
///
/// Can be moved, not copied. One thread at a time; another one gets SELVEDGE_STATUS_BUSY, but for set_cancelled. All functions
/// throw `error`.
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

  /// How many threads steps are split between: 1 is the one that calls, 0 one for each core.
  void set_threads(std::size_t count) { check(selvedge_detector_set_threads(get(), count)); }

  /// Contacts are pairs that may come closer than the separation; those that only come within the tolerance of it may be among them.
  void set_within(double separation, double tolerance) { check(selvedge_detector_set_within(get(), separation, tolerance)); }

  /// Contacts are only pairs that truly touch.
  void set_touching(double tolerance) { check(selvedge_detector_set_touching(get(), tolerance)); }

  /// Names the vertices that move: a byte that is not 0 for each that does.
  void set_moving(const std::uint8_t *moving, std::size_t count) { check(selvedge_detector_set_moving(get(), moving, count)); }

  /// All vertices move.
  void set_all_moving() { check(selvedge_detector_set_moving(get(), nullptr, 0)); }

  /// Which pairs are looked at from the next step on; `{}`: all of them. The lists are copied.
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

  /// Whether steps go on from one another.
  void set_coherent(bool coherent) { check(selvedge_detector_set_coherent(get(), coherent ? 1 : 0)); }

  /// Most pairs that a question may look at; UINT64_MAX: as many as there are.
  void set_pair_limit(std::uint64_t limit) { check(selvedge_detector_set_pair_limit(get(), limit)); }

  /// Cuts short the question that another thread is asking, and each one until it is taken back. For any thread at any time.
  void set_cancelled(bool cancelled) { check(selvedge_detector_set_cancelled(get(), cancelled ? 1 : 0)); }

  /// How many threads a step uses.
  std::size_t threads() const {
    std::size_t count = 0;
    check(selvedge_detector_threads(get(), &count));
    return count;
  }

  /// The edges by their numbers, each as its two vertices. They stay as long as the detector.
  list<selvedge_pair> edges() const {
    const selvedge_pair *first = nullptr;
    std::size_t count = 0;
    check(selvedge_detector_edges(get(), &first, &count));
    return {first, count};
  }

  /// All contacts of the step. They stay until this detector's contacts are asked for again, in either way, or it is gone.
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

  /// The contacts among pairs that the caller has. They stay as those of `contacts`.
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

  /// The earliest contact of the step, before which the step is free; none if the whole step is.
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

  /// Whether the step is certainly free of contact.
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

  /// How the two of each contact lie to each other at its time, in their order. They stay until this detector's contact
  /// geometries are asked for again, or it is gone.
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

  /// Lets each vertex go as far as its neighbourhood lets it: `end` becomes positions such that the step from `start` is free of
  /// contact, but for pairs that are in contact at the start. Anything with data() and size(), as std::vector, that has as many
  /// numbers as `start`; it may be one of the other two.
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

  /// The pairs that boxes leave. They stay until this detector's candidates are asked for again, or it is gone.
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

  /// All primitives that meet at rest, exactly. They stay until this detector's intersections are asked for again, or it is gone.
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

  /// Whether any primitives meet at rest.
  bool has_intersections(triples<Scalar> positions) {
    bool has_any = false;
    if constexpr (is_single) {
      check(selvedge_detector_has_intersections_f32(get(), positions.data(), positions.size(), &has_any));
    } else {
      check(selvedge_detector_has_intersections_f64(get(), positions.data(), positions.size(), &has_any));
    }
    return has_any;
  }

  /// All pairs within a distance of each other at rest, with their closest points. They stay until this detector is asked for
  /// what is near again, or it is gone. (`near` alone is a macro of Windows'.)
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

  /// For functions of selvedge.h; still owned here.
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

/// What moves in a step of a world, and how; all else rests. `Scalar` is the world's. The positions are the caller's, and have to stay
/// until the question is answered.
template <class Scalar>
class motions {
 public:
  using deforming_type = std::conditional_t<std::is_same_v<Scalar, float>, selvedge_deforming_f32, selvedge_deforming_f64>;

  /// Vertices go straight from their positions at the start to those at the end.
  motions &deforms(selvedge_mesh mesh, triples<Scalar> start, triples<Scalar> end) {
    if (start.size() != end.size()) {
      throw error(SELVEDGE_STATUS_WRONG_LENGTH, "the start frame has " + std::to_string(start.size()) +
                                                    " positions, the end frame " + std::to_string(end.size()));
    }
    deforming_.push_back({mesh, start.data(), end.data(), start.size()});
    return *this;
  }

  /// The mesh goes as one body from one pose to another, and turns the short way.
  motions &goes(selvedge_mesh mesh, const selvedge_pose &start, const selvedge_pose &end) {
    rigid_.push_back({mesh, start, end});
    return *this;
  }

  /// To be filled anew for another step.
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

/// Meshes that come and go, and move as they like. `Scalar` is float or double, the format of the positions.
///
/// Can be moved, not copied. One thread at a time, as for a detector. All functions throw `error`.
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

  /// How many threads steps are split between: 1 is the one that calls, 0 one for each core.
  void set_threads(std::size_t count) { check(selvedge_world_set_threads(get(), count)); }

  /// Contacts are pairs that may come closer than the separation; those that only come within the tolerance of it may be among them.
  void set_within(double separation, double tolerance) { check(selvedge_world_set_within(get(), separation, tolerance)); }

  /// Contacts are only pairs that truly touch.
  void set_touching(double tolerance) { check(selvedge_world_set_touching(get(), tolerance)); }

  /// Most pairs that a step may look at; UINT64_MAX: as many as there are.
  void set_pair_limit(std::uint64_t limit) { check(selvedge_world_set_pair_limit(get(), limit)); }

  /// Cuts short the step that another thread is asking about, and each one until it is taken back. For any thread at any time.
  void set_cancelled(bool cancelled) { check(selvedge_world_set_cancelled(get(), cancelled ? 1 : 0)); }

  /// A new mesh that rests at these positions. Its groups say which meshes it is looked at with, itself among them.
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

  /// Takes a mesh out. Its number then names nothing, for good.
  void remove(selvedge_mesh mesh) { check(selvedge_world_remove(get(), mesh)); }

  /// Which meshes this one is looked at with from now on, itself among them.
  void set_groups(selvedge_mesh mesh, const selvedge_groups &groups) { check(selvedge_world_set_groups(get(), mesh, &groups)); }

  /// The edges of a mesh by their numbers, each as its two vertices. They stay until the mesh is removed, or the world is gone.
  list<selvedge_pair> edges(selvedge_mesh mesh) const {
    const selvedge_pair *first = nullptr;
    std::size_t count = 0;
    check(selvedge_world_edges(get(), mesh, &first, &count));
    return {first, count};
  }

  /// All contacts of a step in which these meshes move, and all others rest. They stay until this world's contacts are asked for
  /// again, or it is gone.
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

  /// The earliest contact of such a step, before which it is free; none if the whole step is.
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

  /// Whether such a step is certainly free of contact.
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

  /// How the two of each contact of the last step lie to each other at its time, in their order. They stay until this world's
  /// contact geometries are asked for again, or it is gone.
  list<selvedge_world_geometry> contact_geometries(list<selvedge_world_contact> contacts) {
    const selvedge_world_geometry *first = nullptr;
    std::size_t count = 0;
    check(selvedge_world_contact_geometries(get(), contacts.data(), contacts.size(), &first, &count));
    return {first, count};
  }

  /// For functions of selvedge.h; still owned here.
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
