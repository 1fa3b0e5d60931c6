// The zones of a highlight, from its middle outward, by what share of its peak the lobe has there
// (docs/profiles.md). Those of the literature on such lobes are the epicentre and the blooming zone; it gives no
// limits, and what lies between is the flank.
#pragma once

#include <array>
#include <cstddef>

#include "records/profile.hpp"

namespace lobelia {

struct Zone {
  const char* name;   ///< as records have it
  const char* title;  ///< for people
  double lobe;        ///< at its outer end
};
inline constexpr std::size_t kZoneCount = 3;
inline constexpr std::array<Zone, kZoneCount> kZones = {{
    {"epicentre", "epicentre", 0.5},
    {"flank", "flank", 0.05},
    {"blooming", "blooming zone", 1e-3},
}};

/// Where each ends, in whatever grows outward.
using ZoneEnds = std::array<double, kZoneCount>;

/// The errors are NaN if the zone has no pixels.
using ZoneError = records::ZoneError;

/// The errors of a zone, a pixel after the other.
class ZoneErrorSum {
 public:
  void add(double difference);
  /// NaN of a zone without a pixel, or with a difference that is not finite.
  ZoneError error(double peak) const;

 private:
  std::size_t pixels_ = 0;
  double max_abs_ = 0, squares_ = 0;
  bool finite_ = true;
};

}  // namespace lobelia
