// The parameter with which one model looks most like another, and what rules of thumb make of it.
#pragma once

#include "records/conversion.hpp"
#include "studies/convert/curve.hpp"

namespace lobelia::conversion {

/// By records::kConversionMeasures.
enum class Measure : std::uint8_t { kMax, kWidth, kEnergy, kCiede2000 };

struct Request {
  ShadingModel from, to;
  double parameter = 0;  ///< of `from`; not used for a range
  double f0 = 1;
  Measure measure = Measure::kMax;  ///< the best by this one is drawn
};

/// A parameter in its range, and whether it lies at the end of it.
struct Best {
  double parameter;
  bool at_end;
};
Best best_parameter(const Request& request, Measure measure);

records::Conversion convert(const Request& request);

}  // namespace lobelia::conversion
