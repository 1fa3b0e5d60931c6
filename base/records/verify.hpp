// Records of `lobelia verify profiles` and `lobelia verify highlights`.
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

/// Beside a light of so many times the highlight's peak.
struct LightBeside {
  double light = 0;
  bool differs = false, is_right = false;
};

struct ChangedHighlight {
  std::string highlight, change;
  bool should_differ = false;
  std::vector<LightBeside> lights;
};

struct VerifyHighlights {
  std::vector<std::string> command;
  std::size_t wrong = 0;
  std::vector<ChangedHighlight> changes;
};

void define_verify_tables(Tables& tables);

}  // namespace lobelia::records
