// A highlight's profile as charts.
#pragma once

#include <string>

#include "core/svg_chart.hpp"
#include "gallery/farm_data.hpp"
#include "gallery/profile_data.hpp"

namespace lobelia::gallery {

/// The curve that the formula itself gives, as the record calls it.
inline constexpr char kAnalytic[] = "analytic";

/// "formula", or the engine's title.
std::string curve_title(const FarmData& farm, const std::string& name);

/// Radiance over angle, linear: the formula broad and pale, the engines' lines over it.
Chart radiance_chart(const FarmData& farm, const ProfileData& profile);

/// |engine - formula| over angle, logarithmic: the one subtraction that the gallery makes, for
/// drawing alone. A chart without series if no curve differs at all.
Chart difference_chart(const FarmData& farm, const ProfileData& profile,
                       const NamedCurve& analytic);

}  // namespace lobelia::gallery
