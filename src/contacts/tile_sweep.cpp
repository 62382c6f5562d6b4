#include "contacts/tile_sweep.hpp"

#include <algorithm>
#include <array>

#include "contacts/chunk_loops.hpp"
#include "contacts/tile_edges.hpp"
#include "contacts/tile_sleep.hpp"

namespace edda {
namespace {

/// The edges of chunks: tables of records of four numbers, and the slots there.
struct ChunkEdges {
  const SweepScene& scene;
  const double *at, *then;  ///< start and end at n and n - 1, m; then: null where no face takes it
  const Id *slots_e, *slots_f;  ///< [chunks][8]
  std::size_t first = 0;        ///< chunk with which they begin

  const Id* slot_e(std::size_t chunk) const { return slots_e + (chunk - first) * lanes; }
  const Id* slot_f(std::size_t chunk) const { return slots_f + (chunk - first) * lanes; }
};

/// The edges of a chunk, how they stand, and where they overlap.
struct ChunkGeometry {
  Records e, f;
  alignas(64) double columns[geometry_columns * lanes];
  alignas(64) double overlaps[overlap_columns * lanes];
  alignas(64) double pressures[pressure_columns * lanes];
  bool overlaps_known;
};
ChunkView view_of(const SweepTables& t, std::size_t chunk, ChunkGeometry& stand) {
  ChunkView view = view_of(t, chunk, stand.columns, stand.overlaps, stand.pressures);
  view.e = &stand.e;
  view.f = &stand.f;
  return view;
}

/// Chunks that are evaluated together: what they need meanwhile stays in the first cache.
constexpr std::size_t chunks_at_once = 8;

/// What a chunk is evaluated for.
enum class Needs { forces, work, dashpots };

ChunkFound evaluate_by(Formulas use, Needs needs, const ChunkView& view) {
  using Loop = ChunkFound(const ChunkView&);
  static constexpr Loop* loops[3][3] = {
      {evaluate_bonded_without_work, evaluate_bonded_with_work, evaluate_bonded_damped},
      {evaluate_without_work, evaluate_with_work, evaluate_damped},
      {evaluate_plain_without_work, evaluate_plain_with_work, evaluate_plain_damped}};
  return loops[static_cast<std::size_t>(use)][static_cast<std::size_t>(needs)](view);
}

/// Evaluates a chunk. What held for all of its faces in the last step is tried first: that
/// is_plain(), and that they do no work.
ChunkFound evaluate_chunk(FaceTiles& t, const ChunkView& view, std::size_t q, bool overlaps_known) {
  const auto any = [](const ChunkFound& c, unsigned of) {
    return (c.found & lane_bits::field(of)) != 0;
  };
  if (!t.limits.empty()) {
    if (!overlaps_known) overlap_edges(view);
    return t.dashpots ? evaluate_limited_damped(view) : evaluate_limited(view);
  }
  const bool worked = t.fresh[1 - t.now][q] != 0;
  Formulas use = t.bonds[q] != 0   ? Formulas::all
                 : t.plain[q] != 0 ? Formulas::plain
                                   : Formulas::unbonded;
  Needs needs = t.dashpots ? Needs::dashpots : worked || t.slip_laws ? Needs::work : Needs::forces;
  for (;;) {
    if (use != Formulas::plain && !overlaps_known) overlap_edges(view);
    const ChunkFound found = evaluate_by(use, needs, view);
    const bool too_plain = use == Formulas::plain && any(found, lane_bits::rare),
               too_quiet = needs == Needs::forces && any(found, lane_bits::busy);
    if (!too_plain && !too_quiet) {
      t.plain[q] = any(found, lane_bits::rare) ? 0 : 1;
      return found;
    }
    overlaps_known = overlaps_known || use != Formulas::plain;
    if (too_plain) use = Formulas::unbonded;
    if (too_quiet) needs = Needs::work;
  }
}

/// Keeps what the evaluation of a chunk has found. Its work counts only if it did any.
void keep(FaceTiles& t, std::size_t q, const ChunkFound& c) {
  const auto any = [&](unsigned of) { return (c.found & lane_bits::field(of)) != 0; };
  t.bits[t.now][q] = c.bits;
  t.found[t.now][q] = c.found;
  t.idle[t.now][q] = any(lane_bits::loaded) ? 0 : 1;
  t.fresh[t.now][q] = any(lane_bits::busy) ? 1 : 0;
}

/// Clears the records of a chunk.
void store_nothing(const FaceTiles& t, double* on, std::size_t q) {
  const auto clear = [&](const std::vector<Id>& record) {
    for (std::size_t place = q * lanes; place < (q + 1) * lanes; ++place) {
      *reinterpret_cast<Four*>(on + 4 * std::size_t{record[place]}) = Four{};
    }
  };
  clear(t.record_e);
  clear(t.record_f);
}

/// Whether none of the faces of a chunk has carried anything for two steps.
bool is_idle(const FaceTiles& t, std::size_t q) {
  return t.idle[0][q] != 0 && t.idle[1][q] != 0 && t.bonds[q] == 0;
}

/// Reads EdgeInverseMass of the edges of a chunk; lanes without a face have some other edge's.
void read_masses(const FaceTiles& t, const SweepScene& scene, std::size_t q, Records& e,
                 Records& f) {
  Id edge[lanes], facing[lanes];
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Id k = t.face[q * lanes + lane] != no_id ? t.face[q * lanes + lane] : 0;
    edge[lane] = scene.faces.edge[k];
    facing[lane] = scene.faces.facing[k];
  }
  read_masses(scene.masses, scene.blocks.next.data(), edge, facing, e, f);
}

/// Evaluates a chunk whose edges stand as they are known to, and stores its forces. Returns what it
/// has found.
ChunkFound evaluate_with_geometry(FaceTiles& t, ChunkView& view, const ChunkEdges& edges,
                                  bool overlaps_known) {
  const std::size_t q = view.chunk;
  if (is_idle(t, q)) {
    const ChunkFound open = test_open_faces(view);
    if (open.found == 0) {
      keep(t, q, open);
      store_nothing(t, view.of->on, q);
      return open;
    }
  }
  Records e_then, f_then, mass_e, mass_f;
  if (edges.then != nullptr) {
    read_edges(edges.then, edges.slot_e(q), edges.slot_f(q), e_then, f_then);
    view.e_then = &e_then;
    view.f_then = &f_then;
  }
  if (t.dashpots) {
    read_masses(t, edges.scene, q, mass_e, mass_f);
    view.mass_e = &mass_e;
    view.mass_f = &mass_f;
  }
  const ChunkFound found = evaluate_chunk(t, view, q, overlaps_known);
  keep(t, q, found);
  return found;
}

/// Evaluates some chunks, not more than chunks_at_once. How the edges of all of them stand comes
/// first, and where they overlap, for the processor to compute several beside each other: each is a
/// long chain of roots and divisions.
LaneBits sweep_some(FaceTiles& t, const SweepTables& tables, const ChunkEdges& edges,
                    std::span<const std::size_t> chunks) {
  ChunkGeometry stands[chunks_at_once];
  ChunkView views[chunks_at_once];
  for (std::size_t n = 0; n < chunks.size(); ++n) {
    const std::size_t q = chunks[n];
    views[n] = view_of(tables, q, stands[n]);
    read_edges(edges.at, edges.slot_e(q), edges.slot_f(q), stands[n].e, stands[n].f);
  }
  for (std::size_t n = 0; n < chunks.size(); ++n) compute_geometry(views[n]);
  for (std::size_t n = 0; n < chunks.size(); ++n) {
    const std::size_t q = chunks[n];
    bool& known = stands[n].overlaps_known;
    known = (t.plain[q] == 0 || t.bonds[q] != 0) && !is_idle(t, q);
    if (known) overlap_edges(views[n]);
  }
  LaneBits found = 0;
  for (std::size_t n = 0; n < chunks.size(); ++n) {
    const ChunkFound here = evaluate_with_geometry(t, views[n], edges, stands[n].overlaps_known);
    found |= here.found;
    t.deepest[chunks[n]] = std::max(t.deepest[chunks[n]], here.deepest);
  }
  return found;
}

/// Evaluates the chunks of a tile but those that rest or sleep.
LaneBits sweep_awake(FaceTiles& t, const Tile& of, const SweepTables& tables,
                     const ChunkEdges& edges) {
  LaneBits found = 0;
  std::array<std::size_t, chunks_at_once> some;
  std::size_t count = 0;
  for (std::size_t q = of.first_chunk; q < of.awake_end; ++q) {
    if (t.rest[q] > 0.0) {
      store_nothing(t, tables.on, q);
      continue;
    }
    some[count++] = q;
    if (count < chunks_at_once) continue;
    found |= sweep_some(t, tables, edges, some);
    count = 0;
  }
  return found | sweep_some(t, tables, edges, {some.data(), count});
}

/// Records of the edges of a chunk alone.
struct EdgesAlone {
  alignas(32) double at[2 * lanes][4], then[2 * lanes][4];
};
constexpr Id slots_alone[2 * lanes] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// Reads the edges of a chunk from the vertices, those at n - 1 if `then`.
void read_vertices(const FaceTiles& t, const FaceSet& faces, const BlockSet& b, const Pose& p,
                   std::size_t q, bool then, EdgesAlone& to) {
  const auto put = [](double* record, const std::array<double, 4>& numbers) {
    std::copy(numbers.begin(), numbers.end(), record);
  };
  const auto read = [&](std::size_t slot, Id edge) {
    const Id end = b.next[edge];
    put(to.at[slot], {p.x[edge], p.y[edge], p.x[end], p.y[end]});
    if (then) put(to.then[slot], {p.x1[edge], p.y1[edge], p.x1[end], p.y1[end]});
  };
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Id k = t.face[q * lanes + lane];
    if (k != no_id) {
      read(lane, faces.edge[k]);
      read(lanes + lane, faces.facing[k]);
    } else {
      for (auto* of : {to.at, to.then}) put(of[lane], {}), put(of[lanes + lane], {});
    }
  }
}

