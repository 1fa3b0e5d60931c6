#include "studies/measured/fit.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/frame.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/render.hpp"
#include "studies/convert/convert.hpp"

namespace lobelia::measured {
namespace {

using records::Triple;

/// Measurements at grazing angles are unreliable.
const double kLeastCosine = std::cos(80 * kPi / 180);

/// A pair of directions. `weight` is its solid angle, of light times of eye, but for a common factor.
struct Sample {
  double weight, n_dot_l, n_dot_v;
  double versine[2];  ///< 1 - cos of the lobe's angle, by LobeAngle
  int ring;           ///< of equal theta_h, and so of equal versine[kHalfVector]
  Triple measured;
};

/// In the middle of MERL's cells, and as dense as they are by theta_h: the highlight needs it, the other angles do not.
std::vector<Sample> samples_of(const MeasuredBrdf& brdf) {
  constexpr int kThetaD = 18, kPhiD = 20;
  std::vector<Sample> samples;
  for (int ring = 0; ring < kMerlThetaH; ++ring) {
    const double theta_h = merl_theta_h(ring + 0.5);
    const double ring_area = versine(merl_theta_h(ring + 1)) - versine(merl_theta_h(ring));
    for (int d = 0; d < kThetaD; ++d)
      for (int p = 0; p < kPhiD; ++p) {
        const double theta_d = kRightAngle * (d + 0.5) / kThetaD, phi_d = kPi * (p + 0.5) / kPhiD;
        const auto [to_eye, to_light] = directions({theta_h, theta_d, phi_d});
        if (to_eye.z < kLeastCosine || to_light.z < kLeastCosine) continue;
        const auto value = brdf.radiance(to_eye, to_light);
        if (!value) continue;
        const Vec3 mirrored{-to_light.x, -to_light.y, to_light.z};
        samples.push_back({ring_area * std::sin(theta_d) * std::cos(theta_d),
                           to_light.z,
                           to_eye.z,
                           {versine(angle_between(mirrored, to_eye)), versine(theta_h)},
                           ring,
                           {value->r, value->g, value->b}});
      }
  }
  if (samples.empty())
    throw Error(ExitCode::kInput, "nothing was measured within 80 degrees of the normal");
  return samples;
}

/// The highlight at every sample, for a specular reflectance of 1.
std::vector<double> highlights(const std::vector<Sample>& samples, const Highlight& highlight) {
  const double coefficient = radiance_coefficient(highlight);
  const auto lobe = prepare(highlight.lobe, highlight.exponent).value;
  const LobeAngle angle = info(highlight.model).angle;
  std::vector<double> values;
  values.reserve(samples.size());
  double value = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    const bool is_known =
        angle == LobeAngle::kHalfVector && i > 0 && samples[i - 1].ring == sample.ring;
    if (!is_known) value = lobe(sample.versine[std::size_t(angle)]);
    values.push_back(
        coefficient * value *
        geometry_factor(highlight.model, highlight.exponent, sample.n_dot_l, sample.n_dot_v));
  }
  return values;
}

struct Reflectances {
  Triple diffuse{}, specular{};
};

/// The pair in [0, 1] x [0, 1] with the smallest a x^2 + 2 b x y + c y^2 - 2 p x - 2 q y.
std::pair<double, double> least_in_square(double a, double b, double c, double p, double q) {
  const double determinant = a * c - b * b;
  const double x = (c * p - b * q) / determinant, y = (a * q - b * p) / determinant;
  if (determinant > 1e-12 * a * c && std::min(x, y) >= 0 && std::max(x, y) <= 1) return {x, y};
  const auto within = [](double value) {
    return std::isfinite(value) ? std::clamp(value, 0., 1.) : 0;
  };
  std::pair<double, double> best;
  double least = kInfinity;
  for (const double end : {0.0, 1.0})
    for (const auto& [u, v] :
         {std::pair(end, within((q - b * end) / c)), {within((p - b * end) / a), end}})
      if (const double sum = a * u * u + 2 * b * u * v + c * v * v - 2 * p * u - 2 * q * v;
          sum < least) {
        least = sum;
        best = {u, v};
      }
  return best;
}

Reflectances least_squares(const std::vector<Sample>& samples, const std::vector<double>& lobe) {
  double a = 0, b = 0, c = 0;
  Triple p{}, q{};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double diffuse = samples[i].n_dot_l / kPi, weight = samples[i].weight;
    a += weight * diffuse * diffuse;
    b += weight * diffuse * lobe[i];
    c += weight * lobe[i] * lobe[i];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] += weight * diffuse * samples[i].measured[k];
      q[k] += weight * lobe[i] * samples[i].measured[k];
    }
  }
  Reflectances found;
  for (std::size_t k = 0; k < 3; ++k)
    std::tie(found.diffuse[k], found.specular[k]) = least_in_square(a, b, c, p[k], q[k]);
  return found;
}

