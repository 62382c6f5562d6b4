#include "run/size_limits.hpp"

#include <fmt/format.h>

#include "model/completion/complete.hpp"
#include "results/columns.hpp"

namespace edda {
namespace {

/// A lower bound; measured 4,700 per brick, and 7,900 per block cut with sharp corners, each with
/// contacts.
constexpr double bytes_per_block = 4000.0;

std::string gigabytes(double bytes) {
  return fmt::format("{:.3g} GB", 1e-9 * bytes);
}

Fault at_key(Where where, const char* key, std::string problem, std::string remedy) {
  where.key += std::string(".") + key;
  return {std::move(where), std::move(problem), std::move(remedy)};
}

}  // namespace

std::optional<Fault> beyond_memory(const Model& model, double memory) {
  double bricks = 0.0;
  for (const BrickWall& wall : model.walls) {
    bricks += static_cast<double>(wall.columns) * wall.rows;
  }
  // Openings and short regions may remove half of the estimated blocks.
  const double cut = model.domain ? 0.5 * estimated_blocks(model) : 0.0;
  const double needed = (bricks + cut) * bytes_per_block;
  if (needed <= memory) return {};
  const std::string problem =
      fmt::format("{:.3g} blocks and more need at least {}, and this machine has {}", bricks + cut,
                  gigabytes(needed), gigabytes(memory));
  if (bricks > cut) {
    return at_key(model.walls.front().where, "columns", problem, "give fewer columns or rows");
  }
  return at_key(model.domain->where, "max_blocks", problem, "give larger spacings");
}

std::optional<Fault> beyond_disks(const Simulation& sim) {
  constexpr double most = 1e13;                            // bytes
  constexpr double per_vertex = 100.0, per_column = 10.0;  // bytes, at least
  const Output& output = sim.scene->model.output;
  const double duration = sim.scene->model.solver.duration;
  if (duration == 0.0) return {};
  const double frames =
      duration / output.every * static_cast<double>(sim.scene->blocks.vertex_count()) * per_vertex;
  const Model& model = sim.scene->model;
  const auto columns = static_cast<double>(
      column_count(ResultFile::history, {.monitors = names_in(model.monitors),
                                         .convergences = names_in(model.convergences),
                                         .measurements = names_in(model.measurements)}));
  const double rows = duration / output.history_every * columns * per_column;
  if (frames + rows <= most) return {};
  const bool by_frames = frames > rows;
  Where where = sim.scene->model.solver.where;
  if (where.file.empty()) where.file = sim.scene->model.file;
  where.key = "output";
  where.line = where.column = 0;
  return at_key(where, by_frames ? "every" : "history_every",
                fmt::format("the files would take at least {}", gigabytes(frames + rows)),
                by_frames ? "give more time between frames"
                          : "give more time between rows, or fewer monitors");
}

}  // namespace edda
