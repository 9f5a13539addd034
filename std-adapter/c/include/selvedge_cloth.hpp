/* Selvedge's cloth for C++17: selvedge_cloth.h with an owner and exceptions. Nothing is compiled into a library of its own. */

#ifndef SELVEDGE_CLOTH_HPP
#define SELVEDGE_CLOTH_HPP

#include "selvedge.hpp"
#include "selvedge_cloth.h"

namespace selvedge {

/// A scene of cloth in motion, of which no state ever has an intersection. What a scene may say stands in
/// std-adapter/cloth/scenes/README.md; all is in SI units.
///
/// Can be moved, not copied. One thread at a time, as for a detector. All functions throw `error`.
class simulation {
 public:
  /// Of a scene's text, on so many threads (0: one for each core): their number changes no bit of the result. Paths in the text are
  /// relative to the folder; an empty one is the process's own.
  explicit simulation(const std::string &scene, const std::string &folder = {}, std::size_t threads = 1) {
    selvedge_simulation *made = nullptr;
    check(selvedge_simulation_new(text(scene), text(folder), threads, &made));
    handle_.reset(made);
  }

  /// Of a scene file.
  static simulation read(const std::string &path, std::size_t threads = 1) {
    selvedge_simulation *made = nullptr;
    check(selvedge_simulation_read(text(path), threads, &made));
    return simulation(made);
  }

  /// Does one step. It throws SELVEDGE_STATUS_BLOCKED where the scene wants to stop; what is done of the step stays.
  void step() { check(selvedge_simulation_step(get())); }

  /// How much of what there is, which no step changes.
  selvedge_sizes sizes() const {
    selvedge_sizes sizes{};
    check(selvedge_simulation_sizes(get(), &sizes));
    return sizes;
  }

  /// How far it is, and whether its state is certified.
  selvedge_progress progress() const {
    selvedge_progress progress{};
    check(selvedge_simulation_progress(get(), &progress));
    return progress;
  }

  /// Where all vertices are, in metres: x y z of those of each cloth, then of bodies'.
  std::vector<double> positions() const { return copied<double>(selvedge_simulation_positions, sizes().vertex_count); }

  /// How fast all vertices move, in m/s.
  std::vector<double> velocities() const { return copied<double>(selvedge_simulation_velocities, sizes().vertex_count); }

  /// Which way the surface faces at each vertex, of length one.
  std::vector<double> normals() const { return copied<double>(selvedge_simulation_normals, sizes().vertex_count); }

  /// Three vertex numbers for each triangle. A step changes them only where cloth tears: then there are more vertices as well.
  std::vector<std::uint32_t> triangles() const {
    return copied<std::uint32_t>(selvedge_simulation_triangles, sizes().triangle_count);
  }

  /// Two vertex numbers for each edge that belongs to no triangle: of ropes, laces and fringes. A step changes them only where cloth tears.
  std::vector<std::uint32_t> loose_edges() const {
    return copied<std::uint32_t>(selvedge_simulation_loose_edges, sizes().loose_edge_count, 2);
  }

  /// The body of this name.
  selvedge_part body(const std::string &name) const {
    selvedge_part part{};
    check(selvedge_simulation_body(get(), text(name), &part));
    return part;
  }

  /// The cloth of this name.
  selvedge_part cloth(const std::string &name) const {
    selvedge_part part{};
    check(selvedge_simulation_cloth(get(), text(name), &part));
    return part;
  }

  /// The pairs that came near each other in the last step. They stay until they are asked for again, or the simulation is gone.
  list<selvedge_near_pair> near_pairs() {
    const selvedge_near_pair *first = nullptr;
    std::size_t count = 0;
    check(selvedge_simulation_near_pairs(get(), &first, &count));
    return {first, count};
  }

  /// Leads a driven body to another placement in the next step: its mesh as the scene has it, turned and then moved.
  void place_body(std::size_t body, const selvedge_pose &placement) {
    check(selvedge_simulation_place_body(get(), body, &placement));
  }

  /// Where a driven body stands now; none of any other, nor of one that was moved vertex by vertex.
  std::optional<selvedge_pose> placement(std::size_t body) const {
    bool is_known = false;
    selvedge_pose placement{};
    check(selvedge_simulation_placement(get(), body, &is_known, &placement));
    return is_known ? std::optional<selvedge_pose>(placement) : std::nullopt;
  }

  /// Leads each vertex of a driven body straight to a position in the next step.
  void move_body(std::size_t body, triples<double> positions) {
    check(selvedge_simulation_move_body(get(), body, positions.data(), positions.size()));
  }

  /// The same for a group of pins that is driven, by its number in the scene.
  void move_pins(std::size_t group, triples<double> positions) {
    check(selvedge_simulation_move_pins(get(), group, positions.data(), positions.size()));
  }

  /// Lets the wind that the scene has blow so from now on, in m/s.
  void set_wind(double x, double y, double z) { check(selvedge_simulation_set_wind(get(), x, y, z)); }

  /// All that the rest of the simulation depends on; every SELVEDGE_CHECKPOINT_STEPS steps.
  std::vector<std::uint8_t> checkpoint() {
    const std::uint8_t *first = nullptr;
    std::size_t count = 0;
    check(selvedge_simulation_checkpoint(get(), &first, &count));
    return {first, first + count};
  }

  /// Goes on from a checkpoint of the same scene, with the same bits as if that simulation had never ended.
  void resume(const std::vector<std::uint8_t> &checkpoint) {
    check(selvedge_simulation_resume(get(), checkpoint.data(), checkpoint.size()));
  }

  /// For functions of selvedge_cloth.h; still owned here.
  selvedge_simulation *get() const noexcept { return handle_.get(); }

 private:
  struct freed {
    void operator()(selvedge_simulation *handle) const noexcept { selvedge_simulation_free(handle); }
  };

  explicit simulation(selvedge_simulation *made) noexcept : handle_(made) {}

  /// To C a zero ends a text, wherever it is.
  static const char *text(const std::string &text) {
    if (text.find('\0') != std::string::npos) throw error(SELVEDGE_STATUS_BAD_TEXT, "a text has a zero before its end");
    return text.c_str();
  }

  template <class Number>
  std::vector<Number> copied(selvedge_status (*copy)(const selvedge_simulation *, Number *, std::size_t), std::size_t count,
                             std::size_t width = 3) const {
    std::vector<Number> numbers(width * count);
    check(copy(get(), numbers.data(), count));
    return numbers;
  }

  std::unique_ptr<selvedge_simulation, freed> handle_;
};

}  // namespace selvedge

#endif
