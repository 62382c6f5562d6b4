// Key blocks: which blocks of the cut can leave it, and which do (docs/keyblocks.md; Goodman and
// Shi, Block theory and its application to rock engineering, 1985, in two dimensions).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limit/rigid_blocks.hpp"
#include "run/run_model.hpp"

namespace edda {

enum class BlockClass {
  locked,  ///< no direction leads out: tapered, or enclosed; or a boundary holds it
  stable,  ///< removable, and stays without any friction
  held,    ///< removable, and the strength of its joints holds it with the factor asked for
  key,     ///< removable, and below that factor
};
constexpr std::string_view block_class_name(BlockClass c) {
  constexpr std::string_view names[] = {"locked", "stable", "held", "key"};
  return names[static_cast<int>(c)];
}

enum class RemovalMode { stays, falls, slides, slides_on_two, rotates };
constexpr std::string_view removal_mode_name(RemovalMode m) {
  constexpr std::string_view names[] = {"stays", "falls", "slides", "slides on two faces",
                                        "rotates"};
  return names[static_cast<int>(m)];
}

/// A body that can leave.
struct RemovableBlock {
  std::size_t body = 0;             ///< row of RigidBlocks
  std::vector<Id> blocks;           ///< several where they are glued
  Vec2 centroid;                    ///< m
  double area = 0.0, weight = 0.0;  ///< m2; N, of the thickness
  BlockClass kind = BlockClass::stable;
  RemovalMode mode = RemovalMode::stays;
  std::vector<std::size_t> joints;       ///< rows of RigidBlocks::joints on which it slides
  Vec2 direction;                        ///< unit vector of its motion; 0: none
  std::optional<double> by_translation;  ///< factor by falling or sliding; none: it stays
  std::optional<double> by_rotation;     ///< that of rigid limit analysis of the block alone; none:
                                         ///< no factor moves it
  std::optional<double> factor;          ///< the lower one
  std::size_t generation = 1;            ///< in which it can leave, or does
  std::optional<double> support;         ///< N against its motion, for the factor asked for; none:
                                         ///< it rotates
};

struct KeyBlockOptions {
  double factor = 1.0;             ///< below it a removable block is a key block
  std::size_t generations = 1000;  ///< at most: blocks that others have left free
  std::vector<Vec2> places{};      ///< m, of which to say what is there
};

/// The block at a monitor of the model.
struct MonitoredPlace {
  std::string name;
  BlockClass kind = BlockClass::locked;
  std::size_t generation = 0;  ///< of a key block; 0: it is none
};

struct KeyBlocks {
  std::vector<RemovableBlock>
      blocks;                        ///< key blocks first, in the order of generations and factors
  std::vector<BlockClass> of_block;  ///< [nb]
  std::vector<std::size_t> generation_of_block;  ///< [nb] of key blocks; 0: none
  std::size_t bodies = 0, locked = 0, stable = 0, held = 0, key = 0, generations = 0;
  std::vector<MonitoredPlace> monitors;
  /// [options.places] generation of the key block there, 0: of other rock; none: there is no rock.
  std::vector<std::optional<std::size_t>> at_place;
  double key_area = 0.0, key_weight = 0.0;
  std::string message;
  std::optional<Simulation> drawn;
  RigidBlocks rigid;
  double required = 1.0;
  double seconds = 0.0;
  std::vector<std::string> warnings;
};

/// Of the model as drawn with the changes of all stages up to fos.stage, under its gravity, loads
/// and water, without bolts. Faults: those of prepare_run(); no free block, no load at all.
Result<KeyBlocks> key_blocks(const Model& model, const KeyBlockOptions& options);

/// keyblocks.csv and summary.json.
std::string key_blocks_csv(const KeyBlocks& found);
std::string key_blocks_summary(const Model& model, const KeyBlocks& found);

}  // namespace edda
