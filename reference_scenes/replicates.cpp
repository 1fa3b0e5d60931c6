#include "reference_scenes/replicates.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "base/words/constants.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/scene/lights/prepared_light.hpp"
#include "renderer/sobol.hpp"

namespace lobelia {
namespace {

/// The points of one replicate.
class Points {
 public:
  explicit Points(std::uint32_t replicate) : replicate_(replicate) {}
  /// Starts the next point.
  void next() {
    ++index_;
    dimension_ = 0;
  }
  /// Its next two coordinates, in [0, 1).
  sobol::Pair operator()() { return sobol::pair(replicate_, index_, dimension_++); }

 private:
  std::uint32_t replicate_, index_ = ~0u, dimension_ = 0;
};

Lamp random_lamp(const PreparedLight& light, Points& points) {
  const auto [u, v] = points();
  return light.lamp(u, v);
}

bool camera_varies(const Scene& scene) {
  return scene.sampler.sample_count > 1 || scene.camera.aperture_radius > 0;
}

/// Makes a pinhole at a point of the lens, with the film moved so that the plane of focus stays in place.
void look_through(const Scene& scene, Points& points, Camera& camera) {
  const auto [u, v] = points();
  const double radius = scene.camera.aperture_radius * std::sqrt(u), turn = 2 * kPi * v;
  const double x = radius * std::cos(turn), y = radius * std::sin(turn);
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const Vec3 aside = x * frame.right + y * frame.up;
  camera.origin = camera.origin + aside;
  camera.target = camera.target + aside;
  camera.principal_point_offset_x += x / (2 * camera.focus_distance * frame.half_width);
  camera.principal_point_offset_y += y / (2 * camera.focus_distance * frame.half_height);
  camera.aperture_radius = 0;
}

/// Sends every pixel's ray through the same place of the filter and returns its weight. Also draws which part of the filter,
/// positive or negative, so that one point is enough.
double move_film(const Film& film, const FilterSampler& filter, Points& points, Camera& camera) {
  const auto [u, v] = points();
  const double scale = 1 + 2 * filter.negative_weight();  // of |filter|
  const double share = filter.negative_weight() / scale;
  const bool negative = u < share;
  const auto [x, y] = filter(negative, negative ? u / share : (u - share) / (1 - share), v);
  camera.principal_point_offset_x -= x / film.width;
  camera.principal_point_offset_y += y / film.height;  // rows count downwards
  return negative ? -scale : scale;
}

/// The scene with one sample, no filter and no lights.
Scene without_softness(const Scene& scene) {
  Scene simple = scene;
  simple.sampler.sample_count = 1;
  simple.film.filter = {};
  simple.lights.clear();
  return simple;
}

struct SeenSurface {
  double distance = kInfinity;
  int index = -1;  ///< spheres first, then planes; -1: none
};

/// The nearest surface along a ray of unit direction.
SeenSurface first_surface(const Scene& scene, Vec3 origin, Vec3 direction) {
  SeenSurface nearest;
  if (const auto hit = nearest_hit(scene, origin, direction))
    nearest = {length(hit->point - origin), hit->sphere};
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    const double t = dot(plane.point - origin, plane.normal) / dot(direction, plane.normal);
    if (t > 0 && t < nearest.distance) nearest = {t, int(scene.spheres.size() + k)};
  }
  return nearest;
}

}  // namespace

bool needs_replicates(const Scene& scene) {
  return camera_varies(scene) || !std::ranges::all_of(scene.lights, is_delta);
}

