#include "studies/convert/curve.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <iterator>

#include "base/words/constants.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "renderer/fresnel.hpp"
#include "renderer/ggx.hpp"
#include "renderer/lobe_properties.hpp"

namespace lobelia::conversion {
namespace {

constexpr std::string_view kGgx = "ggx";

std::function<double(double)> ggx_radiance(double alpha, double f0) {
  return [=](double angle) {
    const Vec3 normal{0, 0, 1}, to_eye{std::sin(angle), 0, std::cos(angle)};
    const Rgb reflectance = fresnel_factor(Fresnel::kSchlick, {f0, f0, f0}, to_eye, normal);
    return ggx_distribution(alpha, versine(angle / 2)) * ggx_visibility(alpha, 1.0, to_eye.z) *
           (reflectance.r / f0);
  };
}

std::function<double(double)> catalogue_radiance(ModelId model, double exponent) {
  const LobeId cosine = *find_lobe("cosine");
  const double share = info(model).angle == LobeAngle::kHalfVector ? 0.5 : 1;
  return [=, coefficient = radiance_coefficient({model, cosine, Normalisation::kExact, exponent}),
          lobe = prepare(cosine, exponent).value](double angle) {
    return coefficient * lobe(versine(share * angle)) *
           geometry_factor(model, exponent, 1, std::cos(angle));
  };
}

}  // namespace

std::string_view ShadingModel::name() const { return id ? info(*id).name : kGgx; }
double ShadingModel::min() const { return is_ggx() ? kMinAlpha : kMinExponent; }
double ShadingModel::max() const { return is_ggx() ? kMaxAlpha : kMaxExponent; }

const std::vector<std::string_view>& shading_model_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all(model_names().begin(), model_names().end());
    all.push_back(kGgx);
    return all;
  }();
  return names;
}

std::optional<ShadingModel> find_shading_model(std::string_view name) {
  if (name == kGgx) return ShadingModel{};
  const auto id = find_model(name);
  return id ? std::optional(ShadingModel{id}) : std::nullopt;
}

Curve::Curve(ShadingModel model, double parameter, double f0)
    : model_(model),
      parameter_(parameter),
      radiance_(model.is_ggx() ? ggx_radiance(parameter, f0)
                               : catalogue_radiance(*model.id, parameter)) {
  peak_ = radiance_(0);
}

std::vector<double> Curve::angles() const {
  constexpr int kIntervals = 150;
  const bool half_vector = model_.is_ggx() || info(*model_.id).angle == LobeAngle::kHalfVector;
  const double width = model_.is_ggx() ? parameter_ : 1 / std::sqrt(parameter_);
  const double scale = std::min(kRightAngle, half_vector ? 2 * width : width);
  const double most = std::asinh(kRightAngle / scale);
  std::vector<double> angles;
  for (int i = 0; i < kIntervals; ++i) angles.push_back(scale * std::sinh(most * i / kIntervals));
  angles.push_back(kRightAngle);
  return angles;
}

double Curve::half_width() const {
  double above = 0, below = kRightAngle;
  // Each step halves the interval; 90 steps are exact even for an exponent of 1e8.
  for (int step = 0; step < 90; ++step) {
    const double middle = (above + below) / 2;
    ((*this)(middle) > peak_ / 2 ? above : below) = middle;
  }
  return below;
}

double Curve::energy() const {
  const std::vector<double> ends = angles();
  double sum = 0;
  for (std::size_t i = 1; i < ends.size(); ++i) sum += energy_between(*this, ends[i - 1], ends[i]);
  return sum;
}

std::vector<double> angles_of(const Curve& a, const Curve& b) {
  const std::vector<double> of_a = a.angles(), of_b = b.angles();
  std::vector<double> both;
  std::ranges::set_union(of_a, of_b, std::back_inserter(both));
  return both;
}

double energy_between(const std::function<double(double)>& curve, double from, double to) {
  using Quadrature = boost::math::quadrature::gauss<double, 7>;
  return Quadrature::integrate([&](double x) { return curve(x) * 2 * kPi * std::sin(x); }, from,
                               to);
}

namespace {

/// The largest value of a function that is smooth between `angles`.
Largest largest_of(const std::function<double(double)>& function,
                   const std::vector<double>& angles) {
  std::vector<double> values;
  for (const double angle : angles) values.push_back(function(angle));
  const double sampled = *std::ranges::max_element(values);
  Largest largest{sampled,
                  angles[std::size_t(std::ranges::find(values, sampled) - values.begin())]};
  // A maximum between two samples is above them by less than this.
  constexpr double kNear = 0.99;
  for (std::size_t i = 1; i + 1 < angles.size(); ++i) {
    const bool is_maximum = values[i] >= values[i - 1] && values[i] >= values[i + 1];
    if (!is_maximum || values[i] < kNear * sampled) continue;
    const auto [angle, negative] = boost::math::tools::brent_find_minima(
        [&](double x) { return -function(x); }, angles[i - 1], angles[i + 1], 40);
    if (-negative > largest.value) largest = {-negative, angle};
  }
  return largest;
}

Lab shown_grey(double radiance, double white) {
  const double light = std::min(1.0, radiance / white);
  return lab_from_display({light, light, light});
}

}  // namespace

Largest largest_difference(const Curve& a, const Curve& b) {
  return largest_of([&](double x) { return std::abs(a(x) - b(x)); }, angles_of(a, b));
}

Largest largest_ciede2000(const Curve& a, const Curve& b) {
  const double white = std::max(a.peak(), b.peak());
  return largest_of(
      [&](double x) { return ciede2000(shown_grey(a(x), white), shown_grey(b(x), white)); },
      angles_of(a, b));
}

double misplaced_energy(const Curve& a, const Curve& b) {
  const std::function<double(double)> difference = [&](double x) { return a(x) - b(x); };
  const std::vector<double> angles = angles_of(a, b);
  double sum = 0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double from = angles[i - 1], to = angles[i];
    const bool begins_above = difference(from) > 0;
    // Where the difference changes its sign; `from` if it does not.
    double before = from, behind = to;
    if (begins_above != (difference(to) > 0))
      for (int step = 0; step < 50; ++step) {
        const double middle = (before + behind) / 2;
        ((difference(middle) > 0) == begins_above ? before : behind) = middle;
      }
    sum += std::abs(energy_between(difference, from, before)) +
           std::abs(energy_between(difference, before, to));
  }
  return sum;
}

}  // namespace lobelia::conversion
