// A results folder as the replay page sees it: its frames, tables and names. May grow while it is
// looked at.
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

/// A point or a line of the model, where it was at the start, m.
struct ViewMark {
  std::string name;
  std::vector<Vec2> points;
};

/// What the model knows and the results do not; a page does without it.
struct ViewNames {
  std::string title;
  std::vector<std::string> materials;
  std::vector<ViewMark> monitors;      ///< one point each
  std::vector<ViewMark> convergences;  ///< two
  double least_stress = 0.0;           ///< Pa; where none is larger they are rounding
  bool judges_rock = true;             ///< a material has a strength: overstress means something
};

/// Smallest and largest value of a field of pictures in the frames so far; held blocks do not
/// count.
struct ViewRange {
  double low = 0.0, high = 0.0;
  bool any = false;
  /// But for a few blocks that lie far beyond, of each frame (report/drawn_range.hpp).
  double inner_low = 0.0, inner_high = 0.0;
  Ends last, last_inner;  ///< the same of the last frame that has any
};

/// Of what strokes stand for in the frames so far.
struct ViewSizes {
  double usual = 0.0;  ///< of a stroke of the usual length
  double largest = 0.0;
};

class ViewRun {
 public:
  /// Faults: no results there, frames that do not fit together.
  static Result<ViewRun> open(std::string folder, ViewNames names);

  /// The frames there are, in order of time.
  Result<std::vector<SeriesEntry>> series() const;
  /// Takes up a frame that is later than those taken up so far, and packs it. The bytes are not
  /// deflated.
  Result<std::string> take(const SeriesEntry& frame, ViewPrecision precision);
  /// Packs one of those taken up once more.
  Result<std::string> again(std::size_t frame, ViewPrecision precision) const;
  /// Packs any frame without taking it up, to see how large it is.
  Result<std::string> probe(const SeriesEntry& frame, ViewPrecision precision) const;

  const ViewMesh& mesh() const { return mesh_; }
  const std::vector<ViewDatum>& datums() const { return datums_; }
  std::size_t frames() const { return taken_.size(); }
  /// A table of the folder, of a history about `most_rows` rows with all its peaks, of the bolts
  /// the rows at the frames taken up; empty where there is none.
  std::string table(const std::string& name, std::size_t most_rows) const;
  /// What the page is told before anything else, as JSON (view/page/src/data/run.ts). `served_as`:
  /// chunks are to be fetched, and another text than before tells that they are of another run;
  /// empty: they are in the page.
  std::string header(const std::string& served_as = {}) const;
  /// Whether the folder still holds this run: the same files, and the frames taken up so far.
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
  std::vector<std::string> absent_;  ///< numbers of blocks that these frames have not
  std::vector<ViewDatum> datums_;
  std::vector<Taken> taken_;
  std::map<std::string, ViewRange> ranges_;  ///< by name of the field
  ViewSizes forces_;                         ///< of closed contacts, N
  ViewSizes pressures_;   ///< at ends of closed faces, Pa; the largest in compression
  double tension_ = 0.0;  ///< the largest there, Pa
  ViewSizes stresses_;    ///< principal, of blocks that are not held, Pa
};

/// Tables that a page takes along.
inline constexpr const char* view_tables[] = {"history.csv", "stages.csv", "bolts.csv"};

}  // namespace edda
