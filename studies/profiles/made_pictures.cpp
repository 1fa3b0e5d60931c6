#include "studies/profiles/made_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/pictures/half.hpp"
#include "base/words/constants.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"

namespace lobelia::profile_study {
namespace {

using Radiance = std::function<double(double x, double y)>;

double between(std::mt19937& random, double from, double to) {
  return from + (to - from) * std::uniform_real_distribution<double>()(random);
}
/// Equally likely in every octave.
double octaves(std::mt19937& random, double from, double to) {
  return std::exp(between(random, std::log(from), std::log(to)));
}

/// The mean over a pixel by a rule of many places: Gauss and Legendre's of 5 in each quarter of the filter's width.
class Mean {
 public:
  explicit Mean(Filter filter) {
    constexpr std::array<double, 5> kPlaces = {-0.90617984593866399, -0.53846931010568309, 0,
                                               0.53846931010568309, 0.90617984593866399};
    constexpr std::array<double, 5> kWeights = {0.23692688505618909, 0.47862867049936647,
                                                0.56888888888888889, 0.47862867049936647,
                                                0.23692688505618909};
    constexpr int kParts = 4;
    double sum = 0;
    for (int part = 0; part < kParts; ++part)
      for (std::size_t k = 0; k < kPlaces.size(); ++k) {
        const double x = (2 * part + 1 + kPlaces[k]) / kParts - 1;
        nodes_.push_back({filter.radius * x, kWeights[k] * filter_value(filter, x)});
        sum += nodes_.back().weight;
      }
    for (Node& node : nodes_) node.weight /= sum;
  }
  double operator()(const Radiance& radiance, double x, double y) const {
    double sum = 0;
    for (const Node& v : nodes_)
      for (const Node& u : nodes_) sum += u.weight * v.weight * radiance(x + u.place, y + v.place);
    return sum;
  }

 private:
  struct Node {
    double place, weight;
  };
  std::vector<Node> nodes_;
};

std::optional<Filter> filter_of(const Kind& kind, std::mt19937& random) {
  if (!kind.filter) return std::nullopt;
  if (*kind.filter != "any") return find_filter(*kind.filter);
  const auto names = filter_names();
  const auto last = int(names.size()) - 1;
  return find_filter(names[std::size_t(std::uniform_int_distribution<int>(1, last)(random))]);
}

Radiance shown(const Radiance& radiance, const std::optional<Filter>& filter) {
  if (!filter) return radiance;
  return [radiance, mean = Mean(*filter)](double x, double y) { return mean(radiance, x, y); };
}

/// The nearest number of 8 bits as sRGB has it, as linear light.
double eight_bits(double value) {
  const double inside = std::clamp(value, 0.0, 1.0);
  const double encoded =
      inside <= 0.0031308 ? 12.92 * inside : 1.055 * std::pow(inside, 1 / 2.4) - 0.055;
  const double stored = std::round(255 * encoded) / 255;
  return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}

/// Adds noise, clips and rounds. All channels are equal.
Image developed(int width, int height, const Radiance& radiance, double peak, const Kind& kind,
                std::mt19937& random) {
  const double sigma = kind.noise == Noise::kNone    ? 0
                       : kind.noise == Noise::kGauss ? octaves(random, 0.003, 0.03)
                                                     : octaves(random, 0.02, 0.1);
  const double clip = kind.clipped ? between(random, 0.4, 0.8) * peak : kInfinity;
  std::normal_distribution<double> normal;
  std::gamma_distribution<double> gamma(sigma > 0 ? 1 / (sigma * sigma) : 1, sigma * sigma);
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double value = radiance(x + 0.5, y + 0.5);
      if (kind.noise == Noise::kGauss) value += sigma * peak * normal(random);
      if (kind.noise == Noise::kGamma) value *= gamma(random);
      value = std::min(value, clip);
      if (kind.stored == Stored::kHalf) value = rounded_to_half(value);
      if (kind.stored == Stored::kEightBit) value = eight_bits(value);
      std::ranges::fill(image.pixel(x, y), float(value));
    }
  return image;
}

/// Trowbridge and Reitz's distribution with Smith's masking, as Heitz 2014 writes it.
double ggx(double cos_half, double n_dot_l, double n_dot_v, double alpha) {
  const double a2 = alpha * alpha;
  const auto masking = [&](double cosine) {
    return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine));
  };
  return a2 / std::pow(cos_half * cos_half * (a2 - 1) + 1, 2) * masking(n_dot_v) *
         masking(n_dot_l) / (4 * n_dot_v);
}

}  // namespace

