#pragma once

namespace lobelia {

inline constexpr char kOurs[] = "lobelia";  ///< our name among the engines

}  // namespace lobelia
