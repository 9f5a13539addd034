// The flag of flag.c in a wind that turns: it prints the free corner, and whether each state is certified.
#include <cstdio>
#include <selvedge_cloth.hpp>

// std-adapter/cloth/scenes/README.md describes scenes.
static const char *const SCENE = R"(
time_step = "2 ms"
duration = "1 s"
[cloth]
shape = "sheet"
corner = [0, 0, 1]
sides = { first = [0.9, 0, 0], second = [0, 0, 0.6] }
cells = [18, 12]
density = "120 g/m2"
[effects.gravity]
[effects.wind]
velocity = [0, 0, 0]
[effects.air_drag]
rate = "0.1 1/s"
[effects.stretch]
stiffness = "1 kN/m"
[effects.shear]
stiffness = "200 N/m"
[effects.bend]
stiffness = "20 uN m"
[effects.self_collision]
thickness = "5 mm"
[[effects.pins.group]]
part = "left"
)";

// The velocities of the wind in m/s, for 100 steps each.
static const double WINDS[5][3] = {{6, 1, 0}, {6, -4, 0}, {-5, 3, 0}, {12, 0, 1}, {0, 0, 0}};

int main() {
  try {
    selvedge::simulation flag(SCENE);
    const auto steps = flag.sizes().steps;
    int certified = 0;
    for (std::uint64_t step = 0; step < steps; step++) {
      const double *wind = WINDS[step / 100 % 5];
      flag.set_wind(wind[0], wind[1], wind[2]);
      flag.step();

      const auto progress = flag.progress();
      certified += progress.is_certified;
      if (progress.steps_done % 50 != 0) continue;
      const auto positions = flag.positions();
      const double *corner = positions.data() + positions.size() - 3;
      std::printf("step %3d: %.17g %.17g %.17g %s\n", static_cast<int>(progress.steps_done), corner[0], corner[1], corner[2],
                  progress.is_certified ? "certified" : "not certified");
    }
    std::printf("%d of %d states are certified\n", certified, static_cast<int>(steps));
  } catch (const selvedge::error &failed) {
    std::fprintf(stderr, "%s\n", failed.what());
    return 1;
  }
}
