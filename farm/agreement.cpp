#include "farm/agreement.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"

namespace lobelia {

Tolerance agreement(std::string_view engine, std::vector<std::uint8_t> edges) {
  constexpr std::int64_t kAllowedOutliers = 3;
  if (engine == "povray") return {6e-4, 1e-8, kAllowedOutliers, std::move(edges)};
  if (engine == "blender") return {0, 3e-5, kAllowedOutliers, std::move(edges)};
  if (engine == "analytic") return {0, 1e-5, kAllowedOutliers, std::move(edges)};
  throw Error(ExitCode::kInternal, fmt::format("no tolerance is known for '{}'", engine));
}

}  // namespace lobelia