std::span<const Kind> kinds() {
  static const std::vector<Kind> all = {
      {.name = "scene: no noise", .with_scene = true},
      {.name = "scene: Gauss", .with_scene = true, .noise = Noise::kGauss},
      {.name = "scene: gamma", .with_scene = true, .noise = Noise::kGamma},
      {.name = "scene: half floats", .with_scene = true, .stored = Stored::kHalf},
      {.name = "scene: 8 bits", .with_scene = true, .stored = Stored::kEightBit},
      {.name = "scene: clipped, Gauss",
       .with_scene = true,
       .noise = Noise::kGauss,
       .clipped = true},
      {.name = "scene: box", .with_scene = true, .filter = "box"},
      {.name = "scene: box, Gauss", .with_scene = true, .noise = Noise::kGauss, .filter = "box"},
      {.name = "scene: wide filters", .with_scene = true, .filter = "any"},
      {.name = "scene: box, not told",
       .with_scene = true,
       .filter = "box",
       .filter_is_told = false},
      {.name = "scene: box, not told, Gauss",
       .with_scene = true,
       .noise = Noise::kGauss,
       .filter = "box",
       .filter_is_told = false},
      {.name = "scene: rendered", .with_scene = true, .filter = "any", .rendered = true},
      {.name = "scene: rendered, not told",
       .with_scene = true,
       .filter = "box",
       .filter_is_told = false,
       .rendered = true},
      {.name = "no noise"},
      {.name = "Gauss", .noise = Noise::kGauss},
      {.name = "gamma", .noise = Noise::kGamma},
      {.name = "half floats", .stored = Stored::kHalf},
      {.name = "8 bits", .stored = Stored::kEightBit},
      {.name = "clipped, Gauss", .noise = Noise::kGauss, .clipped = true},
      {.name = "box", .filter = "box"},
      {.name = "wide filters", .filter = "any"},
      {.name = "on a slope", .slope = true},
      {.name = "on a slope, Gauss", .noise = Noise::kGauss, .slope = true},
  };
  return all;
}