/// Fills the records of a tile's edges.
void place_tile(FaceTiles& t, const SweepScene& scene, std::size_t tile, SweepScratch& scratch) {
  const Tile& of = t.tiles[tile];
  const BlockSet& b = scene.blocks;
  const std::size_t numbers = 4 * std::size_t{of.slots()};
  const auto place = [&](const std::vector<double>& x, const std::vector<double>& y,
                         AlignedNumbers& to) {
    to.resize(std::max(to.size(), numbers));
    place_edges(vertex_links(b), &t.blocks[of.first_block], of.last_block - of.first_block,
                t.halo.data() + of.first_halo, of.last_halo - of.first_halo, x.data(), y.data(),
                to.data());
    std::fill_n(&to[numbers - 4], 4, 0.0);
  };
  const Pose& pose = scene.pose;
  place(pose.x, pose.y, scratch.at);
  const bool sleep_ends = sleep_is_over(t, scene, tile, scratch);
  if (of.takes_then || sleep_ends) place(pose.x1, pose.y1, scratch.then);
  if (sleep_ends) let_sleep(t, scene, tile, scratch);
}

/// Numbers of the records of a tile's forces.
std::size_t record_numbers(const FaceTiles& t, const Tile& tile) {
  const std::size_t of_own = t.record_begin[tile.first_edge + tile.own_edges];
  return 4 * (of_own + (tile.last_chunk - tile.first_chunk) + 1);
}

