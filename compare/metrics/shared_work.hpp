// Lets metrics of one comparison share intermediate results, so that each is computed once.
#pragma once

#include <any>
#include <map>
#include <string_view>
#include <utility>

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// Lives while the metrics of one work are measured at one exposure: a map of a large picture takes much memory.
class SharedWork {
 public:
  using Key = std::pair<std::string_view, const void*>;
  std::map<Key, std::any> made;
};

/// The result called `name`: made by `make` for the first metric that asks for it, and kept for the others of the same work.
/// With `by_region` each region has its own.
template <class Make>
auto shared(const MetricInput& input, std::string_view name, const Make& make,
            bool by_region = false) {
  using Made = std::shared_ptr<const decltype(make())>;
  const auto made = [&] { return Made(std::make_shared<decltype(make())>(make())); };
  if (!input.shared) return made();
  std::any& one = input.shared->made[{name, by_region ? input.region.data() : nullptr}];
  if (!one.has_value()) one = made();
  return std::any_cast<Made>(one);
}

}  // namespace lobelia
