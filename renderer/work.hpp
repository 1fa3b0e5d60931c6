// The work of a picture, counted during rendering.
#pragma once

#include <array>
#include <cstdint>

#include "renderer/plan/effects/catalogue.hpp"

namespace lobelia {

struct Work {
  /// By effect, in the effect's unit; zero if it is off.
  std::array<std::uint64_t, Effects::kSize> of_effect{};
  std::uint64_t camera_rays = 0, shadow_rays = 0, mirror_rays = 0, scattered_rays = 0;

  template <class Effect>
  std::uint64_t& of() {
    return of_effect[index_of<Effect>(Effects{})];
  }
  Work& operator+=(const Work& other) {
    for (std::size_t i = 0; i < of_effect.size(); ++i) of_effect[i] += other.of_effect[i];
    camera_rays += other.camera_rays;
    shadow_rays += other.shadow_rays;
    mirror_rays += other.mirror_rays;
    scattered_rays += other.scattered_rays;
    return *this;
  }
};

}  // namespace lobelia
