#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <map>
#include <mutex>
#include <tuple>

#include "core/error.hpp"
#include "verify/truth/big_lobe.hpp"
#include "verify/truth/truth.hpp"

namespace lobelia::truth {
namespace {

/// A surface point is as good as on a sphere that it lies beneath by less than this part of the radius:
/// two spheres in one place do not shade each other.
const Big kOnSurface = ldexp(Big(1), -100);

/// Half of the linear term and the constant term of t^2 - 2 b t + c = 0, whose roots are where a ray of
/// unit direction meets a sphere.
struct Quadratic {
  Big b, c;
  Quadratic(const Sphere& sphere, const Big3& origin, const Big3& direction) {
    const Big3 way = Big3(sphere.center) - origin;
    b = dot(way, direction);
    c = dot(way, way) - Big(sphere.radius) * sphere.radius;
  }
  Big discriminant() const { return b * b - c; }
};

/// The frame of docs/conventions.md from the camera's own numbers.
struct Frame {
  Big3 forward, right, up;
  Big half_width, half_height, shift_u, shift_v;
  explicit Frame(const Scene& scene) {
    const Camera& camera = scene.camera;
    forward = normalize(Big3(camera.target) - Big3(camera.origin));
    right = normalize(cross(forward, Big3(camera.up)));
    up = cross(right, forward);
    half_width = tan(Big(camera.fov_degrees) * boost::math::constants::pi<Big>() / 360);
    half_height = half_width * scene.film.height / scene.film.width;
    shift_u = -2 * half_width * camera.principal_point_offset_x;
    shift_v = -2 * half_height * camera.principal_point_offset_y;
  }
};

int nearest_sphere(const Scene& scene, const Big3& origin, const Big3& direction, Big& nearest) {
  int found = -1;
  for (int k = 0; k < int(scene.spheres.size()); ++k) {
    const Quadratic q(scene.spheres[k], origin, direction);
    // Cheap refusals first: a square root takes as long as thirty products.
    if (q.b <= 0 || q.c <= 0 || q.discriminant() <= 0) continue;
    const Big t = q.b - sqrt(q.discriminant());
    if (found >= 0 && t >= nearest) continue;
    nearest = t;
    found = k;
  }
  return found;
}

/// Whether a sphere other than `own` reaches into the way from a point to a light; `distance` < 0 is an
/// infinite one.
bool is_shadowed(const Scene& scene, int own, const Big3& point, const Big3& to_light,
                 const Big& distance) {
  for (int k = 0; k < int(scene.spheres.size()); ++k) {
    if (k == own) continue;
    const Quadratic q(scene.spheres[k], point, to_light);
    if (q.discriminant() <= 0) continue;
    const double radius = scene.spheres[k].radius;
    const bool inside = q.c < -kOnSurface * radius * radius;
    if (!inside && q.b <= 0) continue;
    if (inside || distance < 0 || q.b - sqrt(q.discriminant()) < distance) return true;
  }
  return false;
}

}  // namespace

struct Picture::Pixels {
  /// One light on one pixel that it lights.
  struct Lit {
    std::size_t pixel;
    Big n_dot_l;
    Big cosine[2];   ///< of the lobe's angle, by LobeAngle
    Rgb irradiance;  ///< times the specular reflectance
  };
  std::vector<int> sphere;
  std::vector<Lit> lit;
  double peak = 0;
  /// Lobes by the angle that they see: models share them.
  std::map<std::tuple<LobeAngle, int, int, double>, std::vector<Big>> lobes;
  std::mutex mutex;

  void light(const Scene& scene, const Light& source, std::size_t pixel, const Big3& normal,
             const Big3& to_eye, const Big3& point) {
    Big3 to_light;
    Big distance = -1;
    double falloff = 1;
    if (const auto* directional = std::get_if<DirectionalLight>(&source)) {
      to_light = normalize(Big(-1) * Big3(directional->direction));
    } else {
      const auto& lamp = std::get<PointLight>(source);
      const Big3 way = Big3(lamp.position) - point;
      distance = sqrt(dot(way, way));
      to_light = Big(1 / distance) * way;
      const Big towards = has_normal(lamp) ? Big(-dot(Big3(lamp.normal), to_light)) : Big(1);
      if (towards <= 0) return;
      falloff = double(towards / dot(way, way));
    }
    const Big n_dot_l = dot(normal, to_light);
    if (n_dot_l <= 0 || is_shadowed(scene, sphere[pixel], point, to_light, distance)) return;
    const Material& material = scene.materials[scene.spheres[sphere[pixel]].material];
    const Rgb irradiance = falloff * (strength(source) * material.specular_reflectance);
    lit.push_back({pixel,
                   n_dot_l,
                   {lobe_cosine(LobeAngle::kReflection, normal, to_eye, to_light),
                    lobe_cosine(LobeAngle::kHalfVector, normal, to_eye, to_light)},
                   irradiance});
  }
};

Picture::Picture(const Scene& scene) : pixels_(std::make_unique<Pixels>()) {
  if (const std::string found = beyond_delta_lights(scene); !found.empty())
    throw Error(ExitCode::kInternal, "the truth of 50 digits does not know: " + found);
  const Frame frame(scene);
  const Big3 origin(scene.camera.origin);
  const Film& film = scene.film;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const Big u = (Big(2 * x + 1) / film.width - 1) * frame.half_width + frame.shift_u;
      const Big v = (1 - Big(2 * y + 1) / film.height) * frame.half_height + frame.shift_v;
      const Big3 direction = normalize(frame.forward + u * frame.right + v * frame.up);
      Big t;
      const int sphere = nearest_sphere(scene, origin, direction, t);
      pixels_->sphere.push_back(sphere);
      if (sphere < 0) continue;
      const Big3 point = origin + t * direction;
      const Big3 normal = normalize(point - Big3(scene.spheres[sphere].center));
      for (const Light& light : scene.lights)
        pixels_->light(scene, light, pixels_->sphere.size() - 1, normal, Big(-1) * direction,
                       point);
    }
  std::map<std::size_t, double> arriving;
  for (const auto& lit : pixels_->lit) {
    double& here = arriving[lit.pixel];
    here += max_component(lit.irradiance);
    pixels_->peak = std::max(pixels_->peak, here);
  }
}

Picture::~Picture() = default;
Picture::Picture(Picture&&) noexcept = default;

int Picture::sphere(std::size_t pixel) const { return pixels_->sphere.at(pixel); }
double Picture::peak() const { return pixels_->peak; }

std::vector<Rgb> Picture::highlights(const Highlight& highlight) const {
  const ModelRow& model = model_row(highlight.model);
  const LobeId lobe = highlight.lobe;
  const std::lock_guard lock(pixels_->mutex);
  auto& values = pixels_->lobes[{model.angle, lobe.index, lobe.order, highlight.exponent}];
  if (values.empty())
    for (const auto& lit : pixels_->lit)
      values.push_back(
          lobe_of_cosine(lobe, lit.cosine[std::size_t(model.angle)], highlight.exponent));
  const double in_front = coefficient(highlight.model, lobe, highlight.exponent);
  std::vector<Rgb> radiance(pixels_->sphere.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& lit = pixels_->lit[i];
    const Big share = model.radiance_has_cosine ? Big(values[i] * lit.n_dot_l) : values[i];
    Rgb& sum = radiance[lit.pixel];
    sum = sum + in_front * double(share) * lit.irradiance;
  }
  return radiance;
}

}  // namespace lobelia::truth
