// A block on a ramp: let go for a while, then pushed uphill. Usage: slide ramp.toml
#include <cstdio>
#include <edda/edda.hpp>

namespace api = edda::api;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s MODEL\n", argv[0]);
    return 2;
  }
  try {
    const api::Model model = api::Model::read(argv[1], {"solver.duration=0.2"});
    api::Simulation simulation(model);
    const std::size_t slider = simulation.block_called("slider").value();
    simulation.every(200, [&] {
      const api::MonitorReading at = simulation.read("centre");
      std::printf("%.4f s: moved by (%.6f, %.6f) m\n", simulation.time(), at.ux, at.uy);
    });
    simulation.advance_to(0.1);
    simulation.set_velocity(slider, {-0.433, 0.25});
    const api::Outcome outcome = simulation.run();
    for (const api::Contact& contact : simulation.contacts()) {
      std::printf("contact at (%.3f, %.3f): %.1f N\n", contact.x, contact.y, contact.normal_force);
    }
    std::printf("%s after %.4g s, energy balance error %.1e\n", name_of(outcome.status).data(),
                outcome.time, outcome.drift);
  } catch (const api::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
