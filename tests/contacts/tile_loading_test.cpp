// Rows of faces taken into tiles.
#include "contacts/tile_loading.hpp"

#include <gtest/gtest.h>

#include "contacts/drifting_heap.hpp"
#include "contacts/tile_columns.hpp"

namespace edda::tile_loading_test {
namespace {

/// Work may be all that a row has: no step makes such a row, but a file may hold it. Both copies of
/// a face keep it.
TEST(TileLoading, KeepsTheWorkOfFacesThatCarryNothing) {
  using Work = FaceWorkColumns<double>;
  constexpr double FaceFields<double>::*rows[] = {
      &FaceFields<double>::friction_work, &FaceFields<double>::transfer,
      &FaceFields<double>::trial_a,       &FaceFields<double>::trial_b,
      &FaceFields<double>::shear_a,       &FaceFields<double>::shear_b,
      &FaceFields<double>::damping_work,  &FaceFields<double>::damping_due};
  constexpr double Work::*columns[] = {&Work::friction_work, &Work::transfer,   &Work::trial_a,
                                       &Work::trial_b,       &Work::shear_a,    &Work::shear_b,
                                       &Work::damping_work,  &Work::damping_due};
  std::mt19937 rng(7);
  DriftingHeap heap(odd_polygons(rng, 40));
  FaceSet& c = heap.contacts;
  find_faces(c, heap.blocks, heap.state, heap.pose, heap.laws, 0.1);
  ASSERT_GT(c.size(), 100u);
  std::size_t copies = 0;
  for (std::size_t column = 0; column < std::size(columns); ++column) {
    c.clear_states();
    const std::size_t working = c.size() - 1 - 7 * column;
    FaceFields<double> row{};
    row.*rows[column] = 2.5;
    set_row(c.now, working, row);
    FaceTiles tiles;
    divide_blocks(tiles, heap.blocks, heap.state, true, 5);
    load_faces(tiles, c, heap.blocks, heap.pose);
    for (std::size_t k = 0; k < c.size(); ++k) {
      for (const Id place : tiles.place[k]) {
        if (place == no_id) continue;
        const auto work = get<Work>(tiles, tiles.now, place);
        EXPECT_EQ(work.*columns[column], k == working ? 2.5 : 0.0) << column << " of face " << k;
        copies += k == working ? 1 : 0;
      }
    }
  }
  EXPECT_GT(copies, std::size(columns));
}

}  // namespace
}  // namespace edda::tile_loading_test
