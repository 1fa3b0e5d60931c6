// The parts of two files that a comparison did not look at.
#pragma once

#include <string>

#include "records/comparison.hpp"

namespace lobelia {

using NotCompared = records::NotCompared;

bool is_empty(const NotCompared& not_compared);

/// Adds what was not compared of another pair: names once, pixels as a sum, levels at their most.
void add(const NotCompared& one, NotCompared& all);

/// "layers 'N', 'Z'; 3 MIP levels"; "nothing" if it is empty. Of very many layers the first 40.
std::string to_text(const NotCompared& not_compared);

}  // namespace lobelia
