#include "studies/convert/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "base/words/constants.hpp"
#include "renderer/ggx.hpp"
#include "studies/convert/curve.hpp"

namespace lobelia::conversion {
namespace {

constexpr double kInDegrees = 180 / kPi;

/// Searches go by the logarithm of the parameter. Below an exponent of 1e-3 a highlight hardly changes.
double least_searched(ShadingModel model) { return model.is_ggx() ? model.min() : 1e-3; }

/// The quantity that a measure minimises.
double distance(Measure measure, const Curve& from, const Curve& to) {
  switch (measure) {
    case Measure::kMax:
      return largest_difference(from, to).value;
    case Measure::kEnergy:
      return misplaced_energy(from, to);
    default:
      return largest_ciede2000(from, to).value;
  }
}

/// The parameter with a given half-width. Wider means a smaller exponent and a larger alpha.
Best parameter_of_width(ShadingModel model, double f0, double half_width) {
  const auto is_wider = [&](double parameter) {
    return Curve(model, parameter, f0).half_width() > half_width;
  };
  double narrowest = least_searched(model), widest = model.max();
  if (!model.is_ggx()) std::swap(narrowest, widest);
  if (is_wider(narrowest)) return {narrowest, true};
  if (!is_wider(widest)) return {model.is_ggx() ? widest : model.min(), true};
  double narrow = std::log(narrowest), wide = std::log(widest);
  for (int step = 0; step < 60; ++step) {
    const double middle = (narrow + wide) / 2;
    (is_wider(std::exp(middle)) ? wide : narrow) = middle;
  }
  return {std::exp(narrow), false};
}

records::ConvertedHighlight highlight_of(const Curve& curve) {
  records::ConvertedHighlight record;
  record.model = curve.model().name();
  if (curve.model().is_ggx()) {
    record.alpha = curve.parameter();
    record.roughness = std::sqrt(curve.parameter());
  } else {
    record.exponent = curve.parameter();
  }
  record.peak = curve.peak();
  record.half_width_degrees = curve.half_width() * kInDegrees;
  record.energy = curve.energy();
  return record;
}

records::ConversionErrors errors_of(const Curve& from, const Curve& to) {
  const Largest largest = largest_difference(from, to);
  records::ConversionErrors record;
  record.largest_of_peak = largest.value / from.peak();
  record.largest_at_degrees = largest.angle * kInDegrees;
  record.peak_ratio = to.peak() / from.peak();
  record.half_width_ratio = to.half_width() / from.half_width();
  record.energy_ratio = to.energy() / from.energy();
  record.misplaced_energy = misplaced_energy(from, to) / from.energy();
  record.largest_ciede2000 = largest_ciede2000(from, to).value;
  return record;
}

records::ConversionBest best_record(const Request& request, const Curve& from, Measure measure) {
  records::ConversionBest record;
  record.measure = records::kConversionMeasures[std::size_t(measure)];
  const Best best = best_parameter(request, measure);
  const Curve to(request.to, best.parameter, request.f0);
  record.highlight = highlight_of(to);
  record.errors = errors_of(from, to);
  record.is_end_of_range = best.at_end;
  return record;
}

/// Why a rule's parameter has no highlight; empty if it has one.
std::string why_no_highlight(ShadingModel model, std::optional<double> parameter) {
  if (!parameter) return "the rule has no such exponent";
  if (model.is_ggx()) return *parameter > 0 ? "" : "alpha 0 is a mirror";
  if (*parameter < kMinExponent || *parameter > kMaxExponent)
    return fmt::format("exponent {:.6g} is outside {:g} to {:g}", *parameter, kMinExponent,
                       kMaxExponent);
  return "";
}

records::ConversionRule rule_record(const Request& request, const Curve& from, const Rule& rule) {
  records::ConversionRule record;
  record.name = rule.name;
  record.formula = rule.formula;
  record.source = rule.source;
  const std::optional<double> parameter = rule.convert(request.parameter);
  record.because = why_no_highlight(request.to, parameter);
  if (!record.because.empty()) return record;
  const Curve to(request.to, *parameter, request.f0);
  record.highlight = highlight_of(to);
  record.errors = errors_of(from, to);
  return record;
}

double parameter_of(const records::ConvertedHighlight& highlight) {
  return highlight.alpha ? *highlight.alpha : *highlight.exponent;
}

/// The curves of the chart: the converted highlight, the best match, and as many rules of thumb as there are line styles.
std::vector<records::ChartSeries> curves_of(const Request& request, const Curve& from,
                                            const records::Conversion& conversion) {
  constexpr int kPoints = 400;
  constexpr double kWidths = 4;  // beyond them hardly anything is left
  constexpr std::size_t kStyles = 6;
  const double end = std::min(kRightAngle, kWidths * from.half_width());
  std::vector<records::ChartSeries> curves;
  const auto add = [&](std::string name, const Curve& curve) {
    records::ChartSeries series{std::move(name), int(curves.size()), {}, {}};
    for (int i = 0; i <= kPoints; ++i) {
      const double angle = end * i / kPoints;
      series.x.push_back(angle * kInDegrees);
      series.y.push_back(curve(angle) / from.peak());
    }
    curves.push_back(std::move(series));
  };
  add(conversion.from.model, from);
  const auto& best = conversion.best[std::size_t(request.measure)].highlight;
  add(fmt::format("best {}", best.model), Curve(request.to, parameter_of(best), request.f0));
  for (const records::ConversionRule& rule : conversion.rules)
    if (rule.highlight && curves.size() < kStyles)
      add(rule.name, Curve(request.to, parameter_of(*rule.highlight), request.f0));
  return curves;
}

}  // namespace

Best parameter_of_least(const std::function<double(double)>& error, double min, double max) {
  constexpr double kStep = 0.1, kEnd = 1e-6;  // of the logarithm
  const double from = std::log(min), to = std::log(max);
  const auto error_of = [&](double t) { return error(std::exp(t)); };
  std::vector<double> samples, errors;
  for (double t = from; t < to; t += kStep) samples.push_back(t);
  samples.push_back(to);
  for (const double t : samples) errors.push_back(error_of(t));
  // The floor of a valley is below its lowest sample by a smaller share than this.
  constexpr double kNear = 1.2;
  const double smallest = *std::ranges::min_element(errors);
  double best = from, least = kInfinity;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, samples.size() - 1);
    if (errors[i] > std::min({errors[before], errors[after], kNear * smallest})) continue;
    const auto [t, value] =
        boost::math::tools::brent_find_minima(error_of, samples[before], samples[after], 40);
    for (const auto& [at, reached] : {std::pair(t, value), {samples[i], errors[i]}})
      if (reached < least) {
        best = at;
        least = reached;
      }
  }
  if (best - from < kEnd) return {min, true};
  if (to - best < kEnd) return {max, true};
  return {std::exp(best), false};
}

