// Faces evaluated one by one are as those evaluated by chunks.
#include <gtest/gtest.h>

#include "contacts/drifting_heap.hpp"
#include "contacts/face_bonds.hpp"

namespace edda {
namespace {

template <class List, class Table>
void expect_same(const List& list, const Table& a, const Table& b) {
  for (const auto& column : list) {
    ASSERT_EQ((a.*column.values).values(), (b.*column.values).values());
  }
}

TEST(FacesOneByOne, AreAsInChunks) {
  std::mt19937 rng(6);
  DriftingHeap heap(odd_polygons(rng, 40));
  FaceSet& c = heap.contacts;
  find_faces(c, heap.blocks, heap.state, heap.pose, heap.laws, 0.1);
  for (int move = 0; move < 20; ++move) {
    next_step(c);
    heap.move_at_random(rng, 2e-3);
    FaceSet single = c;
    evaluate_faces(c, heap.scene(), 1e-3);
    for (std::size_t k = 0; k < single.size(); ++k) {
      evaluate_face(single, heap.scene(), 1e-3, k);
    }
    expect_same(face_properties, c, single);
    ASSERT_EQ(c.force, single.force);
    ASSERT_EQ(c.now.energy.values(), single.now.energy.values());
    ASSERT_EQ(c.now.slip_a.values(), single.now.slip_a.values());
  }
}

}  // namespace
}  // namespace edda
