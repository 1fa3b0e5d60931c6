// Which ways are worth their time: those of which none is both as fast and as accurate.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cost/table.hpp"

namespace lobelia::cost {

inline constexpr std::size_t kNone = std::size_t(-1);

/// By one of a table's errors. Medians decide; of ways that are equal in both, the first counts.
struct Front {
  std::vector<std::size_t> ways;  ///< not dominated, from the fastest to the most accurate
  std::vector<std::size_t>
      dominated_by;  ///< by way: one of the front, or kNone for the front itself
};

/// Ways whose error is not known are neither on the front nor dominated.
Front pareto_front(const Table& table, std::size_t error);

/// Along the front, "from cs16 to cosine: 1.8 times the time, 170 times less error", and for each way that is
/// dominated, by what: "cs64 takes 1.2 times the time of cosine and has 17 times its error".
std::vector<std::string> front_sentences(const Table& table, std::size_t error);

/// 0 where nothing separates them: b is slower than a by more than the spread of both, or -1 if faster.
int clearly_slower(const Way& a, const Way& b);

}  // namespace lobelia::cost
