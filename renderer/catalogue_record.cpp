#include "renderer/catalogue_record.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "base/words/constants.hpp"
#include "renderer/albedo.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace {

constexpr double kDegree = kPi / 180;

records::Model model_record(ModelId id) {
  const ModelInfo& m = info(id);
  records::Model record;
  record.name = m.name;
  record.title = m.title;
  record.angle = angle_name(m.angle);
  record.applies_cosine = m.applies_cosine;
  record.has_shadowing = m.has_shadowing;
  record.normalised = name(m.normalised);
  record.integral = m.integral;
  record.normalisation_constant = {exact_formula(id), std::string(formulas(id).exact_cosine),
                                   std::string(formulas(id).paper_cosine),
                                   std::string(formulas(id).paper_cs16)};
  record.operations = operations_record(operations(id));
  record.source = m.source;
  return record;
}

records::Lobe lobe_record(LobeId id, double exponent) {
  const LobeInfo& l = info(id);
  const LobeProperties p = measure(id, exponent);
  records::Lobe record;
  record.name = l.name;
  record.title = l.title;
  record.formula = l.formula;
  record.moments = l.moments;
  record.operations = operations_record(operations(id));
  record.float32_error_of_peak = lobe_float32_error(id, exponent).of_peak;
  record.half_width_degrees = p.half_width / kDegree;
  record.support_degrees = p.support / kDegree;
  record.above_cosine = p.above_cosine;
  record.below_cosine = p.below_cosine;
  record.source = l.source;
  return record;
}

records::Parameter parameter_record(const Parameter& p) {
  records::Parameter record;
  record.name = p.name;
  record.default_value = p.default_value;
  record.allowed = string_choices(p);
  if (record.allowed.empty()) {
    record.min = p.min;
    record.max = p.max;
  }
  record.meaning = p.meaning;
  return record;
}

records::AlbedoPeak albedo_record(const AlbedoPeak& peak) {
  records::AlbedoPeak record{peak.albedo, peak.incidence / kDegree, std::nullopt};
  if (peak.above_one_from) record.above_one_from_degrees = *peak.above_one_from / kDegree;
  return record;
}

records::CatalogueHighlight catalogue_highlight(const Highlight& h) {
  return {std::string(info(h.model).name),
          std::string(info(h.lobe).name),
          std::string(name(h.normalisation)),
          normalisation_constant(h),
          radiance_coefficient(h),
          directional_albedo(h, 0),
          albedo_record(largest_albedo(h)),
          albedo_record(largest_albedo_of_light(h)),
          reciprocity_gap(h)};
}

constexpr int kCurvePoints = 80, kAlbedoPoints = 20;
// Values are stored as multiples of these, of their logarithm or of a root that is at most 1.
constexpr double kLogarithmUnit = 1e-4, kRootUnit = 1e-6;
constexpr double kLeast = 1e-40;  // stands for 0, which has no logarithm

/// 0 and `points` angles up to `reach`, denser in the highlight of this exponent.
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

/// The root of a lobe of a family, which is straight up to its end; the smooth logarithm of other lobes.
double straightened(LobeId lobe, double value) {
  return lobe.order > 0 ? std::pow(value, 1.0 / lobe.order) : logarithm(value);
}

records::LobeTable lobe_table(LobeId lobe, std::span<const double> exponents) {
  records::LobeTable table;
  table.name = info(lobe).name;
  table.title = info(lobe).title;
  table.formula = info(lobe).formula;
  table.operations = operations_record(operations(lobe));
  table.order = lobe.order;
  table.unit = lobe.order > 0 ? kRootUnit : kLogarithmUnit;
  for (const double n : exponents) {
    const PreparedLobe prepared = prepare(lobe, n);
    const LobeProperties properties = measure(lobe, n);
    // Up to the horizon or to the lobe's end, and just inside of it, where lobes are not 0 yet. Of a pk3.m, whose end is
    // not smooth in n, to n s = 4 k, which is beyond.
    double reach = kRightAngle;
    if (family(lobe) == "pk" && 4 * lobe.order < n)
      reach = 2 * std::asin(std::sqrt(2 * lobe.order / n));
    else if (family(lobe) == "cs" && lobe.order < n)
      reach = properties.support;
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
  struct Integral {
    EnergyIntegral energy;
    double share;
  };
  static constexpr auto kIntegrals = map_types<Integral>(HWY_NAMESPACE::Models{}, []<class M>() {
    return Integral{M::kEnergy, M::kShare};
  });
  const auto& [energy, share] = kIntegrals.at(model.index);
  const ModelInfo& m = info(model);
  records::ModelTable table{std::string(m.name),
                            std::string(m.title),
                            std::string(angle_name(m.angle)),
                            m.applies_cosine,
                            m.has_shadowing,
                            std::string(name(m.normalised)),
                            exact_formula(model),
                            operations_record(operations(model)),
                            energy.s_max,
                            {}};
  for (const double weight : energy.weights) table.weights.push_back(2 * kPi / share * weight);
  return table;
}

/// Albedos over incidences from grazing to normal.
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
  // Times the cosine, because the albedo of light may grow without bound and a cubic could not follow.
  const auto lit_foreshortened = [](const Highlight& h, double incidence) {
    return directional_albedo_of_light(h, incidence) * std::cos(incidence);
  };
  if (reciprocity_gap({model, lobe, Normalisation::kExact, exponents.front()}) > kSame)
    table.lit = albedos(model, lobe, exponents, lit_foreshortened);
  return table;
}

}  // namespace

records::Operations operations_record(const OperationCount& c) {
  return {c.multiply_add, c.multiply,       c.add,     c.divide,
          c.root,         c.transcendental, c.compare, price(c)};
}

std::string_view angle_name(LobeAngle angle) {
  return angle == LobeAngle::kReflection ? "L and R" : "N and H";
}

std::string_view meaning(Normalisation normalisation) {
  return normalisation == Normalisation::kExact
             ? "from the integral itself, which it makes 1"
             : "the constant as the paper prints it, misprints included";
}

std::vector<Highlight> all_highlights(double exponent, std::span<const LobeId> lobes) {
  std::vector<Highlight> all;
  for (const ModelId model : all_models())
    for (const LobeId& lobe : lobes) {
      all.push_back({model, lobe, Normalisation::kExact, exponent});
      if (has_paper_coefficient(lobe))
        all.push_back({model, lobe, Normalisation::kPaper, exponent});
    }
  return all;
}

records::Models catalogue_record(double exponent, std::span<const LobeId> lobes) {
  records::Models record;
  record.measured_at_exponent = exponent;
  for (const ModelId id : all_models()) record.models.push_back(model_record(id));
  for (const LobeId& id : lobes) record.lobes.push_back(lobe_record(id, exponent));
  record.lobe_families = allowed_lobes();
  for (const std::string_view how : normalisation_names())
    record.normalisations.push_back(
        {std::string(how), std::string(meaning(*find_normalisation(how)))});
  for (const Parameter& p : kHighlightParameters) record.parameters.push_back(parameter_record(p));
  for (const Highlight& h : all_highlights(exponent, lobes))
    record.highlights.push_back(catalogue_highlight(h));
  return record;
}

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
