// Records of `lobelia verify profiles`.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

/// One figure in all pictures of a kind.
struct FigureCoverage {
  std::string figure;
  int figures = 0, within_one = 0, within_two = 0, missing = 0;
  double median_distance = 0, worst_distance = 0, median_error = 0;
};

struct KindCoverage {
  std::string name;
  int pictures = 0;
  double share = 0, median_distance = 0;
  std::vector<FigureCoverage> figures;
};

struct VerifyProfiles {
  std::vector<std::string> command;
  std::int64_t seed = 0;
  double goal = 0;
  std::size_t outside = 0;
  std::vector<KindCoverage> kinds;
};

void define_verify_tables(Tables& tables);

}  // namespace lobelia::records
