#include "compare/set/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "compare/metrics/catalogue.hpp"
#include "core/constants.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

/// Larger is worse; NaN is the worst.
double badness(Better better, double value) {
  if (std::isnan(value)) return kInfinity;
  return better == Better::kHigher ? -value : std::abs(value);
}

/// Two digits, or of 10 and more a whole number.
std::string plain_number(double value) {
  return value < 10 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

/// How many times over its limit the worst figure is.
double excess(const Comparison& comparison) {
  double worst = 0;
  for (const LimitResult& limit : comparison.limits) {
    if (std::isnan(limit.value)) return kInfinity;
    const bool likeness = find_metric_output(limit.metric)->better == Better::kHigher;
    const double by = likeness ? (limit.value != 0 ? limit.limit / limit.value : kInfinity)
                      : limit.limit != 0 ? std::abs(limit.value) / limit.limit
                                         : (limit.value != 0 ? kInfinity : 0);
    worst = std::max(worst, by);
  }
  return worst;
}

}  // namespace

Verdict PairReport::verdict() const {
  return layers ? worst_verdict(comparison->verdict, *layers) : comparison->verdict;
}

bool PairReport::is_excused() const {
  return known && !known->is_expired && comparison && !is_pass(verdict());
}

std::string known_text(const PairReport& pair) {
  if (!pair.known) return "";
  const auto& [reason, expires, is_expired] = *pair.known;
  return fmt::format("{} {}: {}", is_expired ? "known, but expired on" : "known until", expires,
                     reason);
}

double excess(const PairReport& pair) {
  if (!pair.comparison) return kInfinity;
  double worst = excess(*pair.comparison);
  if (pair.layers)
    for (const LayerComparison& layer : pair.layers->compared)
      if (layer.comparison) worst = std::max(worst, excess(*layer.comparison));
  return worst;
}

std::optional<Problem::Weight> weight_of(const PairReport& pair) {
  if (is_pass(pair.verdict())) return std::nullopt;
  return pair.is_excused()                       ? Problem::Weight::kNotice
         : pair.verdict() == Verdict::kUndecided ? Problem::Weight::kWarns
                                                 : Problem::Weight::kFails;
}

std::vector<Problem> problems(const SetReport& report) {
  using Weight = Problem::Weight;
  std::vector<Problem> list;
  const auto add = [&](Weight weight, std::string_view what, const std::string& name,
                       std::string why, const PairReport* pair = nullptr) {
    list.push_back({weight, what, name, std::move(why), pair});
  };
  for (const PairReport& pair : report.pairs)
    if (!pair.comparison) add(Weight::kFails, "error", pair.name, pair.error);
  for (const std::string& name : report.missing)
    add(Weight::kFails, "missing", name, "there is only a reference");
  for (const std::string& name : report.not_followed)
    add(Weight::kFails, "link", name, std::string(kNotFollowed));
  for (const std::string& name : report.misnamed)
    add(Weight::kFails, "misnamed", name, std::string(kMisnamed));
  std::vector<const PairReport*> worst_first;
  for (const PairReport& pair : report.pairs)
    if (pair.comparison) worst_first.push_back(&pair);
  std::ranges::stable_sort(worst_first, [](const PairReport* p, const PairReport* q) {
    return excess(*p) > excess(*q);
  });
  for (const PairReport* pair : worst_first) {
    const auto weight = weight_of(*pair);
    if (!weight) continue;
    std::string why = why_not_pass(*pair);
    if (const std::string known = known_text(*pair); !known.empty())
      why = fmt::format("{} ({})", why, known);
    add(*weight, pair->is_excused() ? "known" : verdict_name(pair->verdict()), pair->name,
        std::move(why), pair);
  }
  for (const PairReport* pair : worst_first) {
    for (const LimitResult& limit : pair->comparison->warnings)
      if (!limit.pass)
        add(Weight::kWarns, "warning", pair->name,
            fmt::format("{} {}, limit {:g}", limit.metric, value_text(*pair->comparison, limit),
                        limit.limit),
            pair);
    if (pair->known && is_pass(pair->verdict()))
      add(Weight::kNotice, "no longer", pair->name,
          fmt::format("it passes, but the project says that it is {}", known_text(*pair)), pair);
  }
  for (const std::string& name : report.extra)
    add(Weight::kNotice, "extra", name, "there is no reference");
  return list;
}

