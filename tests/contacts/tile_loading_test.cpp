// States of faces taken into tiles.
#include "contacts/tile_loading.hpp"

#include <gtest/gtest.h>

#include "contacts/drifting_heap.hpp"
#include "contacts/tile_columns.hpp"

namespace edda::tile_loading_test {
namespace {

/// Work may be all that a state has: no step makes such a state, but a file may hold it. Both
/// copies of a face keep it.
TEST(TileLoading, KeepsTheWorkOfFacesThatCarryNothing) {
  using Work = FaceWorkColumns<double>;
  constexpr double FaceFields::*fields[] = {&FaceFields::friction_work, &FaceFields::transfer,
                                            &FaceFields::trial_a,       &FaceFields::trial_b,
                                            &FaceFields::shear_a,       &FaceFields::shear_b,
                                            &FaceFields::damping_work,  &FaceFields::damping_due};
  constexpr double Work::*columns[] = {&Work::friction_work, &Work::transfer,   &Work::trial_a,
                                       &Work::trial_b,       &Work::shear_a,    &Work::shear_b,
                                       &Work::damping_work,  &Work::damping_due};
  std::mt19937 rng(7);
  DriftingHeap heap(odd_polygons(rng, 40));
  FaceSet& c = heap.alone.faces;
  heap.find(0.1);
  ASSERT_GT(c.size(), 100u);
  std::size_t copies = 0;
  for (std::size_t column = 0; column < std::size(columns); ++column) {
    const std::size_t working = c.size() - 1 - 7 * column;
    FaceStates states(c.size());
    states.now[working].*fields[column] = 2.5;
    states.before[working].*fields[column] = 1.5;
    FaceTiles tiles;
    divide_blocks(tiles, heap.blocks, heap.state, true, 5);
    load_faces(tiles, c, states, heap.blocks, heap.pose);
    for (std::size_t k = 0; k < c.size(); ++k) {
      for (const Id place : tiles.place[k]) {
        if (place == no_id) continue;
        const auto work = get<Work>(tiles, tiles.now, place);
        const auto before = get<Work>(tiles, 1 - tiles.now, place);
        EXPECT_EQ(work.*columns[column], k == working ? 2.5 : 0.0) << column << " of face " << k;
        EXPECT_EQ(before.*columns[column], k == working ? 1.5 : 0.0) << column << " of face " << k;
        copies += k == working ? 1 : 0;
      }
    }
  }
  EXPECT_GT(copies, std::size(columns));
}

}  // namespace
}  // namespace edda::tile_loading_test
