// A highlight's profile as charts.
#pragma once

#include <string>

#include "core/svg_chart.hpp"
#include "gallery/shown_farm.hpp"
#include "records/pages.hpp"
#include "records/profile.hpp"

namespace lobelia::gallery {

using records::kAnalytic;

/// From the middle outward.
std::vector<records::ShownZone> zones_of(const records::Profile& profile);

/// "formula", or the engine's title.
std::string curve_title(const ShownFarm& farm, const std::string& name);

/// Radiance over angle, linear: the formula broad and pale, the engines' lines over it.
Chart radiance_chart(const ShownFarm& farm, const records::Profile& profile);

/// |engine - formula| over angle, logarithmic: the one subtraction that the gallery makes, for
/// drawing alone. A chart without series if no curve differs at all.
Chart difference_chart(const ShownFarm& farm, const records::Profile& profile,
                       const std::vector<double>& analytic);

}  // namespace lobelia::gallery