records::SetSummary count(const SetReport& report) {
  records::SetSummary counts;
  counts.pairs = report.pairs.size();
  // In the order of Verdict.
  std::size_t* const of_verdict[] = {&counts.pass, &counts.differs, &counts.non_finite,
                                     &counts.pass, &counts.differs, &counts.undecided};
  for (const PairReport& pair : report.pairs) {
    if (pair.known && !counts.known) counts.known = 0;
    ++(pair.is_excused() ? *counts.known
       : pair.comparison ? *of_verdict[std::size_t(pair.verdict())]
                         : counts.errors);
  }
  counts.missing = report.missing.size();
  counts.extra = report.extra.size();
  counts.passed_over = report.passed_over;
  counts.links_not_followed = report.not_followed.size();
  if (!report.misnamed.empty()) counts.misnamed = report.misnamed.size();
  return counts;
}

std::string counts_text(const SetReport& report) {
  const records::SetSummary counts = count(report);
  const auto some = [](std::size_t number, std::string_view what) {
    return number > 0 ? fmt::format("{} {}, ", number, what) : "";
  };
  return fmt::format(
      "{} pairs: {} pass, {} differ, {}{}{} not finite, {} not comparable; {} missing, {}{} extra",
      counts.pairs, counts.pass, counts.differs, some(counts.known.value_or(0), "known to differ"),
      some(counts.undecided, "undecided"), counts.non_finite, counts.errors, counts.missing,
      some(counts.misnamed.value_or(0), "misnamed"), counts.extra);
}

SetNotCompared not_compared(const SetReport& report) {
  SetNotCompared result;
  std::set<std::string> known;
  for (const PairReport& pair : report.pairs) {
    if (!pair.layers || is_empty(pair.layers->not_compared)) continue;
    ++result.pairs;
    const NotCompared& one = pair.layers->not_compared;
    for (const std::string& name : one.layers)
      if (known.insert(name).second) result.all.layers.push_back(name);
    result.all.alpha = result.all.alpha || one.alpha;
    result.all.overscan_pixels += one.overscan_pixels;
    result.all.mip_levels = std::max(result.all.mip_levels, one.mip_levels);
  }
  return result;
}

ExitCode set_exit_code(const SetReport& report) {
  const records::SetSummary counts = count(report);
  if (counts.errors > 0 || report.pairs.empty()) return ExitCode::kInput;
  const std::size_t failures = counts.differs + counts.non_finite + counts.missing +
                               counts.links_not_followed + counts.misnamed.value_or(0);
  return failures > 0           ? ExitCode::kDiffers
         : counts.undecided > 0 ? ExitCode::kUndecided
                                : ExitCode::kSuccess;
}

std::vector<MetricSummary> summarise(std::span<const PairReport> pairs) {
  std::vector<MetricSummary> summaries;
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      if (output.better == Better::kNeither) continue;
      MetricSummary summary{output.id, 0, 0, nullptr};
      std::size_t pairs_with = 0;
      for (const PairReport& pair : pairs) {
        const double* value =
            pair.comparison ? records::find(pair.comparison->metrics, output.id) : nullptr;
        if (!value) continue;
        ++pairs_with;
        summary.mean += *value;
        if (summary.worst_at &&
            badness(output.better, *value) <= badness(output.better, summary.worst))
          continue;
        summary.worst = *value;
        summary.worst_at = &pair;
      }
      if (pairs_with == 0) continue;
      summary.mean /= double(pairs_with);
      summaries.push_back(summary);
    }
  return summaries;
}

