// Rock between drawn blocks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cutting/polygon_set.hpp"
#include "imports/imports.hpp"

namespace edda {

/// A warning of blocks, cut from lines without a domain, that no closed line encloses although
/// closed lines enclose others: the span of an arch, the windows of a wall. blocks: relative to
/// `origin`.
std::optional<std::string> unenclosed_warning(const Imports& imports,
                                              const std::vector<BlockPolygon>& blocks, Vec2 origin);

}  // namespace edda
