// Every exported function with the directions that it is called for, and what the formulas in 50 digits say of its values.
// For the tests that run the texts.
#pragma once

#include <fmt/format.h>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/fresnel.hpp"
#include "studies/stability/vectors.hpp"
#include "tests/shaders/directions.hpp"
#include "tests/shaders/exports.hpp"
#include "tests/test.hpp"

namespace lobelia {

inline constexpr double kRunExponents[] = {1, 10, 100, 1000, 1e4, 1e6};
inline constexpr Rgb kReflectance{0.04, 0.5, 1};

struct CalledPoint {
  Directions directions;  ///< as the shader has them: in float32
  double exponent;
  bool is_hard;
};

/// Where a quotient, a root or a logarithm might have no value, or no finite one.
inline std::vector<Directions> hard_directions() {
  const Vec3 up{0, 0, 1}, x{1, 0, 0}, high{0.6, 0, 0.8};
  const Vec3 low = normalize({0.6, 0.3, -0.01}), grazing = normalize({1, 0, 1e-7});
  return {{up, up, up},      {up, high, high},  {up, high, {-0.6, 0, 0.8}},
          {up, -high, high}, {up, -x, x},       {up, grazing, grazing},
          {up, x, x},        {up, high, -up},   {up, high, low},
          {up, high, x},     {up, -up, up},     {up, normalize({-1, 0, 1e-7}), grazing},
          {up, up, grazing}, {up, grazing, up}, {high, high, high},
          {low, low, low},   {up, low, high},   {up, {0, 0, 0}, {0, 0, 0}}};
}

/// The same number for every exponent of kRunExponents, in their order.
inline std::vector<CalledPoint> called_points() {
  constexpr std::size_t kRandom = 140;
  const auto rounded = [](const Directions& d) {
    const auto to_float = [](Vec3 v) { return Vec3{float(v.x), float(v.y), float(v.z)}; };
    return Directions{to_float(d.normal), to_float(d.to_eye), to_float(d.to_light)};
  };
  std::vector<CalledPoint> points;
  for (const double n : kRunExponents) {
    RandomDirections random(n);
    for (std::size_t i = 0; i < kRandom; ++i) points.push_back({rounded(random()), n, false});
    for (const Directions& d : hard_directions()) points.push_back({rounded(d), n, true});
  }
  return points;
}

/// A colour for each point.
struct ExportOutput {
  ShaderExport request;
  ModelId model;
  bool is_coefficient;
  Highlight highlight(double exponent) const {
    return {model, request.lobe, request.normalisation, exponent};
  }
  std::string coefficient_name() const { return coefficient_name_of(request, model); }
};

/// Every function of the exports; the coefficients' once, as they are the same with the Fresnel factor and where the
/// function calls them itself.
inline std::vector<ExportOutput> outputs_of(const std::vector<ShaderExport>& requests) {
  std::vector<ExportOutput> outputs;
  for (const ShaderExport& request : requests) {
    for (const ModelId model : request.models) outputs.push_back({request, model, false});
    if (request.coefficient != CoefficientFrom::kArgument || request.fresnel != Fresnel::kNone)
      continue;
    for (const ModelId model : request.models)
      if (!coefficient_name_of(request, model).empty()) outputs.push_back({request, model, true});
  }
  return outputs;
}

/// For each lobe a list of exports with the coefficients computed or fixed, and one with them as arguments: in a language
/// without overloads the functions of both have the same names.
inline std::vector<std::vector<ShaderExport>> exports_to_run(const std::string& language) {
  std::vector<std::vector<ShaderExport>> lists;
  for (const LobeId& lobe : every_lobe())
    for (const auto from : {CoefficientFrom::kComputed, CoefficientFrom::kArgument}) {
      std::vector<ShaderExport>& list = lists.emplace_back();
      for (const Normalisation normalisation : {Normalisation::kExact, Normalisation::kPaper})
        for (const Fresnel fresnel : {Fresnel::kNone, Fresnel::kSchlick}) {
          if (normalisation == Normalisation::kPaper && !has_paper_coefficient(lobe)) continue;
          ShaderExport request{*find_shader_language(language),
                               {all_models().begin(), all_models().end()},
                               lobe,
                               normalisation,
                               {},
                               from,
                               fresnel};
          const bool closed_form = can_be_made(request);
          if (closed_form) list.push_back(request);
          if (from == CoefficientFrom::kArgument) continue;
          for (const double n : kRunExponents) {
            if (n != 100 && (closed_form || fresnel != Fresnel::kNone)) continue;
            request.exponent = n;
            list.push_back(request);
          }
        }
    }
  std::erase_if(lists, [](const auto& list) { return list.empty(); });
  return lists;
}

/// The formulas' values at the points. Each is computed only once.
class KnownValues {
 public:
  using Key = std::tuple<int, int, int, Normalisation>;
  static Key key(const Highlight& h) {
    return {h.model.index, h.lobe.index, h.lobe.order, h.normalisation};
  }

