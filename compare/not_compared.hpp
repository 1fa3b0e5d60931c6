// The parts of two files that a comparison did not look at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/record.hpp"

namespace lobelia {

struct NotCompared {
  std::vector<std::string> layers;   ///< of either; "" is the picture itself
  bool alpha = false;                ///< there is one, that of the picture
  std::int64_t overscan_pixels = 0;  ///< outside of the display window
  int mip_levels = 0;                ///< besides the first

  bool is_empty() const;
};

/// Adds what was not compared of another pair: names once, pixels as a sum, levels at their most.
void add(const NotCompared& one, NotCompared& all);

/// "layers 'N', 'Z'; 3 MIP levels"; "nothing" if it is empty. Of very many layers the first 40.
std::string to_text(const NotCompared& not_compared);

/// `notCompared` of docs/records.md
Json to_json(const NotCompared& not_compared);

}  // namespace lobelia
