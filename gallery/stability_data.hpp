// What stability.json says, read with care.
#pragma once

#include <string>
#include <vector>

#include "gallery/fields.hpp"

namespace lobelia::gallery {

/// The largest error of several cases; infinite where one gave no number.
struct WorstError {
  double of_peak = 0, ulp = 0, wrong_pixels = 0;
};

struct StabilitySummary {
  std::string group, name, meaning;  ///< the name of a case, or of a lobe
  double exponent = 0, cases = 0, outside = 0, of_bound = 0;
  WorstError naive, ours;
};

/// A highlight along a line across it, of the peak.
struct StabilityCurve {
  double exponent = 0;
  std::string model, lobe;
  std::vector<double> degrees, truth, naive, ours;
};

struct StabilityPicture {
  double exponent = 0;
  std::string naive, ours, naive_error, ours_error;  ///< plain names beside the record
  double naive_off = 0, ours_off = 0;                ///< largest error of the peak
};

struct StabilityData {
  std::string command, instruction_set;
  double cases = 0, outside = 0, not_compared = 0;
  NamedTexts groups;  ///< with what they mean
  std::vector<StabilitySummary> by_case, by_exponent;
  std::vector<StabilityCurve> curves;
  std::vector<StabilityPicture> pictures;
};

/// Throws Error(kInput).
StabilityData read_stability(const Fields& record);

}  // namespace lobelia::gallery
