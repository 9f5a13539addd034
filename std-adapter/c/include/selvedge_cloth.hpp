/* Selvedge's cloth for C++17: selvedge_cloth.h with an owner and exceptions. Nothing is compiled into a library of its own. */

#ifndef SELVEDGE_CLOTH_HPP
#define SELVEDGE_CLOTH_HPP

#include "selvedge.hpp"
#include "selvedge_cloth.h"

#include <array>

namespace selvedge {

/// A mesh: x y z of each vertex, three vertices of each triangle, two of each loose edge, and the vertices that are particles.
struct mesh_lists {
  explicit mesh_lists(const selvedge_mesh_lists &lists)
      : positions(lists.positions, lists.positions + 3 * lists.vertex_count),
        triangles(lists.triangles, lists.triangles + 3 * lists.triangle_count),
        loose_edges(lists.loose_edges, lists.loose_edges + 2 * lists.loose_edge_count),
        points(lists.points, lists.points + lists.point_count) {}

  std::vector<double> positions;
  std::vector<std::uint32_t> triangles, loose_edges, points;
};

namespace detail {

/// Rejects a text with a zero inside, since C would end it there.
inline const char *text(const std::string &text) {
  if (text.find('\0') != std::string::npos) throw error(SELVEDGE_STATUS_BAD_TEXT, "a text has a zero before its end");
  return text.c_str();
}

}  // namespace detail

/// A mesh that was read from a file, with the file's numbers and unit.
struct mesh_file {
  /// Reads OBJ, PLY, STL or OFF, by the extension. It throws `error` with SELVEDGE_STATUS_BAD_FILE and a message that names the
  /// place.
  static mesh_file read(const std::string &path) {
    selvedge_file *made = nullptr;
    check(selvedge_file_new(detail::text(path), &made));
    const std::unique_ptr<selvedge_file, selvedge_status (*)(selvedge_file *)> owner(made, selvedge_file_free);
    selvedge_mesh_lists lists{};
    const char *missing = nullptr, *notes = nullptr;
    check(selvedge_file_mesh(made, &lists, &missing, &notes));
    return {mesh_lists(lists), missing ? std::optional<std::string>(missing) : std::nullopt, notes};
  }

  mesh_lists mesh;
  /// Parts that may have an area and were not read. With such parts, contacts of this mesh are not all contacts of the file.
  std::optional<std::string> missing;
  /// One line of counts, and of what was split or left out.
  std::string notes;
};

/// A simulation of cloth whose states never intersect. std-adapter/cloth/scenes/README.md describes scenes. All numbers are in SI
/// units.
///
/// It can be moved but not copied. One thread at a time may use it, as for a detector. All functions throw `error`.
class simulation {
 public:
  /// Creates a simulation from the text of a scene. The number of threads (0: one for each core) changes no bit of the result.
  /// Paths in the text are relative to the folder; an empty one is the current folder.
  explicit simulation(const std::string &scene, const std::string &folder = {}, std::size_t threads = 1) {
    selvedge_simulation *made = nullptr;
    check(selvedge_simulation_new(text(scene), text(folder), threads, &made));
    handle_.reset(made);
  }

  /// Creates a simulation from a scene file.
  static simulation read(const std::string &path, std::size_t threads = 1) {
    selvedge_simulation *made = nullptr;
    check(selvedge_simulation_read(text(path), threads, &made));
    return simulation(made);
  }

  /// Runs one step. It throws SELVEDGE_STATUS_BLOCKED if the scene stops there; the part of the step that was done remains.
  void step() { check(selvedge_simulation_step(get())); }

  /// Runs a frame of so many seconds, in as many steps as the cloth needs, at least one and at most `most`. It throws
  /// SELVEDGE_STATUS_BAD_VALUE if the time is not from a microsecond to a second, and otherwise as step.
  selvedge_frame advance(double seconds, std::uint32_t most = 64) {
    selvedge_frame frame{};
    check(selvedge_simulation_advance(get(), seconds, most, &frame));
    return frame;
  }

  /// Returns the sizes of the scene. Only tearing changes them.
  selvedge_sizes sizes() const {
    selvedge_sizes sizes{};
    check(selvedge_simulation_sizes(get(), &sizes));
    return sizes;
  }

  /// Returns the progress and whether the state is certified.
  selvedge_progress progress() const {
    selvedge_progress progress{};
    check(selvedge_simulation_progress(get(), &progress));
    return progress;
  }

