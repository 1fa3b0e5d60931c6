#include "studies/cost/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "base/words/error_time_chart.hpp"
#include "renderer/catalogue_record.hpp"
#include "studies/cost/half_floats.hpp"
#include "studies/cost/lobe_errors.hpp"

namespace lobelia::cost {
namespace {

constexpr std::size_t kPoints = 1024;     // in the first-level cache
constexpr double kSecondsAtATime = 5e-5;  // a thousand times the clock's resolution
constexpr std::size_t kMostRepeats = 4096;

/// Numbers evaluated to find the largest error of a variant; float32 has some 2^28.
constexpr std::uint64_t kMostNumbersQuick = 1 << 20, kMostNumbers64 = 1 << 22,
                        kAllNumbers = ~std::uint64_t(0);

/// Points across the highlight, and a variant's values there.
struct Points {
  alignas(64) double s[kPoints], value[kPoints];
  alignas(64) float s32[kPoints], value32[kPoints];
  explicit Points(double exponent) {
    // Where the lobes are neither 1 nor 0; in an order that no branch predictor learns.
    for (std::size_t i = 0; i < kPoints; ++i)
      s[i] = s32[i] = float(highlight_end(exponent) / 2 * double(i * 389 % kPoints) / kPoints);
  }
};

std::string exponent_text(double exponent) { return fmt::format("{:.15g}", exponent); }

/// Keeps the compiler from removing the writes.
void keep(const void* written) { asm volatile("" ::"r"(written) : "memory"); }

struct LobeCase {
  std::shared_ptr<Points> points;
  std::function<void()> work;
  std::size_t repeats;
};

/// Repeats `once` until the clock's resolution does not matter.
LobeCase repeated(std::shared_ptr<Points> points, std::function<void()> once) {
  once();
  const double seconds = std::max(seconds_of(once), 1e-8);
  const auto repeats =
      std::clamp<std::size_t>(std::size_t(kSecondsAtATime / seconds), 1, kMostRepeats);
  return {std::move(points),
          [once = std::move(once), repeats] {
            for (std::size_t i = 0; i < repeats; ++i) once();
          },
          repeats};
}

LobeCase case_of(const LobeVariant& variant, double exponent) {
  const auto p = std::make_shared<Points>(exponent);
  if (variant.wide)
    return repeated(p, [&variant, p] {
      variant.over64(kPoints, p->s, p->value);
      keep(p->value);
    });
  return repeated(p, [&variant, p] {
    variant.over32(kPoints, p->s32, p->value32);
    keep(p->value32);
  });
}

/// Reading and writing as many numbers: no variant can be faster.
LobeCase copying(double exponent) {
  const auto p = std::make_shared<Points>(exponent);
  return repeated(p, [p] {
    std::memcpy(p->value32, p->s32, sizeof(p->s32));
    keep(p->value32);
  });
}

/// Throws Error(kInternal) unless the timed values are the lobe's.
void check(const LobeVariant& variant, double exponent, const Points& points) {
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double value = variant.wide ? points.value[i] : double(points.value32[i]);
    const double truth = lobe_value(variant.lobe, points.s[i], exponent);
    if (!(std::abs(value - truth) <= variant.allowed + 1e-13))
      throw Error(ExitCode::kInternal, "{}, timed at n = {}, is {} at s = {} in place of {}",
                  variant.name(), exponent_text(exponent), value, points.s[i], truth);
  }
}

Variant measured_lobe(const LobeVariant& variant, const LobeVariantErrors& errors,
                      const LargestError& largest, const Times& times) {
  Variant made;
  made.name = variant.name();
  made.settings = {{"lobe", std::string(info(variant.lobe).name)},
                   {"method", variant.method},
                   {"precision", variant.wide ? "float64" : "float32"},
                   {"lanes", variant.simd ? "SIMD" : "scalar"}};
  made.seconds = records::rounds_record(times);
  made.errors = {{"max", largest.found}, {"rms", errors.all.rms}, {"energy", errors.all.energy}};
  records::CostFacts& facts = made.facts.emplace();
  facts.operations = operations_record(variant.operations);
  facts.shape = errors.shape;
  facts.rounding = errors.rounding;
  facts.rounding->max_at_most = variant.allowed;
  if (largest.at_most > largest.found) made.errors_at_most.emplace() = {{"max", largest.at_most}};
  return made;
}

/// Whether shape or rounding dominates the variants' largest errors.
std::vector<std::string> limit_remarks(const std::vector<LobeVariant>& variants,
                                       const std::vector<LobeVariantErrors>& errors) {
  std::size_t by_shape = 0;
  double most = 0, least_rounding = kInfinity, most_rounding = 0;
  std::string shaped_by, rounded_by, least_by;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const double shape = errors[i].shape.max, rounding = errors[i].rounding.max;
    if (shape > rounding) {
      ++by_shape;
      if (rounding / shape >= most) most = rounding / shape, shaped_by = variants[i].name();
      continue;
    }
    if (rounding < least_rounding) least_rounding = rounding, least_by = variants[i].name();
    if (rounding > most_rounding) most_rounding = rounding, rounded_by = variants[i].name();
  }
  std::vector<std::string> remarks{fmt::format(
      "The shape limits {} of {} variants: the most rounding seen is {:.2g} of it ({}).", by_shape,
      variants.size(), most, shaped_by)};
  if (by_shape < variants.size())
    remarks.push_back(fmt::format(
        "Of the other {} the rounding is the larger error: seen from {:.2g} ({}) to {:.2g} ({}).",
        variants.size() - by_shape, least_rounding, least_by, most_rounding, rounded_by));
  return remarks;
}

