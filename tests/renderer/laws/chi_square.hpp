// Whether draws of a Reflector are as frequent as a pdf says: Pearson's chi-square over bins of the
// lobe's own angle and azimuth, and one bin of draws that lead nowhere.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include "renderer/reflector.hpp"
#include "tests/renderer/laws/directions.hpp"
#include "tests/renderer/laws/quadrature.hpp"

namespace lobelia {

/// Directions to the light as the lobe sees them: its angle t from the axis, which is the mirror
/// direction of the eye or the normal, and the azimuth, 0 towards the zenith or the eye.
class LobeCoordinates {
 public:
  LobeCoordinates(Vec3 normal, Vec3 to_eye, LobeAngle angle)
      : normal_(normal), to_eye_(to_eye), half_vector_(angle == LobeAngle::kHalfVector) {
    const Vec3 mirrored = 2 * dot(normal, to_eye) * normal - to_eye;
    axis_ = half_vector_ ? normal : normalize(mirrored);
    const Vec3 towards = half_vector_ ? to_eye : normal;
    const Vec3 across = towards - dot(towards, axis_) * axis_;
    x_ = length(across) > 1e-9 ? normalize(across) : normalize(cross(axis_, {0.6, 0.8, 0}));
    y_ = cross(axis_, x_);
  }

  double largest_angle() const { return half_vector_ ? kPi / 2 : kPi; }

  std::pair<double, double> of(Vec3 to_light) const {
    const Vec3 w = half_vector_ ? normalize(to_light + to_eye_) : to_light;
    return {2 * std::asin(std::min(1.0, length(w - axis_) / 2)),
            std::atan2(dot(w, y_), dot(w, x_))};
  }

  /// The integral of a density per steradian of light over angles t and azimuths from `a` to `b`, both
  /// in [0, pi], where the light is above the horizon.
  double integral(auto&& density, double t_begin, double t_end, double a, double b) const {
    return integrate_adaptively([&](double t) { return std::sin(t) * ring(density, t, a, b); },
                                t_begin, t_end, 1e-5, 20);
  }

 private:
  double ring(auto&& density, double t, double a, double b) const {
    const double c = dot(normal_, to_eye_), e = std::sqrt(std::max(0.0, 1 - c * c));
    const double x = half_vector_ ? 2 * t : t;
    const double up = c * std::cos(x), across = e * std::sin(x);
    if (up <= -across) return 0;
    if (up < across) b = std::min(b, std::acos(-up / across));
    if (b <= a) return 0;
    return boost::math::quadrature::gauss<double, 7>::integrate(
        [&](double azimuth) {
          const Vec3 w =
              std::sin(t) * (std::cos(azimuth) * x_ + std::sin(azimuth) * y_) + std::cos(t) * axis_;
          if (!half_vector_) return density(w);
          const double v_dot_h = dot(to_eye_, w);
          return 4 * v_dot_h * density(2 * v_dot_h * w - to_eye_);
        },
        a, b);
  }

  Vec3 normal_, to_eye_, axis_, x_, y_;
  bool half_vector_;
};

class ChiSquare {
 public:
  /// Draws from `sampled`, and compares with the pdf of `claimed`.
  ChiSquare(const Reflector& sampled, const Reflector& claimed, LobeAngle angle, double incidence,
            std::uint64_t seed)
      : to_eye_(frame_(incidence, 2)), coordinates_(frame_.normal, to_eye_, angle), random_(seed) {
    find_edges(sampled);
    const std::size_t rings = edges_.size() - 1;
    std::vector<double> drawn(rings * kSectors + 1), expected(rings * kSectors + 1);
    for (int i = 0; i < kDraws; ++i) {
      const auto sample = draw(sampled);
      drawn[sample ? bin(sample->to_light) : rings * kSectors] += 1;
    }
    const auto density = [&](Vec3 l) { return claimed.pdf(frame_.normal, to_eye_, l); };
    double valid = 0;
    for (std::size_t r = 0; r < rings; ++r)
      for (std::size_t k = 0; k < kSectors / 2; ++k) {
        const double width = 2 * kPi / kSectors;
        const double p = coordinates_.integral(density, edges_[r], edges_[r + 1], width * double(k),
                                               width * double(k + 1));
        expected[r * kSectors + kSectors / 2 + k] = kDraws * p;
        expected[r * kSectors + kSectors / 2 - 1 - k] = kDraws * p;
        valid += 2 * p;
      }
    probability_of_light_ = valid;
    expected.back() = kDraws * std::max(0.0, 1 - valid);
    compare(drawn, expected);
  }

  /// How probable a worse agreement is, if the draws are as the pdf says.
  double p_value() const { return p_value_; }
  /// The integral of the pdf.
  double probability_of_light() const { return probability_of_light_; }

 private:
  static constexpr int kDraws = 10000, kPilot = 256, kRings = 12;
  static constexpr std::size_t kSectors = 8;

  std::optional<ReflectorSample> draw(const Reflector& reflector) {
    const double choice = uniform_(random_), u = uniform_(random_), v = uniform_(random_);
    return reflector.sample(frame_.normal, to_eye_, choice, u, v);
  }

  std::size_t bin(Vec3 to_light) const {
    const auto [t, azimuth] = coordinates_.of(to_light);
    const auto ring =
        std::upper_bound(edges_.begin() + 1, edges_.end() - 1, t) - edges_.begin() - 1;
    const auto sector = std::size_t((azimuth + kPi) / (2 * kPi) * kSectors);
    return std::size_t(ring) * kSectors + std::min(sector, kSectors - 1);
  }

  /// Rings that some draws made for the purpose fill evenly, none of them wide enough for the
  /// quadrature to overlook something in it. A lobe ends at a right angle.
  void find_edges(const Reflector& reflector) {
    std::vector<double> pilot;
    for (int i = 0; i < kPilot; ++i)
      if (const auto sample = draw(reflector))
        pilot.push_back(coordinates_.of(sample->to_light).first);
    std::sort(pilot.begin(), pilot.end());
    std::vector<double> wanted{kPi / 2, coordinates_.largest_angle()};
    for (std::size_t i = 1; i < kRings && !pilot.empty(); ++i)
      wanted.push_back(pilot[i * pilot.size() / kRings]);
    std::sort(wanted.begin(), wanted.end());
    for (const double next : wanted) {
      while (edges_.back() > 0 && next > 2 * edges_.back()) edges_.push_back(2 * edges_.back());
      if (next > edges_.back()) edges_.push_back(next);
    }
  }

  /// Bins of fewer than five expected draws are one bin.
  void compare(const std::vector<double>& drawn, const std::vector<double>& expected) {
    double sum = 0, few_drawn = 0, few_expected = 0;
    int bins = 0;
    const auto add = [&](double d, double e) {
      sum += (d - e) * (d - e) / e;
      ++bins;
    };
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (expected[i] >= 5) {
        add(drawn[i], expected[i]);
      } else {
        few_drawn += drawn[i];
        few_expected += expected[i];
      }
    }
    // Where too few are expected even together, more than a handful are wrong.
    if (few_expected >= 5)
      add(few_drawn, few_expected);
    else if (few_drawn > 30)
      sum = 1e9;
    p_value_ = bins > 1 ? boost::math::gamma_q((bins - 1) / 2.0, sum / 2) : 0;
  }

  Frame frame_;
  Vec3 to_eye_;
  LobeCoordinates coordinates_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
  std::vector<double> edges_{0};
  double p_value_ = 0, probability_of_light_ = 0;
};

}  // namespace lobelia
