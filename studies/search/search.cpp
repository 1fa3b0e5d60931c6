#include "studies/search/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/pictures/half.hpp"
#include "base/system/error.hpp"
#include "base/words/error_time_chart.hpp"
#include "base/words/text.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "renderer/catalogue_record.hpp"
#include "studies/search/minimax.hpp"

namespace lobelia::search {
namespace {

constexpr double kLeastExponent = 1, kMostExponent = 1e8;
constexpr int kLeastFixedBits = 4, kMostFixedBits = 32;

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Exponents for the errors that are measured and not proved: the powers of two in the range, and its ends.
std::vector<double> looked_at(const Range& range) {
  const double most = std::min(range.most_n, 0x1p20);
  std::vector<double> exponents{range.least_n};
  for (double n = 1; n < most; n *= 2)
    if (n > range.least_n) exponents.push_back(n);
  if (most > range.least_n) exponents.push_back(most);
  return exponents;
}

Lab grey(double light) {
  const double shown = std::clamp(light, 0.0, 1.0);
  return lab_from_display({shown, shown, shown});
}

/// The lobe as a processor of that precision has it.
double rounded_value(const Lobe& lobe, const std::function<double(double)>& rounded, double s,
                     double n) {
  const double v = 1 / n, t = rounded(n * s);
  double y = rounded(lobe.coefficient(lobe.shape.degree, v));
  for (int j = lobe.shape.degree - 1; j >= 1; --j)
    y = rounded(y * t + rounded(lobe.coefficient(j, v)));
  y = rounded(y * t + rounded(lobe.constant(v)));
  double value = rounded(outer_value({lobe.shape.outer, lobe.shape.degree, 0, 0}, y));
  for (int i = 0; i < lobe.shape.squarings; ++i) value = rounded(value * value);
  return value;
}

/// Fills in the errors of a lobe.
void measure(records::SearchedLobe& record, const Range& range,
             const std::function<double(double t, double v)>& lobe,
             const std::function<double(double t, double v)>& rounding) {
  constexpr int kPoints = 2000;
  records::LobeSearchErrors& errors = record.errors;
  for (const double n : looked_at(range)) {
    const double end = std::min(n, 40.0), v = 1 / n;
    double most = 0, squares = 0, target_squares = 0, sum = 0, target_sum = 0;
    for (int i = 0; i < kPoints; ++i) {
      // In the middles of the parts.
      const double t = end * (i + 0.5) / kPoints;
      const double value = lobe(t, v), target = cosine_power(t, v);
      most = std::max(most, std::abs(value - target));
      squares += (value - target) * (value - target);
      target_squares += target * target;
      sum += value;
      target_sum += target;
      errors.de2000 = std::max(errors.de2000, ciede2000(grey(value), grey(target)));
      errors.rounding = std::max(errors.rounding, rounding(t, v));
    }
    errors.max = std::max(errors.max, most);
    errors.rms = std::max(errors.rms, std::sqrt(squares / target_squares));
    errors.energy = std::max(errors.energy, std::abs(sum / target_sum - 1));
    record.by_exponents.push_back({n, most});
  }
  errors.max = record.bound.value_or(errors.max);
}

records::SearchedLobe record_of(const Minimax& best, const Request& request, std::string name) {
  const Shape& shape = best.lobe.shape;
  const OperationCount count = operations(shape);
  records::SearchedLobe record;
  record.name = std::move(name);
  record.formula = best.lobe.formula();
  if (record.name == search::name(shape)) record.code = best.lobe.code("lobe");
  record.operations = operations_record(count);
  record.price = int(price(count));
  record.degree = shape.degree;
  record.squarings = shape.squarings;
  record.by_exponent = shape.by_n;
  record.coefficients = best.lobe.c;
  if (best.lower_bound > 0) record.lower_bound = best.lower_bound;
  for (const Touch& touch : best.touches)
    record.touches.push_back({touch.t, touch.v, touch.error, touch.weight});
  const Proof proof = prove(best.lobe, request.range);
  if (!proof.decreases) return record;
  record.bound = proof.bound;
  const auto& rounded = request.rounding.rounded;
  measure(
      record, request.range, [&](double t, double v) { return best.lobe.value(t, v); },
      [&](double t, double v) {
        const double n = 1 / v, s = rounded(t / n);
        return s < 1 ? std::abs(rounded_value(best.lobe, rounded, s, n) - best.lobe.value(n * s, v))
                     : 0.0;
      });
  return record;
}

/// Schlick's, which is of none of the families: its numerator depends on s. Not proved.
records::SearchedLobe schlick_record(const Request& request) {
  records::SearchedLobe record;
  const LobeId id = *find_lobe("schlick");
  record.name = "schlick";
  record.formula = info(id).formula;
  record.operations = operations_record(operations(id));
  record.price = int(price(id));
  measure(
      record, request.range,
      [&](double t, double v) { return lobe_value(id, std::min(1.0, t * v), 1 / v); },
      [](double, double) { return 0.0; });
  return record;
}

Lobe lobe_of(const records::SearchedLobe& record) {
  const Outer outer = record.name[0] == 'r'   ? Outer::kReciprocal
                      : record.name[0] == 'b' ? Outer::kBits
                                              : Outer::kClamp;
  return {{outer, record.degree, record.squarings, record.by_exponent, record.name[1] == 'f'},
          record.coefficients};
}

/// The best of a shape, with no more terms in 1/n than help.
std::optional<records::SearchedLobe> best_of(Shape shape, const Request& request) {
  constexpr int kMostTerms = 2;
  constexpr double kHelps = 0.999;
  // Over less than this the coefficients do not depend on n as far as 10 digits show.
  constexpr double kNarrow = 1.001;
  const bool one_exponent = request.range.most_n <= kNarrow * request.range.least_n;
  std::optional<records::SearchedLobe> best;
  for (int by_n = 0; by_n <= (request.by_n && !one_exponent ? kMostTerms : 0); ++by_n) {
    shape.by_n = by_n;
    const Minimax found = minimax(shape, request.range);
    if (found.lobe.c.empty()) continue;
    records::SearchedLobe record = record_of(found, request, name(shape));
    if (record.bound && (!best || *record.bound < kHelps * *best->bound)) best = std::move(record);
  }
  return best;
}

}  // namespace

Rounding parse_rounding(const std::string& text) {
  if (text == "float32") return {text, 0x1p-25, [](double x) { return double(float(x)); }};
  if (text == "float16") return {text, 0x1p-12, [](double x) { return rounded_to_half(x); }};
  constexpr std::string_view kFixed = "fixed:";
  if (text.starts_with(kFixed)) {
    const auto bits = number(std::string_view(text).substr(kFixed.size()));
    if (bits && *bits == std::floor(*bits) && *bits >= kLeastFixedBits && *bits <= kMostFixedBits) {
      const double scale = std::exp2(*bits);
      return {text, 0.5 / scale, [scale](double x) { return std::nearbyint(x * scale) / scale; }};
    }
  }
  throw Error(ExitCode::kUsage,
              "--precision '{}' is unknown; allowed: float32, float16, fixed:BITS with "
              "{} to {} bits behind the point",
              printable(text), kLeastFixedBits, kMostFixedBits);
}

Range parse_range(const std::string& text) {
  const std::size_t dots = text.find("..");
  const std::string_view all = text;
  const auto first = number(all.substr(0, dots));
  std::optional<double> last = first;
  if (dots != std::string::npos)
    last = all.substr(dots + 2) == "inf" ? std::numeric_limits<double>::infinity()
                                         : number(all.substr(dots + 2));
  if (!first || !last || !(*first >= kLeastExponent) || !(*first <= kMostExponent) ||
      !(*last <= kMostExponent || std::isinf(*last)))
    throw Error(
        ExitCode::kUsage,
        "--exponents '{}' is no range; allowed: N, or N..N or N..inf, with N from {} to {:g}",
        printable(text), kLeastExponent, kMostExponent);
  if (*last < *first)
    throw Error(ExitCode::kUsage, "--exponents '{}' is empty: {:g} is over {:g}", text, *first,
                *last);
  return {*first, *last};
}

double error_of(const records::SearchedLobe& lobe, const std::string& metric) {
  if (metric == "rms") return lobe.errors.rms;
  if (metric == "energy") return lobe.errors.energy;
  if (metric == "de2000") return lobe.errors.de2000;
  return lobe.errors.max + lobe.errors.rounding;
}

int most_price(const Request& request) {
  return request.price.value_or(request.error ? kMostPrice : kUsualPrice);
}

bool is_met(const records::LobeSearch& found, const Request& request) {
  return !found.chosen.empty() || (!request.error && !request.price);
}

records::LobeSearch search(const Request& request) {
  if (request.error && request.metric == "max" && *request.error < request.rounding.step)
    throw Error(ExitCode::kUsage,
                "--error {:g} is below the rounding of {}, which is {:.2g} near the peak",
                *request.error, request.rounding.name, request.rounding.step);
  records::LobeSearch found;
  found.least_exponent = request.range.least_n;
  if (std::isfinite(request.range.most_n)) found.most_exponent = request.range.most_n;
  found.metric = request.metric;
  found.precision = request.rounding.name;
  found.coefficients = request.by_n ? "by-n" : "constant";
  found.family = request.family;
  const bool free_peak = request.family == "free";
  std::vector<Shape> all = shapes(most_price(request), free_peak);
  if (request.family != "all" && !free_peak)
    std::erase_if(all, [&](const Shape& s) { return !name(s).starts_with(request.family); });
  int dearest = 0;
  bool is_enough = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int next = int(price(operations(all[i])));
    if (is_enough && next > dearest) break;
    dearest = next;
    if (request.on_progress) request.on_progress(double(i) / double(all.size()), name(all[i]));
    auto best = best_of(all[i], request);
    if (!best) {
      found.not_proved.push_back(name(all[i]));
      continue;
    }
    is_enough = is_enough || (request.error && error_of(*best, request.metric) <= *request.error);
    found.lobes.push_back(std::move(*best));
  }
  // A degree that does not help makes no lobe of its own.
  const auto helps = [&](const records::SearchedLobe& lobe) {
    return std::ranges::none_of(found.lobes, [&](const records::SearchedLobe& other) {
      return other.name.substr(0, 2) == lobe.name.substr(0, 2) &&
             other.squarings == lobe.squarings && other.degree < lobe.degree &&
             *other.bound <= (1 + kSlack) * *lobe.bound;
    });
  };
  std::vector<records::SearchedLobe> helpful;
  std::ranges::copy_if(found.lobes, std::back_inserter(helpful), helps);
  found.lobes = std::move(helpful);
  // The front: cheapest first, each nearer than all before it.
  double nearest = std::numeric_limits<double>::infinity();
  std::ranges::stable_sort(found.lobes, [&](const auto& a, const auto& b) {
    return std::pair(a.price, error_of(a, request.metric)) <
           std::pair(b.price, error_of(b, request.metric));
  });
  for (records::SearchedLobe& lobe : found.lobes) {
    const double error = error_of(lobe, request.metric);
    lobe.is_on_front = error < (1 - kSlack) * nearest;
    nearest = std::min(nearest, error);
    if (request.error ? found.chosen.empty() && error <= *request.error
                      : request.price.has_value() && lobe.is_on_front)
      found.chosen = lobe.name;
  }
  // The paper's, whose slope is k's inverse for every n; its lobes compete with none.
  for (int squarings = 1; squarings <= 6; ++squarings) {
    const Shape shape{Outer::kClamp, 1, squarings, 0};
    Minimax paper;
    paper.lobe = {shape, {-1.0 / shape.power()}};
    found.lobes.push_back(record_of(paper, request, fmt::format("cs{}", shape.power())));
  }
  std::vector<Lobe> lobes;
  for (const records::SearchedLobe& lobe : found.lobes) lobes.push_back(lobe_of(lobe));
  found.lobes.push_back(schlick_record(request));
  const std::vector<Times> times = times_of(lobes, *find_lobe("schlick"));
  for (std::size_t i = 0; i < times.size(); ++i)
    found.lobes[i].seconds = {times[i].median, times[i].spread};
  const int most = is_enough ? dearest : most_price(request);
  // Schlick's lobe, which has no bound, is shown whatever its price.
  const bool asked = request.error || request.price;
  std::erase_if(found.lobes, [&](const records::SearchedLobe& lobe) {
    return lobe.price > most && (asked || lobe.bound);
  });
  std::ranges::stable_sort(found.lobes, {}, &records::SearchedLobe::price);
  ErrorTimes prices;
  prices.cost_unit = "operations";
  for (const records::SearchedLobe& lobe : found.lobes) {
    // The paper's and Schlick's are of no family, and answers go by the largest error.
    if (lobe.code.empty() || request.metric != "max") continue;
    TimedError& point = prices.points.emplace_back();
    point.name = fmt::format("{}, {} a value", lobe.name, short_time_text(lobe.seconds.median));
    point.cost = lobe.price;
    point.error = lobe.errors.max + lobe.errors.rounding;
  }
  found.answers = answers(prices);
  return found;
}

}  // namespace lobelia::search