std::string highlight_sentence(const Comparison& comparison, std::string_view a,
                               std::string_view b) {
  const double energy = comparison.value("energy.highlight");
  if (std::isnan(energy)) return "";
  if (energy == -1) return fmt::format("{} has no highlight where {} has one", a, b);
  if (std::isinf(energy)) return fmt::format("{} has no highlight where {} has one", b, a);
  // Smaller shares and shifts are said to be equal.
  constexpr double kLeastShare = 0.001, kLeastShift = 0.05;
  const auto words = [](double share, std::string_view more, std::string_view less,
                        std::string_view as) {
    if (std::abs(share) < kLeastShare) return std::string();
    if (share >= 1) return fmt::format("{} times as {}", plain_number(1 + share), as);
    return fmt::format("{} % {}", plain_number(100 * std::abs(share)), share > 0 ? more : less);
  };
  std::vector<std::string> parts;
  for (std::string& part :
       std::array{words(comparison.value("width.highlight"), "wider", "narrower", "wide"),
                  words(comparison.value("brightness.highlight"), "brighter", "dimmer", "bright")})
    if (!part.empty()) parts.push_back(std::move(part));
  const std::string more_energy = words(energy, "more", "less", "much");
  const double right = comparison.value("shift.highlight.x"),
               down = comparison.value("shift.highlight.y");
  std::vector<std::string> ways;
  if (std::abs(right) >= kLeastShift)
    ways.push_back(fmt::format("{} pixels to the {}", plain_number(std::abs(right)),
                               right > 0 ? "right" : "left"));
  if (std::abs(down) >= kLeastShift)
    ways.push_back(
        fmt::format("{} pixels {}", plain_number(std::abs(down)), down > 0 ? "down" : "up"));
  std::string text = parts.empty()
                         ? fmt::format("{}'s highlight is as wide and as bright as {}'s", a, b)
                         : fmt::format("{}'s highlight is {}", a, fmt::join(parts, " and "));
  text += more_energy.empty() ? ", its energy equal" : ", its energy " + more_energy;
  if (!ways.empty()) text += fmt::format("; it lies {}", fmt::join(ways, " and "));
  // In a bright picture nothing stands out, and the sentence is of nearly everything.
  if (comparison.highlight_share > 0.5)
    text += fmt::format("; {:.0f} % of the picture count as highlight",
                        100 * comparison.highlight_share);
  return text;
}

std::string value_text(const Comparison& comparison, const LimitResult& limit) {
  const std::string_view why = comparison.why_not_measured(limit.metric);
  return why.empty() ? fmt::format("is {:.6g}", limit.value)
                     : fmt::format("was not measured ({})", why);
}

std::string why_not_pass(const Comparison& comparison, std::string_view file_a,
                         std::string_view file_b) {
  if (comparison.verdict == Verdict::kNonFinite) {
    const auto& [a, b, first, equal] = comparison.nonfinite;
    return fmt::format("pixels with a NaN or an infinity: {} in a, {} in b; the first is {}", a, b,
                       first->a ? place_text(*first->a, file_a) : place_text(*first->b, file_b));
  }
  std::string text;
  for (const LimitResult& limit : comparison.limits)
    if (!limit.pass)
      text += fmt::format("{}{} {}, limit {:g}", text.empty() ? "" : "; ", limit.metric,
                          value_text(comparison, limit), limit.limit);
  return text;
}

std::string why_not_pass(const PairReport& pair) {
  std::string text = why_not_pass(*pair.comparison, pair.a, pair.b);
  if (!pair.layers) return text;
  const auto add = [&](const std::string& title, const std::string& why) {
    if (!why.empty()) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", title, why);
  };
  for (const LayerComparison& layer : pair.layers->compared)
    add(layer.title(),
        layer.comparison ? why_not_pass(*layer.comparison, pair.a, pair.b) : layer.problem);
  if (pair.layers->common)
    for (const std::string& name : pair.layers->common->only_b)
      add(name.empty() ? "the picture" : "layer " + printable(name), "only b has it");
  return text;
}

records::Comparison pair_record(const PairReport& pair) {
  records::Comparison record = comparison_record(*pair.comparison, pair.a, pair.b, pair.c);
  if (pair.sources) record.pictures = pictures_record(pair.sources->a, pair.sources->b);
  if (pair.layers) add_layers(record, pair.verdict(), *pair.layers);
  return record;
}

records::ComparisonSet set_record(const SetReport& report) {
  records::ComparisonSet record;
  record.a = report.a;
  record.b = report.b;
  record.c = report.c;
  record.summary = count(report);
  const SetNotCompared left = not_compared(report);
  record.not_compared = {left.all.layers, left.all.alpha, left.all.overscan_pixels,
                         left.all.mip_levels, left.pairs};
  for (const MetricSummary& metric : summarise(report.pairs))
    record.worst.emplace_back(
        metric.id, records::WorstOfSet{metric.worst, metric.worst_at->name, metric.mean});
  record.missing = report.missing;
  record.extra = report.extra;
  record.links_not_followed = report.not_followed;
  record.misnamed = report.misnamed;
  for (const PairReport& pair : report.pairs) {
    records::PairOfSet& one = record.pairs.emplace_back();
    one.name = pair.name;
    one.known = pair.known;
    if (pair.references.size() > 1) one.references = int(pair.references.size());
    if (pair.comparison)
      one.comparison = pair_record(pair);
    else
      one.error = pair.error;
  }
  return record;
}

}  // namespace lobelia
