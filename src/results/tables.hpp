// blocks.csv and joints.csv.
#pragma once

#include <span>
#include <string>

#include "results/files.hpp"
#include "results/records.hpp"

namespace edda {

Trouble write_blocks_csv(const std::string& path, std::span<const BlockRecord> blocks);
Trouble write_joints_csv(const std::string& path, std::span<const ContactRecord> contacts);

}  // namespace edda
