// Bounds of the numbers in a scene.
#pragma once

namespace lobelia {

inline constexpr double kFar = 1e9;        ///< of every coordinate and length
inline constexpr double kNear = 1e-9;      ///< the least size
inline constexpr double kBrightest = 1e9;  ///< of every irradiance, intensity and radiance

}  // namespace lobelia
