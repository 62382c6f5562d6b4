// Texts of drawings that are not in UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace edda {

/// The drawing in UTF-8, with its lines as they were: as it is where it is valid UTF-8, else from
/// the code page that it names ($DWGCODEPAGE), where that is known, else from Western European
/// (ANSI_1252). Characters written as \U+00FC become themselves.
std::string utf8_of(std::string_view drawing);

}  // namespace edda
