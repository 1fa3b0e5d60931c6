#include "renderer/highlight_tables.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/constants.hpp"
#include "renderer/albedo.hpp"
#include "renderer/catalogue_record.hpp"
#include "renderer/lobe_properties.hpp"

namespace lobelia {
namespace {

constexpr int kCurvePoints = 80, kAlbedoPoints = 20;
// Values are stored as multiples of this: of their logarithm, or of a root that is at most 1.
constexpr double kLogarithmUnit = 1e-4, kRootUnit = 1e-6;
constexpr double kLeast = 1e-40;  // stands for 0, which has no logarithm

/// Angles that crowd where a highlight of this exponent is: 0 to `reach`, `points` of them after 0.
std::vector<double> angles(double reach, double exponent, int points) {
  const double most = std::asinh(reach * std::sqrt(exponent));
  std::vector<double> result;
  for (int i = 0; i <= points; ++i)
    result.push_back(reach * std::sinh(most * i / points) / std::sinh(most));
  return result;
}

double logarithm(double value) { return std::log(std::max(value, kLeast)); }

std::vector<std::int64_t> multiples(std::span<const double> values, double unit) {
  std::vector<std::int64_t> result;
  for (const double value : values) result.push_back(std::llround(value / unit));
  return result;
}

/// A lobe of a family is a power of its order, so that its root goes straight to its end; of others the
/// logarithm is smooth.
double straightened(LobeId lobe, double value) {
  return lobe.order > 0 ? std::pow(value, 1.0 / lobe.order) : logarithm(value);
}

records::LobeTable lobe_table(LobeId lobe, std::span<const double> exponents) {
  records::LobeTable table;
  table.name = info(lobe).name;
  table.title = info(lobe).title;
  table.formula = info(lobe).formula;
  table.order = lobe.order;
  table.unit = lobe.order > 0 ? kRootUnit : kLogarithmUnit;
  for (const double n : exponents) {
    const PreparedLobe prepared = prepare(lobe, n);
    const LobeProperties properties = measure(lobe, n);
    // To the horizon, or where the lobe is 0 before; just inside, because at it all of them are.
    const double reach = lobe.order > 0 && lobe.order < n ? properties.support : kRightAngle;
    std::vector<double> curve;
    for (const double angle : angles(reach, n, kCurvePoints))
      curve.push_back(straightened(lobe, prepared.value(versine(angle * (1 - 1e-9)))));
    table.reach.push_back(reach);
    table.half_width.push_back(properties.half_width);
    table.curves.push_back(multiples(curve, table.unit));
  }
  return table;
}

records::ModelTable model_table(ModelId model) {
  const ModelInfo& m = info(model);
  return {std::string(m.name),
          std::string(m.title),
          std::string(angle_name(m.angle)),
          m.applies_cosine,
          std::string(name(m.normalised)),
          exact_formula(model)};
}

/// Over incidences from grazing to normal.
std::vector<std::vector<std::int64_t>> albedos(ModelId model, LobeId lobe,
                                               std::span<const double> exponents,
                                               double (*albedo)(const Highlight&, double)) {
  std::vector<std::vector<std::int64_t>> rows;
  for (const double n : exponents) {
    std::vector<double> values;
    for (const double above : angles(kMostGrazing, n, kAlbedoPoints))
      values.push_back(
          logarithm(albedo({model, lobe, Normalisation::kExact, n}, kMostGrazing - above)));
    rows.push_back(multiples(values, kLogarithmUnit));
  }
  return rows;
}

std::vector<double> coefficients(ModelId model, LobeId lobe, Normalisation how,
                                 std::span<const double> exponents) {
  std::vector<double> result;
  for (const double n : exponents) result.push_back(radiance_coefficient({model, lobe, how, n}));
  return result;
}

records::HighlightTable highlight_table(ModelId model, LobeId lobe,
                                        std::span<const double> exponents) {
  constexpr double kSame = 1e-9;
  records::HighlightTable table;
  table.model = info(model).name;
  table.lobe = info(lobe).name;
  table.exact = coefficients(model, lobe, Normalisation::kExact, exponents);
  if (has_paper_coefficient(lobe))
    table.paper = coefficients(model, lobe, Normalisation::kPaper, exponents);
  table.unit = kLogarithmUnit;
  table.seen = albedos(model, lobe, exponents, directional_albedo);
  // Without what grows without bound: a cubic follows the rest.
  const auto lit_foreshortened = [](const Highlight& h, double incidence) {
    return directional_albedo_of_light(h, incidence) * std::cos(incidence);
  };
  if (reciprocity_gap({model, lobe, Normalisation::kExact, exponents.front()}) > kSame)
    table.lit = albedos(model, lobe, exponents, lit_foreshortened);
  return table;
}

}  // namespace

std::vector<double> table_exponents() {
  std::vector<double> result;
  for (int i = 0; i <= kTableOctaves * kExponentsPerOctave; ++i)
    result.push_back(std::exp2(double(i) / kExponentsPerOctave));
  return result;
}

records::HighlightTables highlight_tables(std::span<const double> exponents) {
  const auto lobes = all_lobes();
  const auto models = all_models();
  records::HighlightTables record;
  record.exponents.assign(exponents.begin(), exponents.end());
  record.per_octave = kExponentsPerOctave;
  record.most_grazing = kMostGrazing;
  record.error = {kCurveTableError, kAlbedoTableError, kWidthTableError, kCoefficientTableError};
  for (const ModelId model : models) record.models.push_back(model_table(model));
  record.lobes.resize(lobes.size());
  record.highlights.resize(lobes.size() * models.size());
  std::vector<std::function<void()>> jobs;
  for (std::size_t l = 0; l < lobes.size(); ++l) {
    jobs.push_back([&, l] { record.lobes[l] = lobe_table(lobes[l], exponents); });
    for (std::size_t m = 0; m < models.size(); ++m)
      jobs.push_back([&, l, m] {
        record.highlights[m * lobes.size() + l] = highlight_table(models[m], lobes[l], exponents);
      });
  }
  oneapi::tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) { jobs[i](); });
  return record;
}

}  // namespace lobelia
