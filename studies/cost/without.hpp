// A scene without one of the effects of the plan's catalogue.
#pragma once

#include <string_view>

#include "renderer/plan/plan.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

struct Without {
  Scene scene;
  Experiment experiment;  ///< what no change of the scene can say
};

/// With nothing else changed: a light with a size becomes a point of the same power, surfaces keep their
/// highlights. Throws Error(kInternal) for an effect that it does not know.
Without without(std::string_view effect, Scene scene);

/// What stands in its place, in words: "pinhole".
std::string_view in_place_of(std::string_view effect);

}  // namespace lobelia::cost
