// One frame: the blocks as their exact polygons, and the contacts.
#pragma once

#include <future>
#include <string>
#include <vector>

#include "blocks/block_set.hpp"
#include "results/grid.hpp"
#include "results/records.hpp"
#include "results/vtu.hpp"

namespace edda {

/// The cells of every block, made once: they never change.
struct BlockCells {
  std::vector<Id> begin;   ///< [nb + 1] first cell of each block
  std::vector<Id> end;     ///< of each cell in `corner`
  std::vector<Id> corner;  ///< points of all cells, each counter-clockwise: vertices, or the number
                           ///< of these plus a mesh node
  std::vector<Id> zone;    ///< of each cell, or no_id
};

/// Convex blocks are one cell; others, and those with holes, are triangles; meshed ones their
/// zones.
BlockCells block_cells(const BlockSet& blocks);

/// Cell fields id material fixed displacement velocity rotation omega stress principal_stress,
/// point fields displacement velocity. stress: XX YY ZZ XY YZ XZ; principal_stress: the larger and
/// the smaller in the plane, then the one across it. Pa. With zones also plastic_strain,
/// yields and strength_factor; their stresses are their own. The picture must outlive the source.
GridSource block_source(const BlockCells& cells, const Picture& picture);
/// The same in memory.
Grid block_grid(const BlockCells& cells, const Picture& picture);

/// A vertex cell per contact, in the middle of its overlap, with the values of joints.csv and the
/// vectors force (on block_i) and displacement (of block_i there). The picture must outlive it.
GridSource contact_source(const Picture& picture);

/// The file of a frame's contacts, from that of its blocks.
std::string contacts_beside(std::string blocks_file);

/// Frames in `folder`/frames and the two time series beside it.
class FrameSeries {
 public:
  FrameSeries(std::string folder, const BlockSet& blocks);
  FrameSeries(const FrameSeries&) = delete;
  FrameSeries& operator=(const FrameSeries&) = delete;
  /// Takes the frame, which a thread of its own writes. Returns the trouble of a frame before,
  /// after which none is written any more, as all of these.
  Trouble add(Picture picture);
  /// The time series name the last frame if it has been written by now. They do so at once while
  /// there are few; later they grow by a thousandth at a time, so that many frames do not take the
  /// square of their number to write.
  Trouble collect();
  /// The same, once it has been written.
  Trouble finish();
  /// Brings the time series up to it.
  Trouble write_series();
  /// Times of the frames so far, s; to continue after existing frames.
  std::vector<double> times() const;
  void go_on_after(const std::vector<double>& times);

 private:
  void enter(double time);
  Trouble write_lists();
  std::string folder_;
  BlockCells cells_;
  std::vector<SeriesEntry> blocks_, contacts_;  ///< frames that have been written
  std::size_t in_series_ = 0;                   ///< how many of them the time series name
  Trouble trouble_;
  double time_ = 0.0;            ///< s, of the frame that is being written
  std::future<Trouble> writes_;  ///< destroyed first, which waits for it
};

}  // namespace edda