  /// Returns the positions of all vertices in metres: x y z, first of the cloths, then of the bodies.
  std::vector<double> positions() const { return copied<double>(selvedge_simulation_positions, sizes().vertex_count); }

  /// Returns the velocities of all vertices in m/s.
  std::vector<double> velocities() const { return copied<double>(selvedge_simulation_velocities, sizes().vertex_count); }

  /// Returns the normal of the surface at each vertex, of length one.
  std::vector<double> normals() const { return copied<double>(selvedge_simulation_normals, sizes().vertex_count); }

  /// Returns three vertex numbers for each triangle. Only tearing changes them; it also adds vertices.
  std::vector<std::uint32_t> triangles() const {
    return copied<std::uint32_t>(selvedge_simulation_triangles, sizes().triangle_count);
  }

  /// Returns two vertex numbers for each loose edge (ropes, laces and fringes). Only tearing changes them.
  std::vector<std::uint32_t> loose_edges() const {
    return copied<std::uint32_t>(selvedge_simulation_loose_edges, sizes().loose_edge_count, 2);
  }

  /// Returns the state as one mesh in which cloths from files have the vertices and faces of their files.
  mesh_lists mesh_in_files() { return in_files().first; }

  /// Returns the number in that mesh of each of the simulation's vertices.
  std::vector<std::uint32_t> numbers_in_files() { return in_files().second; }

  /// Finds the body of this name.
  selvedge_part body(const std::string &name) const {
    selvedge_part part{};
    check(selvedge_simulation_body(get(), text(name), &part));
    return part;
  }

  /// Finds the cloth of this name.
  selvedge_part cloth(const std::string &name) const {
    selvedge_part part{};
    check(selvedge_simulation_cloth(get(), text(name), &part));
    return part;
  }

  /// Returns the near pairs of the last step. The list is valid until the next call, or the end of the simulation.
  list<selvedge_near_pair> near_pairs() {
    const selvedge_near_pair *first = nullptr;
    std::size_t count = 0;
    check(selvedge_simulation_near_pairs(get(), &first, &count));
    return {first, count};
  }

  /// Moves a driven body to a placement in the next step: its mesh in the scene is rotated and then translated.
  void place_body(std::size_t body, const selvedge_pose &placement) {
    check(selvedge_simulation_place_body(get(), body, &placement));
  }

  /// Returns the placement of a driven or free body; none for other bodies and for one that was moved vertex by vertex.
  std::optional<selvedge_pose> placement(std::size_t body) const {
    bool is_known = false;
    selvedge_pose placement{};
    check(selvedge_simulation_placement(get(), body, &is_known, &placement));
    return is_known ? std::optional<selvedge_pose>(placement) : std::nullopt;
  }

  /// Returns the mass and the present motion of a free body; none for any other body.
  std::optional<selvedge_free_body_state> body_motion(std::size_t body) const {
    bool is_free = false;
    selvedge_free_body_state state{};
    check(selvedge_simulation_body_motion(get(), body, &is_free, &state));
    return is_free ? std::optional<selvedge_free_body_state>(state) : std::nullopt;
  }

  /// Says where another engine has brought the body of a proxy in the time of the next step or frame. The proxy goes there, and
  /// yields to cloth on the way. Then give the engine's body its `placement` and the impulse of its `proxy_load`.
  void bring_body(std::size_t body, const selvedge_brought_body &to) { check(selvedge_simulation_bring_body(get(), body, &to)); }

  /// Returns the mean load on a proxy in the last step or frame, with the torque about its centre of mass; none for any other
  /// body.
  std::optional<selvedge_wrench> proxy_load(std::size_t body) const {
    bool is_proxy = false;
    selvedge_wrench load{};
    check(selvedge_simulation_proxy_load(get(), body, &is_proxy, &load));
    return is_proxy ? std::optional<selvedge_wrench>(load) : std::nullopt;
  }

  /// Moves driven and free bodies, their pins and the cloth that hangs on them, and other cloths, elsewhere at once, without a
  /// step. `by` is applied to positions in the world.
  void teleport(const std::vector<std::size_t> &bodies, const selvedge_pose &by, const std::vector<std::size_t> &cloths = {}) {
    check(selvedge_simulation_teleport(get(), bodies.data(), bodies.size(), cloths.data(), cloths.size(), &by));
  }

  /// Moves each vertex of a driven body straight to a position in the next step.
  void move_body(std::size_t body, triples<double> positions) {
    check(selvedge_simulation_move_body(get(), body, positions.data(), positions.size()));
  }

