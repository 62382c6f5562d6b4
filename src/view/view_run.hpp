// A results folder as the replay page sees it: its frames, tables and names. The run may still be
// in progress.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "report/drawn_range.hpp"
#include "results/vtu.hpp"
#include "view/frame.hpp"

namespace edda {

/// A point or a line of the model, in its initial position, m.
struct ViewMark {
  std::string name;
  std::vector<Vec2> points;
};

/// Data that only the model has, not the results; a page works without them.
struct ViewNames {
  std::string title;
  std::vector<std::string> materials;
  std::vector<ViewMark> monitors;      ///< one point each
  std::vector<ViewMark> convergences;  ///< two
  double least_stress = 0.0;           ///< Pa; where none is larger they are rounding
  bool judges_rock = true;             ///< a material has a strength, so that overstress is defined
};

/// Smallest and largest value of a field of pictures in the frames so far; fixed blocks do not
/// count.
struct ViewRange {
  double low = 0.0, high = 0.0;
  bool any = false;
  /// Without a few outliers of each frame (report/drawn_range.hpp).
  double inner_low = 0.0, inner_high = 0.0;
  Ends last, last_inner;  ///< the same of the last frame that has any
};

/// Sizes of the quantities that lines represent in the frames so far.
struct ViewSizes {
  double usual = 0.0;  ///< value of a line of the usual length
  double largest = 0.0;
};

class ViewRun {
 public:
  /// Faults: no results there, frames that do not fit together.
  static Result<ViewRun> open(std::string folder, ViewNames names);

  /// The frames there are, in order of time.
  Result<std::vector<SeriesEntry>> series() const;
  /// Adds a frame that is later than those added so far, and packs it. The bytes are not
  /// deflated.
  Result<std::string> take(const SeriesEntry& frame, ViewPrecision precision);
  /// Packs an added frame once more.
  Result<std::string> again(std::size_t frame, ViewPrecision precision) const;
  /// Packs any frame without adding it, to find its size.
  Result<std::string> probe(const SeriesEntry& frame, ViewPrecision precision) const;

  const ViewMesh& mesh() const { return mesh_; }
  const std::vector<ViewDatum>& datums() const { return datums_; }
  std::size_t frames() const { return taken_.size(); }
  /// A table of the folder, of a history about `most_rows` rows with all its peaks, of the bolts
  /// the rows at the added frames; empty where there is none.
  std::string table(const std::string& name, std::size_t most_rows) const;
  /// The header of the page as JSON (page/src/data/run.ts). `served_as`: chunks are to be fetched,
  /// and another text than before means that they belong to another run; empty: they are in the
  /// page.
  std::string header(const std::string& served_as = {}) const;
  /// Whether the folder still holds this run: the same files, and the frames added so far.
  bool is_still_there() const;
  /// When the run's first files were written; another run has other times.
  const std::string& stamp() const { return stamp_; }

 private:
  struct Taken {
    SeriesEntry entry;
    std::size_t datum = 0;
  };
  struct Grids {
    Grid blocks;
    std::optional<Grid> contacts;
  };
  /// A frame's grids, and its blocks as rows of the mesh.
  struct Opened {
    Grids grids;
    ViewBlocks in;
  };
  Result<Opened> open_frame(const SeriesEntry& frame) const;
  std::string pack(const Opened& frame, ViewPrecision precision, std::size_t datum) const;
  Result<std::string> read_and_pack(const SeriesEntry& frame, ViewPrecision precision,
                                    std::size_t datum) const;
  void widen_ranges(const Opened& frame);
  std::string stamp_of(const SeriesEntry& first) const;

  std::string folder_;
  ViewNames names_;
  ViewMesh mesh_;
  std::string stamp_;
  std::vector<std::string> absent() const;
  std::vector<std::string> absent_;  ///< numbers of blocks that these frames do not have
  std::vector<ViewDatum> datums_;
  std::vector<Taken> taken_;
  std::map<std::string, ViewRange> ranges_;  ///< by name of the field
  ViewSizes forces_;                         ///< of closed contacts, N
  ViewSizes pressures_;   ///< at ends of closed faces, Pa; the largest in compression
  double tension_ = 0.0;  ///< the largest there, Pa
  bool cracked_ = false;  ///< joints have broken
  ViewSizes stresses_;    ///< principal, of free blocks, Pa
};

/// Tables that a page contains.
inline constexpr const char* view_tables[] = {"history.csv", "stages.csv", "bolts.csv",
                                              "linings.csv"};

}  // namespace edda
