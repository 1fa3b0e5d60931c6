#include "compare/not_compared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/text.hpp"

namespace lobelia {
namespace {

std::string layers_text(const std::vector<std::string>& layers) {
  constexpr std::size_t kShown = 40;  // a hostile file has thousands
  std::string text = layers.size() == 1 ? "layer " : "layers ";
  for (std::size_t i = 0; i < std::min(layers.size(), kShown); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ",
                        layers[i].empty() ? "of the picture" : "'" + printable(layers[i]) + "'");
  if (layers.size() > kShown) text += fmt::format(" and {} more", layers.size() - kShown);
  return text;
}

}  // namespace

bool is_empty(const NotCompared& not_compared) {
  return not_compared.layers.empty() && !not_compared.alpha && not_compared.overscan_pixels == 0 &&
         not_compared.mip_levels == 0;
}

void add(const NotCompared& one, NotCompared& all) {
  const std::set<std::string> known(all.layers.begin(), all.layers.end());
  for (const std::string& name : one.layers)
    if (!known.contains(name)) all.layers.push_back(name);
  all.alpha = all.alpha || one.alpha;
  all.overscan_pixels += one.overscan_pixels;
  all.mip_levels = std::max(all.mip_levels, one.mip_levels);
}

std::string to_text(const NotCompared& not_compared) {
  std::vector<std::string> parts;
  if (!not_compared.layers.empty()) parts.push_back(layers_text(not_compared.layers));
  if (not_compared.alpha) parts.emplace_back("alpha");
  if (not_compared.overscan_pixels > 0)
    parts.push_back(
        fmt::format("{} pixels outside of the display window", not_compared.overscan_pixels));
  if (not_compared.mip_levels > 0)
    parts.push_back(fmt::format("{} smaller MIP level{}", not_compared.mip_levels,
                                not_compared.mip_levels == 1 ? "" : "s"));
  if (parts.empty()) return "nothing";
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace lobelia
