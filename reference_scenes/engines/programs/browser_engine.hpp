// What engines for browsers have in common: engine_browser.cpp with a page.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace lobelia {

/// The page decides the pictures, too.
inline std::vector<std::filesystem::path> page_of(const std::filesystem::path& program,
                                                  std::string_view) {
  return {program.string() + ".html"};
}

}  // namespace lobelia
