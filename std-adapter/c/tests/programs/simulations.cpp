// Tests the additions of C++ to simulations.c: exceptions, an owner that can be moved, lists and texts of C++.
#include "expect.hpp"
#include <cmath>
#include <selvedge_cloth.hpp>
#include <type_traits>

static const char *const SCENE = R"(
time_step = 0.002
duration = 1
[[body]]
name = "ball"
shape = "ball"
centre = [0.2, 0.2, -0.12]
radius = 0.1
around = 8
driven = true
[cloth]
shape = "sheet"
sides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }
cells = [4, 4]
density = 0.15
[effects.gravity]
[effects.stretch]
stiffness = 500
[effects.wind]
velocity = [0, 0, 0]
[effects.self_collision]
thickness = 0.005
[effects.body_contact]
thickness = 0.005
[[effects.pins.group]]
part = "left"
driven = true
)";

int main() {
  using selvedge::simulation;
  static_assert(!std::is_copy_constructible_v<simulation> && std::is_nothrow_move_constructible_v<simulation>);
  expect(__LINE__, SELVEDGE_STATUS_BAD_SCENE, [] { simulation(""); });
  expect(__LINE__, SELVEDGE_STATUS_BAD_TEXT, [] { simulation(std::string("a\0b", 3)); });
  expect(__LINE__, SELVEDGE_STATUS_BAD_SCENE, [] { simulation::read("there-is-none.toml"); });

  expect(__LINE__, SELVEDGE_STATUS_BAD_FILE, [] { selvedge::mesh_file::read("there-is-none.obj"); });

  simulation first(SCENE);
  holds(__LINE__, first.mesh_in_files().positions == first.positions() && first.numbers_in_files().back() + 1 == first.sizes().vertex_count);
  const auto sizes = first.sizes();
  const auto ball = first.body("ball");
  holds(__LINE__, first.cloth("cloth").vertex_count == 25 && ball.first_vertex == 25 && sizes.cloth_count == 1);
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_PART, [&] { first.body("none"); });
  holds(__LINE__, first.triangles().size() == 3 * sizes.triangle_count && first.velocities()[14] == 0 && first.normals()[2] == 1);
  const auto start = first.checkpoint();
  std::size_t near = 0;
  const auto told = [&](simulation &it) {
    for (int step = 1; step <= 100; step++) {
      it.set_wind(0, 1, -1);
      it.place_body(0, {{0, 0, 0, 1}, {0, 0, 0.0001 * step}});
      const auto now = it.positions();
      std::vector<double> pins;
      for (int pin = 0; pin < 5; pin++) {
        for (int axis = 0; axis < 3; axis++) pins.push_back(now[static_cast<std::size_t>(15 * pin + axis)]);
      }
      it.move_pins(0, pins);
      it.step();
      near += it.near_pairs().size();
    }
    return it.positions();
  };
  const auto end = told(first);
  holds(__LINE__, near > 0 && first.progress().is_certified && first.progress().steps_done == 100);
  holds(__LINE__, first.placement(0).has_value() && first.placement(0)->origin[2] == 0.01);
  {
    double push = 0;
    for (const auto &contact : first.contact_loads(0)) push += contact.push[2];
    const auto load = first.body_load(0);
    holds(__LINE__, push < 0 && std::abs(push - load.contact.force[2]) <= 1e-12 && first.mean_body_load(0).contact.force[2] == load.contact.force[2]);
    holds(__LINE__, first.pin_load(0, {0, 0.2, 0}).force[2] != 0);
    expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_PART, [&] { first.attachment_load(0); });
    expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.add_forces({0, 1}, std::vector<double>(3)); });
    first.add_forces({0}, std::vector<double>{0, 0, 0});
  }
  expect(__LINE__, SELVEDGE_STATUS_NO_CHECKPOINT, [&] { first.checkpoint(); });
  expect(__LINE__, SELVEDGE_STATUS_BAD_CHECKPOINT, [&] { first.resume({}); });
  expect(__LINE__, SELVEDGE_STATUS_BAD_VALUE, [&] { first.set_wind(1e9, 0, 0); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.move_body(0, end); });
  expect(__LINE__, SELVEDGE_STATUS_WRONG_LENGTH, [&] { first.move_pins(0, std::vector<double>(4)); });
  first.resume(start);
  holds(__LINE__, told(first) == end);

  simulation second = std::move(first);
  expect(__LINE__, SELVEDGE_STATUS_NULL_POINTER, [&] { first.step(); });
  const auto body = end.data() + 3 * ball.first_vertex;
  second.move_body(0, {body, ball.vertex_count});
  const auto frame = second.advance(1.0 / 60, 8);
  holds(__LINE__, frame.steps >= 4 && frame.steps <= 8 && frame.needed >= frame.steps);
  expect(__LINE__, SELVEDGE_STATUS_BAD_VALUE, [&] { second.advance(-1); });
  holds(__LINE__, !second.placement(0).has_value());
  // A ball of 200 g falls.
  std::string falling = SCENE;
  falling.replace(falling.find("driven = true"), 13, "mass = 0.2\nspin = [0, 0, 2]");
  simulation third(falling);
  third.advance(0.1);
  const auto motion = third.body_motion(0);
  holds(__LINE__, motion.has_value() && motion->mass == 0.2 && std::abs(motion->velocity[2] + 0.981) < 1e-9);
  holds(__LINE__, third.placement(0).has_value() && third.placement(0)->origin[2] < -0.04 && !second.body_motion(0).has_value());
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_PART, [&] { third.body_motion(1); });

  // Another engine holds that ball, and the sheet above sinks on it.
  std::string held = SCENE;
  held.replace(held.find("driven = true"), 13, "mass = 0.2\nproxy = true");
  simulation fourth(held);
  expect(__LINE__, SELVEDGE_STATUS_BAD_VALUE, [&] { fourth.bring_body(0, {{{0, 0, 0, 1}, {0, 0, 0}}, {NAN, 0, 0}, {}}); });
  expect(__LINE__, SELVEDGE_STATUS_NOT_DRIVEN, [&] { third.bring_body(0, {{{0, 0, 0, 1}, {0, 0, 0}}, {}, {}}); });
  for (int number = 0; number < 40; number++) {
    fourth.bring_body(0, {*fourth.placement(0), {}, {}});
    fourth.advance(1.0 / 60);
  }
  const auto load = fourth.proxy_load(0);
  holds(__LINE__, load.has_value() && load->force[2] < 0 && !third.proxy_load(0).has_value());
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_PART, [&] { fourth.proxy_load(1); });

  selvedge_simulation_free(second.get());
  expect(__LINE__, SELVEDGE_STATUS_NO_SUCH_SIMULATION, [&] { second.step(); });
  return faults == 0 ? 0 : 1;
}
