#include "accuracy/pixel_subset.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lobelia::accuracy {

Scene pixel_subset(const Scene& scene, int side) {
  const Film& film = scene.film;
  // An odd number, for whose middle is a pixel's centre too; and no more than there are rows.
  int every = (std::max(film.width, film.height) + side - 1) / side;
  every = std::min({every | 1, film.width, film.height});
  if (every % 2 == 0) --every;
  if (every <= 1) return scene;
  Scene subset = scene;
  subset.film.width = film.width / every;
  subset.film.height = film.height / every;
  const CameraFrame frame = camera_frame(scene.camera, film);
  const double half_width = frame.half_width * every * subset.film.width / film.width;
  const double half_height = frame.half_height * every * subset.film.height / film.height;
  subset.camera.fov_degrees = 2 * std::atan(half_width) * 180 / std::numbers::pi;
  // The upper left corner stays where it is.
  subset.camera.principal_point_offset_x =
      -(frame.shift_u + half_width - frame.half_width) / (2 * half_width);
  subset.camera.principal_point_offset_y =
      -(frame.shift_v + frame.half_height - half_height) / (2 * half_height);
  return subset;
}

}  // namespace lobelia::accuracy