  /// Moves each vertex of a driven group of pins in the next step. The group has its number in the scene.
  void move_pins(std::size_t group, triples<double> positions) {
    check(selvedge_simulation_move_pins(get(), group, positions.data(), positions.size()));
  }

  /// Sets the velocity of the scene's wind from now on, in m/s.
  void set_wind(double x, double y, double z) { check(selvedge_simulation_set_wind(get(), x, y, z)); }

  /// Adds a force in N, x y z, on each of these vertices of cloth, for the whole of the next step or frame. Then they are gone.
  /// It throws SELVEDGE_STATUS_WRONG_LENGTH unless there is one force for each vertex.
  void add_forces(const std::vector<std::uint32_t> &vertices, triples<double> forces) {
    if (forces.size() != vertices.size()) throw error(SELVEDGE_STATUS_WRONG_LENGTH, "each vertex needs one force");
    check(selvedge_simulation_add_forces(get(), vertices.data(), forces.data(), forces.size()));
  }

  /// Returns the load of cloth and ropes on a body at the end of the last step, with torques about a point.
  selvedge_body_load body_load(std::size_t body, const std::array<double, 3> &about = {}) const {
    return load<selvedge_body_load>(selvedge_simulation_body_load, body, about);
  }

  /// Returns the mean load on a body in the last step or frame.
  selvedge_body_load mean_body_load(std::size_t body, const std::array<double, 3> &about = {}) const {
    return load<selvedge_body_load>(selvedge_simulation_mean_body_load, body, about);
  }

  /// Returns the load on a group of pins at the end of the last step: what moves or holds them feels.
  selvedge_wrench pin_load(std::size_t group, const std::array<double, 3> &about = {}) const {
    return load<selvedge_wrench>(selvedge_simulation_pin_load, group, about);
  }

  /// Returns the mean load on a group of pins in the last step or frame.
  selvedge_wrench mean_pin_load(std::size_t group, const std::array<double, 3> &about = {}) const {
    return load<selvedge_wrench>(selvedge_simulation_mean_pin_load, group, about);
  }

  /// Returns the load on a group of attachments at the end of the last step.
  selvedge_wrench attachment_load(std::size_t group, const std::array<double, 3> &about = {}) const {
    return load<selvedge_wrench>(selvedge_simulation_attachment_load, group, about);
  }

  /// Returns the mean load on a group of attachments in the last step or frame.
  selvedge_wrench mean_attachment_load(std::size_t group, const std::array<double, 3> &about = {}) const {
    return load<selvedge_wrench>(selvedge_simulation_mean_attachment_load, group, about);
  }

  /// Returns the contacts that pushed a body in the last step. The list is valid until the next call.
  list<selvedge_contact_load> contact_loads(std::size_t body) {
    const selvedge_contact_load *first = nullptr;
    std::size_t count = 0;
    check(selvedge_simulation_contact_loads(get(), body, &first, &count));
    return {first, count};
  }

  /// Returns the state as bytes. A checkpoint exists every SELVEDGE_CHECKPOINT_STEPS steps.
  std::vector<std::uint8_t> checkpoint() {
    const std::uint8_t *first = nullptr;
    std::size_t count = 0;
    check(selvedge_simulation_checkpoint(get(), &first, &count));
    return {first, first + count};
  }

  /// Continues from a checkpoint of the same scene, with the same bits as an uninterrupted simulation.
  void resume(const std::vector<std::uint8_t> &checkpoint) {
    check(selvedge_simulation_resume(get(), checkpoint.data(), checkpoint.size()));
  }

  /// Returns the handle for functions of selvedge_cloth.h. This object still owns it.
  selvedge_simulation *get() const noexcept { return handle_.get(); }

 private:
  struct freed {
    void operator()(selvedge_simulation *handle) const noexcept { selvedge_simulation_free(handle); }
  };

  explicit simulation(selvedge_simulation *made) noexcept : handle_(made) {}

  static const char *text(const std::string &text) { return detail::text(text); }

  std::pair<mesh_lists, std::vector<std::uint32_t>> in_files() {
    selvedge_mesh_lists lists{};
    const std::uint32_t *first = nullptr;
    std::size_t count = 0;
    check(selvedge_simulation_mesh_in_files(get(), &lists, &first, &count));
    return {mesh_lists(lists), {first, first + count}};
  }

  template <class Load>
  Load load(selvedge_status (*find)(const selvedge_simulation *, std::size_t, const double *, Load *), std::size_t number,
            const std::array<double, 3> &about) const {
    Load load{};
    check(find(get(), number, about.data(), &load));
    return load;
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
