#include "studies/cost/without.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "renderer/plan/effects/catalogue.hpp"

namespace lobelia::cost {
namespace {

struct LeftOut {
  std::string_view effect, instead;
  void (*leave_out)(Scene&, Experiment&);
};

LeftOut find(std::string_view effect) {
  static constexpr auto kAll = map_types<LeftOut>(Effects{}, []<class E>() {
    return LeftOut{E::kName, E::kWithout, &E::leave_out};
  });
  const auto* const found = std::ranges::find(kAll, effect, &LeftOut::effect);
  if (found == kAll.end())
    throw Error(ExitCode::kInternal, fmt::format("there is no effect {}", effect));
  return *found;
}

}  // namespace

Without without(std::string_view effect, Scene scene) {
  Without result{std::move(scene), {}};
  find(effect).leave_out(result.scene, result.experiment);
  return result;
}

std::string_view in_place_of(std::string_view effect) { return find(effect).instead; }

}  // namespace lobelia::cost
