#include "compare/set/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/catalogue.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

/// How bad a value is: NaN is worse than anything.
double badness(Better better, double value) {
  if (std::isnan(value)) return std::numeric_limits<double>::infinity();
  return better == Better::kHigher ? -value : std::abs(value);
}

}  // namespace

Verdict PairReport::verdict() const {
  return layers ? worst_verdict(comparison->verdict, *layers) : comparison->verdict;
}

records::SetSummary count(const SetReport& report) {
  records::SetSummary counts;
  counts.pairs = report.pairs.size();
  for (const PairReport& pair : report.pairs) {
    if (!pair.comparison) {
      ++counts.errors;
      continue;
    }
    switch (pair.verdict()) {
      case Verdict::kPass:
      case Verdict::kSame:
        ++counts.pass;
        break;
      case Verdict::kDiffers:
      case Verdict::kDifferent:
        ++counts.differs;
        break;
      case Verdict::kUndecided:
        ++counts.undecided;
        break;
      case Verdict::kNonFinite:
        ++counts.non_finite;
        break;
    }
  }
  counts.missing = report.missing.size();
  counts.extra = report.extra.size();
  counts.passed_over = report.passed_over;
  counts.links_not_followed = report.not_followed.size();
  return counts;
}

SetNotCompared not_compared(const SetReport& report) {
  SetNotCompared result;
  for (const PairReport& pair : report.pairs) {
    if (!pair.layers || is_empty(pair.layers->not_compared)) continue;
    ++result.pairs;
    add(pair.layers->not_compared, result.all);
  }
  return result;
}

ExitCode set_exit_code(const SetReport& report) {
  const records::SetSummary counts = count(report);
  if (counts.errors > 0 || report.pairs.empty()) return ExitCode::kInput;
  return counts.differs + counts.undecided + counts.non_finite + counts.missing +
                     counts.links_not_followed >
                 0
             ? ExitCode::kDiffers
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
        if (!pair.comparison) continue;
        for (const MetricValue& value : pair.comparison->metrics) {
          if (value.id != output.id) continue;
          ++pairs_with;
          summary.mean += value.value;
          if (!summary.worst_at ||
              badness(output.better, value.value) > badness(output.better, summary.worst)) {
            summary.worst = value.value;
            summary.worst_at = &pair;
          }
        }
      }
      if (pairs_with == 0) continue;
      summary.mean /= double(pairs_with);
      summaries.push_back(summary);
    }
  return summaries;
}

std::string value_text(const Comparison& comparison, const LimitResult& limit) {
  const std::string_view why = comparison.why_not_measured(limit.metric);
  return why.empty() ? fmt::format("is {:.6g}", limit.value)
                     : fmt::format("was not measured ({})", why);
}

std::string why_not_pass(const Comparison& comparison, std::string_view file_a,
                         std::string_view file_b) {
  if (comparison.verdict == Verdict::kNonFinite) {
    const bool in_a = comparison.first_nonfinite_a.has_value();
    const auto& place = in_a ? comparison.first_nonfinite_a : comparison.first_nonfinite_b;
    return fmt::format("pixels with a NaN or an infinity: {} in a, {} in b; the first is {}",
                       comparison.nonfinite_a, comparison.nonfinite_b,
                       place ? place_text(*place, in_a ? file_a : file_b) : "unknown");
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

}  // namespace lobelia