struct Size {
  double rms, largest;
};

/// The size of the values that value_at(sample, channel) gives.
Size size_of(const std::vector<Sample>& samples, const auto& value_at) {
  double sum = 0, weights = 0, largest = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = std::abs(value_at(i, k));
      sum += samples[i].weight * value * value;
      weights += samples[i].weight;
      largest = std::max(largest, value);
    }
  return {std::sqrt(sum / weights), largest};
}

Size residual(const std::vector<Sample>& samples, const std::vector<double>& lobe,
              const Reflectances& found) {
  return size_of(samples, [&](std::size_t i, std::size_t k) {
    return found.diffuse[k] * samples[i].n_dot_l / kPi + found.specular[k] * lobe[i] -
           samples[i].measured[k];
  });
}

records::MeasuredFit fit_one(const std::vector<Sample>& samples, Highlight highlight) {
  const auto best = conversion::parameter_of_least(
      [&](double exponent) {
        Highlight tried = highlight;
        tried.exponent = exponent;
        const auto lobe = highlights(samples, tried);
        return residual(samples, lobe, least_squares(samples, lobe)).rms;
      },
      kFitMinExponent, kFitMaxExponent);
  highlight.exponent = best.parameter;
  const auto lobe = highlights(samples, highlight);
  const Reflectances found = least_squares(samples, lobe);
  const Size error = residual(samples, lobe, found);
  records::MeasuredFit record;
  record.model = info(highlight.model).name;
  record.lobe = info(highlight.lobe).name;
  record.exponent = best.parameter;
  if (record.lobe == "ggx") record.alpha = std::sqrt(alpha_squared(best.parameter));
  record.diffuse = found.diffuse;
  record.specular = found.specular;
  record.rms_of_measured = error.rms;
  record.largest_of_measured = error.largest;
  record.is_end_of_range = best.at_end;
  return record;
}

/// A white diffuse surface that faces the light has the radiance 1 / pi, and is shown as white.
DisplayLight as_shown(const Image& image) { return {image, std::log2(kPi)}; }

/// A picture of the measurement, and the places in it that show the material.
struct Truth {
  Truth(Scene of, Image shown) : scene(std::move(of)), picture(std::move(shown)) {}
  Scene scene;
  Image picture;
  std::vector<std::size_t> pixels = {};
};

std::vector<Truth> truths_of(const MeasuredBrdf& brdf) {
  std::vector<Truth> truths;
  for (NamedScene& one : canonical_scenes()) {
    Image picture = measured_picture(one.scene, brdf);
    Truth& truth = truths.emplace_back(std::move(one.scene), std::move(picture));
    for (std::size_t i = 0; i < truth.picture.pixel_count(); ++i)
      if (std::ranges::any_of(truth.picture.values().subspan(3 * i, 3),
                              [](float v) { return v > 0; }))
        truth.pixels.push_back(i);
  }
  return truths;
}

