// Rows of faces taken into tiles.
#include "contacts/tile_loading.hpp"

#include <gtest/gtest.h>

#include "contacts/drifting_heap.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/tile_columns.hpp"

namespace edda::tile_loading_test {
namespace {

/// Work may be all that a row has: no step makes such a row, but a file may hold it.
TEST(TileLoading, KeepsTheWorkOfFacesThatCarryNothing) {
  std::mt19937 rng(7);
  DriftingHeap heap(odd_polygons(rng, 40));
  FaceSet& c = heap.contacts;
  heap.pose.x1 = heap.pose.x;
  heap.pose.y1 = heap.pose.y;
  find_faces(c, heap.blocks, heap.state, heap.pose, heap.laws, 0.1);
  mark_bonded_chunks(c);
  c.clear_states();
  ASSERT_GT(c.size(), 3 * lanes);
  const std::size_t working = c.size() - 1;
  c.now.friction_work[working] = 2.5;
  FaceTiles tiles;
  divide_blocks(tiles, heap.blocks, heap.state, true);
  load_faces(tiles, c, heap.blocks, heap.pose);
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id place = tiles.place[k][0];
    ASSERT_NE(place, no_id);
    const auto work = get<FaceWorkColumns<double>>(tiles, tiles.now, place);
    EXPECT_EQ(work.friction_work, k == working ? 2.5 : 0.0) << k;
  }
}

}  // namespace
}  // namespace edda::tile_loading_test
