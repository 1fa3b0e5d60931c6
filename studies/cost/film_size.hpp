// Pictures of a size that can be measured in a given time.
#pragma once

#include <algorithm>

#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

/// The scene with the longer side of its picture as given, in the same proportions.
inline Scene with_film(Scene scene, int side) {
  Film& film = scene.film;
  const double scale = double(side) / std::max(film.width, film.height);
  film.width = std::max(1, int(scale * film.width + 0.5));
  film.height = std::max(1, int(scale * film.height + 0.5));
  return scene;
}

}  // namespace lobelia::cost