std::string bracket_remark(const Table& table) {
  const auto brackets = std::ranges::count_if(
      table.variants, [](const Variant& variant) { return variant.errors_at_most.has_value(); });
  if (brackets == 0) return "";
  return fmt::format(
      "The max of {} variants is of all float32 numbers s, that of {} a bracket: the largest found, and a bound that no "
      "number exceeds.",
      std::ssize(table.variants) - brackets, brackets);
}

std::string time_remark(const Table& table, double copy) {
  double fastest = kInfinity;
  for (const Variant& variant : table.variants)
    fastest = std::min(fastest, variant.seconds->median);
  return fmt::format(
      "Reading s and writing a value takes {} in float32; the fastest variant takes {:.1f} times that.",
      short_time_text(copy), fastest / copy);
}

}  // namespace

Table lobe_table(double exponent, int rounds, bool quick) {
  const std::vector<LobeVariant> variants = lobe_variants(exponent);
  std::vector<LobeCase> cases;
  for (const LobeVariant& variant : variants) cases.push_back(case_of(variant, exponent));
  cases.push_back(copying(exponent));
  std::vector<std::function<void()>> works;
  for (const LobeCase& timed : cases) works.push_back(timed.work);
  const std::vector<Times> times = interleaved(works, rounds);
  const auto each = [&](std::size_t i) {
    return per(times[i], double(kPoints * cases[i].repeats));
  };

  Table table;
  table.id = "lobe-n" + exponent_text(exponent);
  table.level = "lobe";
  table.title = fmt::format("A lobe, n = {}", exponent_text(exponent));
  table.per = "evaluation";
  table.errors = lobe_error_kinds();
  const LobeTruth truth(exponent);
  std::vector<LobeVariantErrors> errors;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    check(variants[i], exponent, *cases[i].points);
    errors.push_back(truth.errors(variants[i]));
    const std::uint64_t most = variants[i].of_cosine ? kAllNumbers
                               : quick               ? kMostNumbersQuick
                               : variants[i].wide    ? kMostNumbers64
                                                     : kAllNumbers;
    table.variants.push_back(
        measured_lobe(variants[i], errors[i],
                      largest_error(variants[i], exponent, errors[i].all.max, most), each(i)));
  }
  table.remarks = limit_remarks(variants, errors);
  if (const std::string brackets = bracket_remark(table); !brackets.empty())
    table.remarks.push_back(brackets);
  table.remarks.push_back(time_remark(table, each(variants.size()).median));
  return table;
}

std::vector<Times> value_times(const std::vector<TimedLobe>& lobes) {
  constexpr int kRounds = 31;
  std::vector<LobeCase> cases;
  std::vector<std::function<void()>> works;
  for (const TimedLobe& timed : lobes) {
    const auto p = std::make_shared<Points>(timed.exponent);
    cases.push_back(repeated(p, [timed, p] {
      if (timed.wide)
        lobe_lanes(timed.lobe, timed.exponent, kPoints, p->s, p->value);
      else
        lobe_lanes(timed.lobe, timed.exponent, kPoints, p->s32, p->value32);
      keep(p->value);
    }));
    works.push_back(cases.back().work);
  }
  std::vector<Times> times = interleaved(works, kRounds);
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = per(times[i], double(kPoints * cases[i].repeats));
  return times;
}

std::vector<Table> measure_lobes(const Options& options) {
  const std::vector<double> exponents =
      options.effort == Effort::kQuick ? std::vector<double>{64, 100.5}
                                       : std::vector<double>{16, 64, 100.5, 256, 1024, 65536, 1e6};
  std::vector<Table> tables;
  for (const double exponent : exponents) {
    options.progress(fmt::format("n = {}", exponent_text(exponent)));
    tables.push_back(
        lobe_table(exponent, options.rounds(11, 41, 201), options.effort == Effort::kQuick));
  }
  options.progress("half floats");
  for (Table& table : half_float_tables()) tables.push_back(std::move(table));
  return tables;
}

}  // namespace lobelia::cost
