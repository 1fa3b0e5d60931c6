#include "gallery/cells/change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

constexpr char kLargestDifference[] = "max_rel_peak";
constexpr double kShareOfValue = 0.01, kShareOfLimit = 0.01;
/// Two pictures in float32 may each be half a unit in the last place of the peak off.
constexpr double kFloat32 = 0x1p-23;

/// In the order of Change.
constexpr ChangeInfo kChangeInfos[] = {
    {"worse", "worse", "▼",
     "Since the earlier run its status or a verdict got worse, or its largest difference grew by more than noise."},
    {"better", "better", "▲", "The reverse, and no engine got worse."},
    {"new", "new", "+", "The earlier run did not have this cell, or no picture of it."},
    {"unknown", "not comparable with before", "?",
     "A file of the earlier run is missing, damaged or changed."},
    {"same", "as before", "=", "Nothing changed by more than noise."}};
static_assert(std::size(kChangeInfos) == kChanges.size());

/// Higher is worse.
int severity(const CheckedComparison& comparison) {
  if (comparison.doubt || !comparison.problem.empty()) return 4;
  return rank(comparison.verdict);
}

std::string plain_verdict(const CheckedComparison& comparison) {
  if (comparison.doubt) return std::string(info(*comparison.doubt).word);
  if (!comparison.problem.empty()) return "unreadable";
  return comparison.verdict.empty() ? "no verdict" : comparison.verdict;
}

/// Higher is worse. A cell without hashes counts as a pass: its verdict was one.
std::size_t severity(CellStatus status) {
  return rank(status == CellStatus::kUnsealed ? CellStatus::kPass : status);
}

Change change_of_ranks(std::size_t was, std::size_t now) {
  return now > was ? Change::kWorse : now < was ? Change::kBetter : Change::kSame;
}

/// For a similarity up to 1: its distance from 1. For an error: its size.
double badness(double value, bool more_is_better, bool is_likeness) {
  if (is_likeness) return 1 - value;
  return more_is_better ? -value : std::abs(value);
}

bool overlap(const Reading& p, const Reading& q) {
  if (!p.bar && !q.bar) return false;
  const auto low = [](const Reading& r) { return r.bar ? r.bar->low : r.value; };
  const auto high = [](const Reading& r) { return r.bar ? r.bar->high : r.value; };
  return !(high(p) < low(q)) && !(high(q) < low(p));
}

std::vector<std::string> ids_of(const CheckedComparison& was, const CheckedComparison& now) {
  std::vector<std::string> ids;
  for (const records::Comparison* record : {&now.record, &was.record})
    for (const auto& [id, value] : record->metrics)
      if (!is_coordinate(id) && std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  return ids;
}

/// The records of two runs, with their limits.
struct ThenAndNow {
  const records::Comparison &was, &now;
  records::Named<double> limits_then = limits_of(was), limits_now = limits_of(now);
};

MetricChange compare_metric(const std::string& id, const ThenAndNow& both,
                            const MetricInfo& metric) {
  const auto before = reading_of(both.was, both.limits_then, id, metric),
             after = reading_of(both.now, both.limits_now, id, metric);
  MetricChange result{id, {}, {}, {}, Change::kSame};
  if (before) result.was = before->value;
  if (after) result.now = after->value, result.limit = after->limit;
  if (before && after) result.change = change_of(*before, *after, metric.more_is_better);
  if (!before && after) result.change = Change::kNew;
  return result;
}

EngineChange compare_engines(const CheckedComparison* was, const CheckedComparison& now,
                             const std::string& engine, const ShownFarm& farm) {
  EngineChange result;
  result.engine = engine;
  result.now = verdict_words(now);
  result.main = main_metric(now.record);
  if (!was) {
    result.change = Change::kNew;
    result.was = "not compared";
    return result;
  }
  result.was = verdict_words(*was);
  const ThenAndNow both{was->record, now.record};
  for (const std::string& id : ids_of(*was, now))
    result.metrics.push_back(compare_metric(id, both, farm.metrics.info(id)));
  if (severity(*was) > 3) {
    result.change = Change::kUnknown;
    return result;
  }
  result.change = change_of_ranks(std::size_t(severity(*was)), std::size_t(severity(now)));
  if (result.change != Change::kSame) {
    result.reason = fmt::format("{} became {}", plain_verdict(*was), plain_verdict(now));
    return result;
  }
  const auto main = std::ranges::find(result.metrics, result.main, &MetricChange::id);
  if (main == result.metrics.end() || main->change == Change::kSame || !main->was || !main->now)
    return result;
  result.change = main->change;
  result.reason =
      fmt::format("{} {} became {}", farm.metrics.info(main->id).title,
                  farm.metrics.text(main->id, *main->was), farm.metrics.text(main->id, *main->now));
  return result;
}

}  // namespace

