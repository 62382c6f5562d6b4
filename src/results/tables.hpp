// blocks.csv and joints.csv.
#pragma once

#include <span>
#include <string>

#include "results/records.hpp"

namespace edda {

std::string blocks_csv(std::span<const BlockRecord> blocks);
std::string joints_csv(std::span<const ContactRecord> contacts);

}  // namespace edda