std::vector<Replicate> replicates(const Scene& scene, int count, int points, std::uint64_t seed) {
  const auto lights = prepare(scene.lights);
  const FilterSampler filter(scene.film.filter);
  std::vector<Replicate> result;
  for (int r = 0; r < count; ++r) {
    Points next(sobol::pixel_hash(std::uint64_t(r), seed));
    Replicate& replicate = result.emplace_back();
    if (camera_varies(scene)) {
      for (int p = 0; p < points; ++p) {
        next.next();
        SimpleScene simple{without_softness(scene)};
        if (scene.camera.aperture_radius > 0) look_through(scene, next, simple.scene.camera);
        if (scene.sampler.sample_count > 1)
          simple.weight = move_film(scene.film, filter, next, simple.scene.camera);
        for (std::size_t l = 0; l < scene.lights.size(); ++l)
          simple.scene.lights.push_back(is_delta(scene.lights[l])
                                            ? scene.lights[l]
                                            : light_of(random_lamp(*lights[l], next)));
        replicate.push_back(std::move(simple));
      }
      continue;
    }
    SimpleScene simple{without_softness(scene)};
    for (const Light& light : scene.lights)
      if (is_delta(light)) simple.scene.lights.push_back(light);
    for (int p = 0; p < points; ++p) {
      next.next();
      for (std::size_t l = 0; l < scene.lights.size(); ++l) {
        if (is_delta(scene.lights[l])) continue;
        Lamp lamp = random_lamp(*lights[l], next);
        lamp.strength = 1.0 / points * lamp.strength;
        simple.scene.lights.push_back(light_of(lamp));
      }
    }
    replicate.push_back(std::move(simple));
  }
  return result;
}

SizedLights::SizedLights(const Scene& scene)
    : lights_(scene.lights), contacts_(find_contacts(scene)), prepared_(prepare(scene.lights)) {}

SizedLights::~SizedLights() = default;

Image SizedLights::seen_in(const Scene& simple) const {
  Image image(simple.film.width, simple.film.height);
  if (std::ranges::all_of(lights_, is_delta)) return image;
  const CameraFrame frame = camera_frame(simple.camera, simple.film);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Vec3 direction = normalize(centre_ray(frame, x, y));
      const SeenSurface surface = first_surface(simple, frame.origin, direction);
      Rgb sum;
      for (std::size_t l = 0; l < lights_.size(); ++l) {
        if (is_environment(lights_[l])) {
          if (surface.index < 0) sum = sum + prepared_[l]->look(direction).radiance();
        } else if (is_area(lights_[l])) {
          const double distance = prepared_[l]->distance(frame.origin, direction);
          const bool lies_on_it = std::ranges::count(contacts_[l], surface.index) > 0;
          if (distance < surface.distance || (lies_on_it && std::isfinite(distance)))
            sum = sum + strength(lights_[l]);
        }
      }
      const auto pixel = image.pixel(x, y);
      pixel[0] = float(sum.r);
      pixel[1] = float(sum.g);
      pixel[2] = float(sum.b);
    }
  return image;
}

ReplicateStatistics replicate_statistics(const ReferenceResult& result, const Image& truth,
                                         int points, double rounding) {
  ReplicateStatistics s;
  s.values = truth.values().size();
  const double peak = *std::ranges::max_element(truth.values());
  // Independent estimates of each value differ from the truth by a t-distribution.
  const boost::math::students_t t(kReplicates - 1);
  const double any = boost::math::quantile(
      boost::math::complement(t, (1 - std::pow(1 - 1e-3, 1 / double(s.values))) / 2));
  const double one_in_twenty = boost::math::quantile(t, 0.975);
  double squares = 0;
  for (std::size_t i = 0; i < s.values; ++i) {
    // An edge that one point in a thousand sees may be missed by all, and that alone is no error.
    const double error = std::max(double(result.standard_error.values()[i]), peak / points / 4);
    const double apart = std::abs(double(result.image.values()[i]) - double(truth.values()[i]));
    squares += apart * apart;
    // Where nothing varies, only rounding is left.
    const double rounded = rounding * double(truth.values()[i]) + 1e-6;
    if (apart <= rounded) continue;
    ++s.random;
    s.of_twenty += apart > one_in_twenty * error;
    s.beyond += apart - rounded > any * error;
  }
  s.rms = std::sqrt(squares / double(s.values));
  return s;
}

}  // namespace lobelia