const ChangeInfo& info(Change change) { return kChangeInfos[int(change)]; }

std::optional<Reading> reading_of(const records::Comparison& comparison,
                                  const records::Named<double>& limits, const std::string& id,
                                  const MetricInfo& metric) {
  const double* value = records::find(comparison.metrics, id);
  if (!value) return std::nullopt;
  Reading reading{*value, {}, {}, kFloat32};
  if (comparison.error_bars)
    if (const auto* bar = records::find(*comparison.error_bars, id)) reading.bar = *bar;
  if (const double* limit = records::find(limits, id)) reading.limit = *limit;
  const double* peak = records::find(comparison.metrics, "peak");
  if (metric.unit == "count") reading.rounding = 0;
  if (metric.unit == "radiance") reading.rounding = peak ? kFloat32 * std::abs(*peak) : 0;
  return reading;
}

Change change_of(const Reading& was, const Reading& now, bool more_is_better) {
  if (was.value == now.value) return Change::kSame;  // infinities, too
  if (std::isnan(was.value) || std::isnan(now.value))
    return change_of_ranks(std::isnan(was.value), std::isnan(now.value));
  if (overlap(was, now)) return Change::kSame;
  const bool is_likeness = more_is_better && was.value <= 1 && now.value <= 1;
  const double before = badness(was.value, more_is_better, is_likeness),
               after = badness(now.value, more_is_better, is_likeness);
  double noise = std::max({kShareOfValue * std::abs(before), kShareOfValue * std::abs(after),
                           was.rounding, now.rounding});
  if (now.limit)
    noise =
        std::max(noise, kShareOfLimit * std::abs(badness(*now.limit, more_is_better, is_likeness)));
  // An infinite value is never within its own 1 %.
  const bool is_finite = std::isfinite(before) && std::isfinite(after);
  if (before == after || (is_finite && std::abs(after - before) <= noise)) return Change::kSame;
  return after > before ? Change::kWorse : Change::kBetter;
}

std::string main_metric(const records::Comparison& comparison) {
  const auto is_usable = [&](const std::string& id) {
    return records::find(comparison.metrics, id) &&
           (!comparison.error_bars || records::find(*comparison.error_bars, id));
  };
  if (is_usable(kLargestDifference)) return kLargestDifference;
  for (const records::Limit& limit : comparison.limits)
    if (is_usable(limit.metric)) return limit.metric;
  return "";
}

CellChange compare_cells(const CheckedCell& was, const CheckedCell& now, const ShownFarm& farm) {
  CellChange result;
  result.was = was.status;
  const bool is_same_hub = was.hub == now.hub;
  for (const CheckedComparison& comparison : now.comparisons) {
    const std::string& engine = now.other_of(comparison);
    result.engines.push_back(compare_engines(is_same_hub ? was.find_comparison(engine) : nullptr,
                                             comparison, engine, farm));
  }
  for (const CheckedComparison& comparison : was.comparisons) {
    const std::string& engine = was.other_of(comparison);
    if (!is_same_hub || now.find_comparison(engine)) continue;
    EngineChange gone;
    gone.engine = engine;
    gone.change = Change::kUnknown;
    gone.was = verdict_words(comparison);
    gone.now = "not compared";
    result.engines.push_back(std::move(gone));
  }
  // A cell that had not been rendered says nothing.
  if (was.status == CellStatus::kMissing) {
    result.change = now.status == CellStatus::kMissing ? Change::kSame : Change::kNew;
    return result;
  }
  const bool was_flawed = is_flaw(was.status), is_flawed = is_flaw(now.status);
  const auto engine_that_is = [&](Change change) {
    return std::ranges::find(result.engines, change, &EngineChange::change);
  };
  const auto take = [&](Change change) {
    const auto engine = engine_that_is(change);
    result.change = change;
    result.reason = engine == result.engines.end()
                        ? fmt::format("{} became {}", info(was.status).word, info(now.status).word)
                        : fmt::format("{}: {}", farm.engine_title(engine->engine), engine->reason);
  };
  const Change by_status = was_flawed ? Change::kSame
                           : is_flawed
                               ? Change::kWorse
                               : change_of_ranks(severity(was.status), severity(now.status));
  if (by_status == Change::kWorse || engine_that_is(Change::kWorse) != result.engines.end())
    take(Change::kWorse);
  else if (was_flawed)
    result.change = Change::kUnknown, result.reason = "what the earlier run wrote is damaged";
  else if (by_status == Change::kBetter || engine_that_is(Change::kBetter) != result.engines.end())
    take(Change::kBetter);
  return result;
}

}  // namespace lobelia::gallery
