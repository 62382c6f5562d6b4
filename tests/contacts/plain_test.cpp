// Chunks whose faces are all plain are evaluated by a shorter loop: both loops must give the same
// bits.
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

void expect_same(const FaceSet& a, const FaceSet& b) {
  expect_same(face_properties, a, b);
  expect_same(face_columns, a.now, b.now);
  expect_same(face_columns, a.before, b.before);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.deepest, b.deepest);
  EXPECT_EQ(a.switching, b.switching);
}

/// A heap that moves at random, evaluated twice: once with all chunks marked plain, once with none.
void drift_twice(double damping) {
  std::mt19937 rng(5);
  DriftingHeap heap(odd_polygons(rng, 60));
  FaceSet& c = heap.contacts;
  find_faces(c, heap.blocks, heap.state, heap.pose, heap.laws, 0.1);
  set_face_dashpots(c, heap.laws, damping);
  std::uniform_real_distribution<double> locked(0.0, 2e-3);
  for (std::size_t k = 0; k < c.size(); k += 3) {
    c.locked_closure_a[k] = locked(rng);
    c.locked_closure_b[k] = locked(rng);
  }
  std::size_t plain = 0, rare = 0, carrying = 0;
  for (int move = 0; move < 60; ++move) {
    next_step(c);
    heap.move_at_random(rng, 2e-3);
    FaceSet whole = c;
    std::fill(whole.plain.begin(), whole.plain.end(), std::uint8_t{0});
    std::fill(c.plain.begin(), c.plain.end(), std::uint8_t{1});
    evaluate_faces(c, heap.scene(), 1e-3);
    evaluate_faces(whole, heap.scene(), 1e-3);
    expect_same(c, whole);
    if (testing::Test::HasFatalFailure()) return;
    for (std::size_t q = 0; q < c.chunks(); ++q) {
      (c.plain[q] > 0 ? plain : rare) += 1;
      carrying += c.plain[q] > 0 && c.deepest[q] > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(plain, 100u);
  EXPECT_GT(carrying, 20u);
  EXPECT_GT(rare, 100u);
}

TEST(PlainFaces, AreAsThoseThatAreNot) {
  drift_twice(0.0);
}
TEST(PlainFaces, AreAsThoseThatAreNotWithDashpots) {
  drift_twice(0.2);
}

/// Faces evaluated one by one are as those evaluated by chunks.
TEST(PlainFaces, AreTheSameOneByOne) {
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
