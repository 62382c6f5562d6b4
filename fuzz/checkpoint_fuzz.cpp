// A checkpoint from someone who means harm. As a file, any bytes: the envelope lets nothing through
// that was not sealed. Behind it, a record with anything in it: it is refused, or it can be run.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "checkpoint/envelope.hpp"
#include "checkpoint/hdf5_image.hpp"
#include "model/read_model.hpp"
#include "run/simulation_memory.hpp"
#include "step/step.hpp"

namespace {

const char* heap = R"(
[materials.r]
density = 2500
young = 1e8
poisson = 0.2
[joints.j]
friction_angle = 20
cohesion = 1e3
[[block]]
fixed = true
polygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
polygon = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[block]]
polygon = [[0.4, 1.001], [1.4, 1.001], [1.2, 2]]
velocity = [0.5, -1.0]
[solver]
duration = 1
)";

edda::Simulation fresh(const char* more) {
  auto model = edda::read_model_text(std::string(heap) + more, "heap.toml", {});
  auto sim = edda::Simulation::create(std::move(model.value()));
  return std::move(sim.value());
}

edda::Record some_way_on(const char* more) {
  edda::Simulation sim = fresh(more);
  start(sim, 1.0);
  for (int step = 0; step < 100; ++step) {
    if (edda::step(sim)) std::abort();
  }
  edda::Record record;
  edda::remember(sim, record);
  return record;
}

struct Bytes {
  const std::uint8_t* data;
  std::size_t left;
  std::uint8_t next() {
    if (left == 0) return 0;
    --left;
    return *data++;
  }
};

template <class Values>
void spoil(Values& values, Bytes& bytes) {
  using T = typename Values::value_type;
  const std::uint8_t what = bytes.next();
  const std::size_t at = values.empty() ? 0 : (bytes.next() * 251u + bytes.next()) % values.size();
  if (what % 8 == 0) {
    values.resize(bytes.next());
  } else if (what % 8 == 1) {
    values.clear();
  } else if (!values.empty()) {
    std::array<std::uint8_t, sizeof(T)> raw;
    for (std::uint8_t& r : raw)
      r = what % 2 ? bytes.next() : static_cast<std::uint8_t>(0xff * (what & 1) + what);
    std::memcpy(&values[at], raw.data(), sizeof(T));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::array records{some_way_on(""),
                                  some_way_on("method = 'dda'\ntime_step = 1e-3\n")};
  const std::string file(reinterpret_cast<const char*>(data), size);
  if (edda::open_sealed(file).ok() && size < edda::envelope_size) std::abort();
  if (size == 0) return 0;
  Bytes bytes{data, size};
  const std::uint8_t which = bytes.next() % 2;
  edda::Record record = records[which];
  for (int change = 0; change < 8 && bytes.left > 0; ++change) {
    const auto entry = std::next(record.begin(), bytes.next() % static_cast<int>(record.size()));
    if (bytes.next() % 32 == 0) {
      record.erase(entry);
      if (record.empty()) return 0;
      continue;
    }
    std::visit([&](auto& values) { spoil(values, bytes); }, entry->second);
  }
  edda::Simulation sim = fresh(which ? "method = 'dda'\ntime_step = 1e-3\n" : "");
  if (!edda::recall(sim, record).empty()) return 0;
  try {
    for (int step = 0; step < 3; ++step) {
      if (edda::step(sim)) return 0;
    }
  } catch (const std::logic_error& broken) {
    // Finite numbers that no step makes may overflow in the next one; that breaks no memory.
    if (!std::string_view(broken.what()).starts_with("invariant: ")) throw;
  }
  return 0;
}