void add_colour_differences(const std::vector<Truth>& truths, records::MeasuredFit& fit) {
  RenderOptions options;
  options.threads = 1;  // several fits run at once
  double sum = 0, count = 0;
  for (const Truth& truth : truths) {
    const Image picture = render(with_fit(truth.scene, fit), options).image;
    const PixelValues differences = ciede2000_of_pixels(as_shown(picture), as_shown(truth.picture));
    for (const std::size_t pixel : truth.pixels) {
      const double difference = differences[pixel];
      sum += difference;
      fit.largest_ciede2000 = std::max(fit.largest_ciede2000, difference);
    }
    count += double(truth.pixels.size());
  }
  fit.mean_ciede2000 = count > 0 ? sum / count : 0;
}

Rgb as_rgb(const Triple& t) { return {t[0], t[1], t[2]}; }

}  // namespace

std::vector<Highlight> all_kinds() {
  std::vector<Highlight> kinds;
  for (const ModelId model : all_models())
    for (const LobeId& lobe : all_lobes()) kinds.push_back({model, lobe});
  return kinds;
}

records::MeasuredFits fit(const MeasuredBrdf& brdf, std::span<const Highlight> kinds) {
  const std::vector<Sample> samples = samples_of(brdf);
  const Size measured =
      size_of(samples, [&](std::size_t i, std::size_t k) { return samples[i].measured[k]; });
  if (measured.largest == 0) throw Error(ExitCode::kInput, "every measured value is 0");
  const std::vector<Truth> truths = truths_of(brdf);
  records::MeasuredFits record;
  record.format = brdf.format;
  record.remarks = brdf.remarks;
  record.direction_pairs = samples.size();
  record.measured_rms = measured.rms;
  record.measured_largest = measured.largest;
  record.fits.resize(kinds.size());
  oneapi::tbb::parallel_for(std::size_t{0}, kinds.size(), [&](std::size_t i) {
    records::MeasuredFit& one = record.fits[i];
    one = fit_one(samples, kinds[i]);
    one.rms_of_measured /= measured.rms;
    one.largest_of_measured /= measured.largest;
    add_colour_differences(truths, one);
  });
  std::ranges::stable_sort(record.fits, {}, &records::MeasuredFit::rms_of_measured);
  return record;
}

std::vector<NamedScene> canonical_scenes() {
  Scene sphere;
  sphere.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  sphere.materials = {{"highlight", {}, {1, 1, 1}, {}}};
  sphere.spheres = {{{0, 0, 0}, 1, 0}};
  const auto lit_along = [&](Vec3 direction) {
    Scene lit = sphere;
    lit.lights = {DirectionalLight{direction, {1, 1, 1}}};
    return lit;
  };
  return {{"head_on", lit_along({0, 0, -1})},
          {"oblique_45", lit_along({-0.5, -0.5, -0.70710678118654752})}};
}

Scene with_fit(Scene scene, const records::MeasuredFit& fit) {
  for (Material& material : scene.materials) {
    material.highlight = {*find_model(fit.model), *find_lobe(fit.lobe), Normalisation::kExact,
                          fit.exponent};
    material.diffuse_reflectance = as_rgb(fit.diffuse);
    material.specular_reflectance = as_rgb(fit.specular);
  }
  return scene;
}

Image measured_picture(const Scene& scene, const MeasuredBrdf& brdf) {
  return truth::as_picture(
      truth::shade(scene,
                   [&](Vec3 normal, Vec3 to_eye, Vec3 to_light) {
                     const Tangents frame = tangents(normal);
                     const auto local = [&](Vec3 v) {
                       return Vec3{dot(v, frame.first), dot(v, frame.second), dot(v, normal)};
                     };
                     const Vec3 eye = local(to_eye);
                     return eye.z > 0 ? brdf.radiance(eye, local(to_light)).value_or(Rgb{}) : Rgb{};
                   }),
      scene.film);
}

}  // namespace lobelia::measured