SweepResult result_of(LaneBits found) {
  const auto any = [&](unsigned of) { return (found & lane_bits::field(of)) != 0; };
  return {any(lane_bits::decides), any(lane_bits::switching), any(lane_bits::fails)};
}

/// How the time that a tile has taken in its sweep compares with that of others: a chunk that acts
/// takes five times as long as one that does not, and a block about twice.
std::size_t cost_of(const FaceTiles& t, const Tile& of) {
  std::size_t cost = 1 + 2 * std::size_t{of.last_block - of.first_block};
  for (Id q = of.first_chunk; q < of.awake_end; ++q) {
    if (t.rest[q] == 0.0) cost += t.idle[t.now][q] != 0 ? 1 : 5;
  }
  return cost;
}

}  // namespace

SweepResult sweep_tile(FaceTiles& t, const SweepScene& scene, std::size_t tile, bool keep,
                       SweepScratch& scratch, BodyVectors& on) {
  const Tile& of = t.tiles[tile];
  place_tile(t, scene, tile, scratch);
  const std::size_t numbers = record_numbers(t, of);
  AlignedNumbers &own = t.forces[tile], &records = t.kept[tile] != 0 ? own : scratch.on;
  records.resize(std::max(records.size(), numbers));
  const SweepTables tables = tables_of(t, tile, records.data(), scene.step, scene.faces);
  const ChunkEdges edges{scene, scratch.at.data(), of.takes_then ? scratch.then.data() : nullptr,
                         t.slot_e.data(), t.slot_f.data()};
  if (!scene.corrects) {
    std::fill(t.deepest.data() + of.first_chunk, t.deepest.data() + of.last_chunk, 0.0);
  }
  const LaneBits found = sweep_awake(t, of, tables, edges);
  gather_blocks(edge_forces_view(scene.blocks, on), &t.blocks[of.first_block],
                of.last_block - of.first_block, nullptr, &t.record_begin[of.first_edge],
                records.data());
  SweepResult result = result_of(found);
  result.cost = cost_of(t, of);
  const bool keeps = keep || result.decides || result.switching || result.fails;
  if (keeps && t.kept[tile] == 0) own.swap(scratch.on);
  t.kept[tile] = keeps ? 1 : 0;
  return result;
}

