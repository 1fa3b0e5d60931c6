// Bounds that every number of a scene keeps.
#pragma once

namespace lobelia {

inline constexpr double kFar = 1e9;        ///< of every coordinate and length
inline constexpr double kNear = 1e-9;      ///< the least length of what has a size
inline constexpr double kBrightest = 1e9;  ///< of every irradiance, intensity and radiance

}  // namespace lobelia
