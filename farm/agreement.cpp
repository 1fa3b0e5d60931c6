#include "farm/agreement.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "renderer/edge_map.hpp"

namespace lobelia {

Tolerance agreement(std::string_view engine, const Scene& scene) {
  constexpr std::int64_t kAllowedOutliers = 3;
  if (engine == "povray") return {6e-4, 1e-8, kAllowedOutliers, edge_map(scene)};
  if (engine == "blender") return {0, 3e-5, kAllowedOutliers, edge_map(scene)};
  throw Error(ExitCode::kInternal, fmt::format("no tolerance is known for '{}'", engine));
}

}  // namespace lobelia