MadeScene make_scene(const Kind& kind, std::mt19937& random) {
  constexpr std::array kFamilies = {"phong", "blinn_phong", "ggx"};
  MadeScene made;
  made.family =
      kFamilies[std::uniform_int_distribution<std::size_t>(0, kind.rendered ? 1 : 2)(random)];
  const bool is_ggx = made.family == "ggx";
  made.width = is_ggx ? between(random, 0.1, 0.3) : octaves(random, 20, 200);
  Scene& scene = made.scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film = {128, 96};
  const Rgb light{between(random, 1, 3), between(random, 1, 3), between(random, 1, 3)};
  scene.lights = {DirectionalLight{
      normalize({between(random, -0.7, 0), between(random, -0.6, 0.6), -1}), light}};
  Material material;
  material.highlight.model =
      find_model(made.family == "phong" ? "phong_rdf" : "blinn_phong_rdf").value();
  material.highlight.lobe = find_lobe("cosine").value();
  material.highlight.exponent = 64;
  material.specular_reflectance = {0.5, 0.5, 0.5};
  scene.materials = {material};
  scene.spheres = {{{between(random, -0.4, 0.4), between(random, -0.2, 0.2), 0}, 1, 0}};
  const std::optional<Filter> filter = filter_of(kind, random);
  constexpr int kSamples = 256;
  if (kind.rendered) {
    Scene of_truth = scene;
    of_truth.materials.front().highlight.exponent = made.width;
    of_truth.film.filter = filter.value();
    of_truth.sampler = {kSamples, random()};
    made.image = render(of_truth, RenderOptions{}).image;
  }
  if (filter && kind.filter_is_told) {
    scene.film.filter = *filter;
    scene.sampler.sample_count = kSamples;
  }
  if (kind.rendered) return made;

  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const double irradiance = (light.r + light.g + light.b) / 6;
  const Radiance exact = [&](double x, double y) {
    const Vec3 ray = normalize(film_ray(frame, x, y));
    const auto hit = nearest_hit(scene, frame.origin, ray);
    const auto here = hit ? light_at(scene, 0, *hit) : std::nullopt;
    if (!here) return 0.0;
    const Vec3 normal = hit->normal;
    const double n_dot_v = -dot(normal, ray), n_dot_l = dot(normal, here->to_light);
    if (made.family == "phong")
      return irradiance *
             std::pow(std::max(0.0, dot(ray + 2 * n_dot_v * normal, here->to_light)), made.width);
    const double cos_half = dot(normal, normalize(here->to_light - ray));
    return irradiance *
           (is_ggx ? ggx(cos_half, n_dot_l, n_dot_v, made.width) : std::pow(cos_half, made.width));
  };
  // A picture of 8 bits is exposed for its peak.
  double largest = 0;
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x) largest = std::max(largest, exact(x + 0.5, y + 0.5));
  const double exposure = kind.stored == Stored::kEightBit ? 0.9 / largest : 1;
  const Radiance exposed = [&](double x, double y) { return exposure * exact(x, y); };
  made.image = developed(scene.film.width, scene.film.height, shown(exposed, filter),
                         exposure * largest, kind, random);
  return made;
}

MadeBlob make_blob(const Kind& kind, std::mt19937& random) {
  MadeBlob made;
  const double minor = octaves(random, 2, 9), major = minor * between(random, 1.15, 1.8);
  const double turn = between(random, 0, kPi), c = std::cos(turn), s = std::sin(turn);
  const int size = int(14 * major) + 20;
  made.x = size / 2.0 + between(random, -1, 1);
  made.y = size / 2.0 + between(random, -1, 1);
  const double height =
      kind.stored == Stored::kEightBit ? between(random, 0.3, 0.8) : octaves(random, 0.1, 10);
  const Radiance spot = [&](double x, double y) {
    const double dx = x - made.x, dy = y - made.y;
    const double u = (c * dx + s * dy) / major, v = (c * dy - s * dx) / minor;
    return height * std::exp2(-u * u - v * v);
  };
  const Radiance alone = shown(spot, filter_of(kind, random));
  made.peak = alone(made.x, made.y);
  const auto half_width = [&](double dx, double dy) {
    double above = 0, below = 4 * major;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = (above + below) / 2;
      (alone(made.x + middle * dx, made.y + middle * dy) > made.peak / 2 ? above : below) = middle;
    }
    return above;
  };
  made.major = half_width(c, s);
  made.minor = half_width(-s, c);
  // The disc of docs/profiles.md.
  const double reach = std::max(3.0, 3 * 0.941 * made.major), step = reach / 60;
  for (double y = -reach + step / 2; y < reach; y += step)
    for (double x = -reach + step / 2; x < reach; x += step)
      if (std::hypot(x, y) < reach) made.energy += step * step * alone(made.x + x, made.y + y);

  const double base = between(random, 0.02, 0.2) * height;
  const double slope_x = kind.slope ? between(random, -0.01, 0.01) * height : 0;
  const double slope_y = kind.slope ? between(random, -0.01, 0.01) * height : 0;
  const double lift = size / 2.0 * (std::abs(slope_x) + std::abs(slope_y));
  const Radiance all = [&](double x, double y) {
    return base + lift + slope_x * (x - size / 2.0) + slope_y * (y - size / 2.0) + alone(x, y);
  };
  made.image = developed(size, size, all, base + lift + made.peak, kind, random);
  return made;
}

}  // namespace lobelia::profile_study
