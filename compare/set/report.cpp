#include "compare/set/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "compare/faults.hpp"
#include "compare/highlights/words.hpp"
#include "compare/metrics/catalogue.hpp"

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

using OutcomeCounts = std::array<std::size_t, records::kOutcomes>;

OutcomeCounts count_outcomes(const SetReport& report) {
  OutcomeCounts counts{};
  for (const NameOutcome& one : outcomes(report)) ++counts[std::size_t(one.outcome)];
  return counts;
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

Outcome outcome_of(const PairReport& pair) {
  if (!pair.comparison) return Outcome::kError;
  if (pair.is_excused()) return Outcome::kKnown;
  switch (pair.verdict()) {
    case Verdict::kPass:
    case Verdict::kSame:
      return Outcome::kPass;
    case Verdict::kUndecided:
      return Outcome::kUndecided;
    case Verdict::kNonFinite:
      return Outcome::kNonFinite;
    default:
      return Outcome::kDiffers;
  }
}

std::string_view NameOutcome::word() const {
  return pair && pair->comparison && outcome != Outcome::kKnown ? verdict_name(pair->verdict())
                                                                : info(outcome).name;
}

std::string NameOutcome::why() const {
  if (!pair) {  // the sentence as a reason: "there is no reference"
    std::string reason(info(outcome).meaning);
    reason.front() = char(std::tolower(reason.front()));
    reason.pop_back();
    return reason;
  }
  return pair->comparison ? why_not_pass(*pair) : pair->error;
}

std::vector<NameOutcome> outcomes(const SetReport& report) {
  std::vector<NameOutcome> list;
  for (const PairReport& pair : report.pairs) list.push_back({outcome_of(pair), pair.name, &pair});
  for (const auto& [outcome, names] : {std::pair(Outcome::kMissing, &report.missing),
                                       {Outcome::kExtra, &report.extra},
                                       {Outcome::kNotFollowed, &report.not_followed},
                                       {Outcome::kMisnamed, &report.misnamed}})
    for (const std::string& name : *names) list.push_back({outcome, name});
  return list;
}

std::vector<Problem> problems(const SetReport& report) {
  using Weight = Problem::Weight;
  std::vector<Problem> list;
  const auto add = [&](Weight weight, std::string_view what, const std::string& name,
                       std::string why, const PairReport* pair = nullptr) {
    list.push_back({weight, what, name, std::move(why), pair});
  };
  const std::vector<NameOutcome> all = outcomes(report);
  for (const Outcome outcome :
       {Outcome::kError, Outcome::kMissing, Outcome::kNotFollowed, Outcome::kMisnamed})
    for (const NameOutcome& one : all)
      if (one.outcome == outcome) add(Weight::kFails, one.word(), one.name, one.why());
  std::vector<const PairReport*> worst_first;
  for (const PairReport& pair : report.pairs)
    if (pair.comparison) worst_first.push_back(&pair);
  std::ranges::stable_sort(worst_first, [](const PairReport* p, const PairReport* q) {
    return excess(*p) > excess(*q);
  });
  for (const PairReport* pair : worst_first) {
    const auto weight = weight_of(*pair);
    if (!weight) continue;
    const NameOutcome one{outcome_of(*pair), pair->name, pair};
    std::string why = one.why();
    if (const std::string known = known_text(*pair); !known.empty())
      why = fmt::format("{} ({})", why, known);
    add(*weight, one.word(), pair->name, std::move(why), pair);
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
  for (const NameOutcome& one : all)
    if (one.outcome == Outcome::kExtra)
      add(report.missing_reference_fails ? Weight::kFails : Weight::kNotice, one.word(), one.name,
          one.why());
  return list;
}

std::vector<CountedOutcome> counted_outcomes(const SetReport& report) {
  const OutcomeCounts counts = count_outcomes(report);
  const std::size_t pairs = report.pairs.size();
  std::vector<CountedOutcome> list{{std::nullopt, pairs, pairs == 1 ? "pair" : "pairs"}};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const records::OutcomeInfo& one = records::kOutcomeInfos[i];
    if (counts[i] > 0 || one.is_usual) list.push_back({Outcome(i), counts[i], one.counted});
  }
  return list;
}

records::SetSummary count(const SetReport& report) {
  const OutcomeCounts counts = count_outcomes(report);
  const auto of = [&](Outcome outcome) { return counts[std::size_t(outcome)]; };
  records::SetSummary summary;
  summary.pairs = report.pairs.size();
  summary.pass = of(Outcome::kPass);
  summary.differs = of(Outcome::kDiffers);
  summary.undecided = of(Outcome::kUndecided);
  summary.non_finite = of(Outcome::kNonFinite);
  summary.errors = of(Outcome::kError);
  summary.missing = of(Outcome::kMissing);
  summary.extra = of(Outcome::kExtra);
  summary.passed_over = report.passed_over;
  summary.links_not_followed = of(Outcome::kNotFollowed);
  const auto is_known = [](const PairReport& pair) { return pair.known.has_value(); };
  if (std::ranges::any_of(report.pairs, is_known)) summary.known = of(Outcome::kKnown);
  if (of(Outcome::kMisnamed) > 0) summary.misnamed = of(Outcome::kMisnamed);
  return summary;
}

std::string counts_text(const SetReport& report) {
  std::string text;
  std::string_view before;
  bool of_pairs = true;
  for (const auto& [outcome, number, words] : counted_outcomes(report)) {
    if (outcome && of_pairs && !info(*outcome).is_pair) {
      of_pairs = false;
      before = "; ";
    }
    text += fmt::format("{}{} {}", before, number, words);
    before = outcome ? ", " : ": ";
  }
  return text;
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
                               counts.links_not_followed + counts.misnamed.value_or(0) +
                               (report.missing_reference_fails ? counts.extra : 0);
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
  // An explanation of the whole difference says more than figures of the highlight.
  std::vector<std::string> faults;
  for (const records::Fault& fault : comparison.faults) faults.push_back(fault_text(fault, a, b));
  if (!faults.empty()) return fmt::format("{}", fmt::join(faults, "; "));
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
  // These figures are of all pixels over 5 % of the peak. Beside a sentence on one of several highlights, "the highlight"
  // would be taken for that one.
  const bool are_several =
      comparison.highlights.size() > 1 && !sentences_on_highlights(comparison.highlights).empty();
  const std::string_view subject = are_several ? "brightest pixels together are" : "highlight is";
  std::string text = parts.empty()
                         ? fmt::format("{}'s {} as wide and as bright as {}'s", a, subject, b)
                         : fmt::format("{}'s {} {}", a, subject, fmt::join(parts, " and "));
  text += fmt::format(", {} energy {}", are_several ? "their" : "its",
                      more_energy.empty() ? "equal" : more_energy);
  if (!ways.empty())
    text += fmt::format("; {} {}", are_several ? "they lie" : "it lies", fmt::join(ways, " and "));
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
  if (const auto sentences = sentences_on_highlights(comparison.highlights);
      !text.empty() && !sentences.empty())
    text += "; " + sentences.front();
  if (!text.empty() && !comparison.finding.empty()) text += "; " + comparison.finding;
  return text;
}

std::string why_layers_differ(const PairReport& pair) {
  std::string text;
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

std::string why_not_pass(const PairReport& pair) {
  std::string text = why_not_pass(*pair.comparison, pair.a, pair.b);
  const std::string layers = why_layers_differ(pair);
  return text.empty() || layers.empty() ? text + layers : text + "; " + layers;
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
