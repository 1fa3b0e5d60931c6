// The measurement behind the table of agreement: every variant of a picture against the analytic one, in every case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/agreement.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/replicates.hpp"
#include "studies/agreement/cases.hpp"
#include "studies/table.hpp"

namespace lobelia::agreement {

struct Variant : EngineVariant {
  std::string_view engine;  ///< empty for ours and for a pair of engines
  Variant(std::string_view by, const EngineVariant& variant) : EngineVariant(variant), engine(by) {}
};

const Variant& ours();
/// The engines' variants. An engine's own formats are tried in the order given.
std::span<const Variant> variants();
/// Two engines with the same reimplemented formula, compared with each other.
Variant pair_of(std::string_view first, std::string_view second);

/// The limit for a picture's largest difference: the variant's floor.
struct Target {
  bool relative = false;  ///< a share of each value, not of the peak
  double limit = 0;
};
/// None for a pair of engines.
std::optional<Target> target_of(const Variant& variant, const Case& one);
/// "4.9e-4", "0", "inf"
std::string short_number(double value);
/// "4.9e-4 of the value"
std::string target_text(const Target& target);

/// The difference of two pictures over all channels. Values that are not finite are infinitely far off.
struct Figures {
  // Pixels outside the ring:
  double max_of_peak = 0;   ///< of the peak of the reference
  double rms_of_peak = 0;   ///< over pixels where either picture is not black
  double max_relative = 0;  ///< of the reference's value, where above kRelativeFrom of the peak
  // Pixels in the ring:
  double ring_max_of_peak = 0;
  int ring_pixels = 0, ring_over = 0;  ///< all; those that are off by more than kRingOfPeak
};
inline constexpr double kRelativeFrom = 1e-3;

using Picture = std::vector<Rgb>;  ///< in reading order

/// The sizes are the same; `ring` is that of truth::edge_ring().
Figures difference_from(const Picture& reference, const Image& image,
                        std::span<const std::uint8_t> ring);

enum class Verdict { kMet, kMissed, kNoTarget, kNotComparable, kFailed };
inline constexpr std::string_view kVerdictNames[] = {"met", "missed", "no target", "not comparable",
                                                     "failed"};

struct Row {
  std::size_t index = 0;  ///< of the case
  Variant variant;
  Figures figures;  ///< if there is a picture
  Verdict verdict = Verdict::kNoTarget;
  std::string why;  ///< not comparable, or failed
};

/// An engine's average at two numbers of points against our own converged samples.
struct SoftRow {
  std::string what;
  Variant variant;
  std::vector<records::SoftCount> counts;  ///< of the pictures that there are
  Verdict verdict = Verdict::kNoTarget;
  std::string why;
};
/// Values that may be beyond their limit: neighbours share their points, so a few fall out together.
inline constexpr std::size_t kBeyondAllowed = 3;

struct Agreement {
  Scope scope;
  std::vector<records::AgreementEngine> engines;
  std::vector<Case> cases;
  std::vector<Row> rows;
  std::vector<SoftRow> soft;
  std::size_t count(Verdict verdict) const;
};

/// Gets the fraction done and the current work, from any thread.
using OnProgress = std::function<void(double, std::string_view)>;

/// By the available engines; the others are named in the result. Throws Error(kInterrupted) on Ctrl-C.
Agreement measure(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines,
                  const OnProgress& on_progress);

// The table as text, CSV, Markdown and a record.

using Table =
    studies::Table;  ///< with one remark, which the page prints above it and the text leaves out
/// The worst of each variant by the sharpness of the highlight, with its target.
Table headline_table(const Agreement& agreement);
/// The worst over lights, by variant, lobe and exponent; and by variant, model and exponent.
Table lobe_table(const Agreement& agreement);
Table model_table(const Agreement& agreement);
Table effect_table(const Agreement& agreement);
Table soft_table(const Agreement& agreement);
/// Pictures that cannot be compared, and why.
Table refusal_table(const Agreement& agreement);
/// Every picture that missed its target or failed.
Table miss_table(const Agreement& agreement);

/// "412 pictures compared, all within their targets, 31 not comparable"
std::string verdict_sentence(const Agreement& agreement);

std::string report_text(const Agreement& agreement);
/// docs/agreement.md, as made by `command`.
std::string report_markdown(const Agreement& agreement, std::string_view command);
/// Headings of the page, in their order.
std::vector<std::string> markdown_headings();
records::Agreement report_record(const Agreement& agreement,
                                 const std::vector<std::string>& command);
/// One line a comparison.
std::string report_csv(const Agreement& agreement);

}  // namespace lobelia::agreement
