// Records of strong-motion networks: one component of ground acceleration at equal steps of time.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"

namespace edda {

struct StrongMotion {
  double step = 0.0;                 ///< s
  std::vector<double> acceleration;  ///< in units of the file, or m/s2 where it has counts
  double unit = 1.0;                 ///< m/s2, of these
  std::string read_as;               ///< "K-NET record in gal"
};

/// Reads the `component`-th component, from 1, of a record in the format of K-NET, COSMOS (V1, V2)
/// or CSMIP (V2), ESM (.ASC) or GeoNet (V1A, V2A), which is recognised by its head; nothing for
/// another text. Faults: a record without step, unit or as many values as its head states, without
/// that component, or of velocities.
std::optional<Result<StrongMotion>> read_strong_motion(std::string_view text, int component,
                                                       const std::string& path,
                                                       const std::string& key);

/// m/s2 of a unit of acceleration as files write it: "g", "cm/s^2", "cm/sec/sec", "gal"; nothing
/// for another text.
std::optional<double> acceleration_unit(std::string_view name);

/// What records are read, for messages.
inline constexpr const char* records_read =
    "records of PEER (AT2), K-NET, COSMOS and CSMIP (V1, V2), ESM (ASC) and GeoNet (V1A, V2A) are "
    "read, and CSV files of time,ax,ay or of time and one component";

}  // namespace edda