  explicit KnownValues(const std::vector<CalledPoint>& points) : points_(points) {}

  double coefficient(const Highlight& highlight) {
    double& known = coefficients_[{key(highlight), highlight.exponent}];
    if (known == 0) known = truth::coefficient(highlight);
    return known;
  }

  /// For the point's directions and exponent, which the highlight has too.
  double shape(const Highlight& highlight, std::size_t point) {
    auto& known = shapes_[{highlight.model.index, highlight.lobe.index, highlight.lobe.order}];
    known.resize(points_.size(), -1);
    if (known[point] < 0) {
      const Directions& d = points_[point].directions;
      known[point] = truth::shape(highlight, d.normal, d.to_eye, d.to_light);
    }
    return known[point];
  }

 private:
  const std::vector<CalledPoint>& points_;
  std::map<std::pair<Key, double>, double> coefficients_;
  std::map<std::tuple<int, int, int>, std::vector<double>> shapes_;
};

/// Compares values with the formulas, and in the end the largest errors with what docs/export.md says.
class ExportJudge {
 public:
  ExportJudge(const std::vector<CalledPoint>& points, KnownValues& known)
      : points_(points), known_(known) {}

  void add(const ExportOutput& output, std::size_t i, Rgb colour) {
    const auto& [d, n, is_hard] = points_[i];
    const double given[] = {colour.r, colour.g, colour.b};
    for (const double c : given)
      ASSERT_TRUE(std::isfinite(c) && c >= 0)
          << function_name_of(output.request, output.model) << " point " << i;
    if (!output.is_coefficient && dot(d.normal, d.to_light) <= 0) {
      ASSERT_TRUE(is_black(colour)) << function_name_of(output.request, output.model);
    }
    const Highlight highlight = output.highlight(n);
    if (output.request.exponent.value_or(n) != n) return;
    const double peak = known_.coefficient(highlight);
    if (output.is_coefficient) {
      worst_coefficient_ = std::max(worst_coefficient_, std::abs(colour.r / peak - 1));
      return;
    }
    if (is_hard || is_at_an_edge(output.model, d)) return;
    const double shape = known_.shape(highlight, i);
    const Rgb fresnel = output.request.fresnel == Fresnel::kNone
                            ? Rgb{1, 1, 1}
                            : fresnel_factor(Fresnel::kSchlick, kReflectance, d.to_eye, d.to_light);
    const double expected[] = {fresnel.r, fresnel.g, fresnel.b};
    double& largest = length(d.to_eye + d.to_light) < 0.2 ? worst_opposite_[n] : worst_[n];
    // With shadowing the highlight is higher at grazing angles, and float32 knows cosines near the horizon to few digits.
    const stability::Factor by =
        stability::factor(highlight, dot(d.normal, d.to_light), dot(d.normal, d.to_eye), 0x1p-24);
    const double unsure = by.error > 0 ? shape / double(by.value) * by.error : 0;
    for (int c = 0; c < 3; ++c) {
      const double error = std::abs(given[c] / peak - expected[c] * shape) - unsure;
      largest = std::max(largest, error / by.peak());
    }
    ++compared_;
  }

  void expect_as_documented(const std::string& language) {
    for (const double n : kRunExponents) {
      fmt::print(
          "{}: n = {:g}: within {:.1e} of the peak, and {:.1e} where light and eye are nearly "
          "opposite\n",
          language, n, worst_[n], worst_opposite_[n]);
      const double allowed = n <= 1000 ? 1e-5 : 2e-7 * std::sqrt(n);
      EXPECT_LE(worst_[n], allowed) << n;
      EXPECT_LE(worst_opposite_[n], 10 * allowed) << n;
    }
    fmt::print("{}: coefficients within {:.1e}; {} values\n", language, worst_coefficient_,
               compared_);
    EXPECT_LE(worst_coefficient_, 3e-6);
    EXPECT_GT(compared_, 100'000u);
  }

 private:
  /// Where the value jumps: a rounding decides on which side float32 is.
  static bool is_at_an_edge(ModelId model, const Directions& d) {
    const double n_dot_l = dot(d.normal, d.to_light);
    const double cosine = info(model).angle == LobeAngle::kReflection
                              ? 2 * dot(d.normal, d.to_eye) * n_dot_l - dot(d.to_eye, d.to_light)
                              : dot(d.normal, normalize(d.to_eye + d.to_light));
    return std::abs(n_dot_l) < 1e-6 || std::abs(cosine) < 1e-5;
  }

  const std::vector<CalledPoint>& points_;
  KnownValues& known_;
  std::map<double, double> worst_, worst_opposite_;  ///< of the peak, by exponent
  double worst_coefficient_ = 0;
  std::size_t compared_ = 0;
};

}  // namespace lobelia