Best best_parameter(const Request& request, Measure measure) {
  const Curve from(request.from, request.parameter, request.f0);
  if (measure == Measure::kWidth)
    return parameter_of_width(request.to, request.f0, from.half_width());
  const auto error = [&](double parameter) {
    return distance(measure, from, Curve(request.to, parameter, request.f0));
  };
  const double least = least_searched(request.to), flat = request.to.min();
  const Best best = parameter_of_least(error, least, request.to.max());
  return best.parameter == least || error(flat) <= error(best.parameter) ? Best{flat, true} : best;
}

records::ConversionBest convert_to_best(const Request& request) {
  return best_record(request, Curve(request.from, request.parameter, request.f0), request.measure);
}

std::vector<records::ConversionRule> convert_by_rules(const Request& request) {
  const Curve from(request.from, request.parameter, request.f0);
  std::vector<records::ConversionRule> records;
  for (const Rule& rule : rules(request.from, request.to))
    records.push_back(rule_record(request, from, rule));
  return records;
}

records::ConvertedHighlight convert_from(const Request& request) {
  return highlight_of(Curve(request.from, request.parameter, request.f0));
}

records::Conversion convert(const Request& request) {
  const Curve from(request.from, request.parameter, request.f0);
  records::Conversion record;
  record.reflectance = request.f0;
  record.from = highlight_of(from);
  record.to = request.to.name();
  record.measure = records::kConversionMeasures[std::size_t(request.measure)];
  for (std::size_t i = 0; i < std::size(records::kConversionMeasures); ++i)
    record.best.push_back(best_record(request, from, Measure(i)));
  record.rules = convert_by_rules(request);
  record.curves = curves_of(request, from, record);
  return record;
}

}  // namespace lobelia::conversion
