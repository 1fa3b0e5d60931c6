// profile.json as data: the highlight as curves over the angle that its lobe sees.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gallery/fields.hpp"

namespace lobelia::gallery {

struct ProfileZone {
  std::string title;        ///< "blooming zone"
  double from = 0, to = 0;  ///< degrees
};

/// A curve or a row of figures, by the engine's name; "analytic" is the formula itself.
struct NamedCurve {
  std::string name;
  std::vector<double> values;
};

struct ZoneDifference {
  std::string zone;     ///< "epicentre", "flank", "blooming"
  NamedNumbers values;  ///< "maxAbs", "rms", "maxRelPeak"
};

struct ProfileData {
  std::string file;                ///< a plain name; empty: the cell has no profile
  std::string problem;             ///< why it cannot be read; empty if it can
  std::string angle;               ///< "reflection" or "half vector"
  std::vector<ProfileZone> zones;  ///< from the middle outward
  std::vector<double> degrees;
  std::vector<NamedCurve> curves;  ///< each as long as degrees
  std::vector<std::pair<std::string, NamedNumbers>>
      images;  ///< the fitted exponent and its error too
  std::vector<std::pair<std::string, std::vector<ZoneDifference>>> differences;

  const NamedCurve* find_curve(const std::string& name) const;
};

/// Of a zone as records name it: "blooming zone"; an unknown one keeps its name.
std::string zone_title(const std::string& zone);

/// Never throws for what the record says: that becomes `problem`.
ProfileData read_profile(const std::filesystem::path& directory, const std::string& file);

}  // namespace lobelia::gallery