SweepResult sweep_chunks(FaceTiles& t, const SweepScene& scene, std::size_t tile,
                         std::span<const Id> chunks) {
  LaneBits found = 0;
  const SweepTables tables = tables_of(t, tile, t.forces[tile].data(), scene.step, scene.faces);
  for (const std::size_t q : chunks) {
    EdgesAlone alone;
    const bool then = t.tiles[tile].takes_then;
    read_vertices(t, scene.faces, scene.blocks, scene.pose, q, then, alone);
    const ChunkEdges edges{scene,       alone.at[0],         then ? alone.then[0] : nullptr,
                           slots_alone, slots_alone + lanes, q};
    ChunkGeometry stand;
    ChunkView view = view_of(tables, q, stand);
    read_edges(edges.at, edges.slot_e(q), edges.slot_f(q), stand.e, stand.f);
    compute_geometry(view);
    const ChunkFound here = evaluate_with_geometry(t, view, edges, false);
    found |= here.found;
    t.deepest[q] = scene.corrects ? std::max(t.deepest[q], here.deepest) : here.deepest;
  }
  return result_of(found);
}

void measure_tile(const FaceTiles& t, const FaceSet& c, const BlockSet& b, const Pose& pose,
                  std::size_t tile, std::vector<double>& energy, std::vector<double>& normal) {
  const TileNumbers& numbers = t.numbers[tile];
  SweepTables tables{};
  tables.was = t.bits[t.now].data();
  for (std::size_t n = 0; n < numbers.chunks; ++n) {
    const std::size_t q = numbers.first_chunk + n;
    const bool stores = (t.bits[t.now][q] & lane_bits::field(lane_bits::stored)) != 0;
    if (!stores && t.idle[1 - t.now][q] != 0) continue;
    EdgesAlone alone;
    Records e, f, e_then, f_then;
    read_vertices(t, c, b, pose, q, true, alone);
    read_edges(alone.at[0], slots_alone, slots_alone + lanes, e, f);
    read_edges(alone.then[0], slots_alone, slots_alone + lanes, e_then, f_then);
    ChunkView view{};
    view.of = &tables;
    view.chunk = q;
    view.edges = t.edges_of(tile, q);
    view.strengths = t.strengths_of(tile, q);
    view.before = numbers.memory[1 - t.now].data() + n * memory_columns * lanes;
    view.e = &e;
    view.f = &f;
    view.e_then = &e_then;
    view.f_then = &f_then;
    ChunkMeasures all;
    measure_faces(view, all);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if ((t.owned[q] >> lane & 1u) == 0) continue;
      energy[t.face[q * lanes + lane]] = all.energy[lane];
      normal[t.face[q * lanes + lane]] = all.normal[lane];
    }
  }
}

void gather_tile(const FaceTiles& t, const BlockSet& b, std::size_t tile,
                 const std::vector<std::uint8_t>& wanted, BodyVectors& on) {
  const Tile& of = t.tiles[tile];
  gather_blocks(edge_forces_view(b, on), &t.blocks[of.first_block], of.last_block - of.first_block,
                wanted.data(), &t.record_begin[of.first_edge], t.forces[tile].data());
}

}  // namespace edda
