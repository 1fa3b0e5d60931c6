// Why a comparison came out as it did, in sentences from its record.
#include <fmt/format.h>

#include "base/words/numbers.hpp"
#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

/// Half a unit in the last place of a half float, as a share of the value.
constexpr double kHalfRounding = 0x1p-11;

/// "0.041 % of the peak at (156, 99)"
std::string worst_text(const CheckedComparison& comparison, double worst) {
  std::string text = percent_text(worst) + " of the peak";
  const auto x = comparison.metric("max_abs.x"), y = comparison.metric("max_abs.y");
  return x && y ? text + fmt::format(" at ({:.0f}, {:.0f})", *x, *y) : text;
}

/// How far a pixel may be off, and why.
std::string allowance_text(const records::Tolerance& tolerance, const std::string& engine) {
  const bool is_half =
      tolerance.relative >= kHalfRounding && tolerance.relative < 1.01 * kHalfRounding;
  std::string allowed;
  if (is_half)
    allowed = fmt::format("{} writes half floats, whose rounding is {} of the value", engine,
                          percent_text(kHalfRounding));
  else if (tolerance.relative > 0)
    allowed = percent_text(tolerance.relative) + " of the value is allowed";
  if (tolerance.of_peak > 0)
    allowed += fmt::format("{}{} of the peak is allowed for arithmetic",
                           allowed.empty() ? "" : "; ", percent_text(tolerance.of_peak));
  return allowed.empty() ? "no difference is allowed" : allowed;
}

/// The pixels beyond the tolerance: rounding decides what a ray at an edge hits.
std::string outliers_text(const CheckedComparison& comparison) {
  const double all = comparison.metric("outliers").value_or(0);
  const double inside = comparison.metric("outliers.off_edge").value_or(all);
  if (all == 0) return "";
  const std::string pixels = count_text(all) + (all == 1 ? " pixel is" : " pixels are");
  if (inside == 0)
    return fmt::format(
        " {} beyond that, on edges alone, where rounding decides what a ray hits; {} may be.",
        pixels, count_text(double(comparison.record.tolerance->allowed_outliers)));
  return fmt::format(" {} beyond that, {} of them not on an edge. The record does not say why.",
                     pixels, count_text(inside));
}

}  // namespace

std::string story_of(const CheckedComparison& comparison, const std::string& engine) {
  if (comparison.doubt || !comparison.problem.empty()) return "";
  const records::Nonfinite& bad = comparison.record.nonfinite;
  if (bad.a + bad.b > 0)
    return fmt::format("{} values are NaN or infinite. Nothing else was judged.",
                       count_text(double(bad.a + bad.b)));
  const auto worst = comparison.metric("max_rel_peak");
  if (!worst) return "";
  if (*worst == 0) return "Both pictures are the same in every value.";
  std::string story = "Largest difference " + worst_text(comparison, *worst);
  const bool is_noisy = comparison.record.error_bars.has_value();
  if (comparison.record.tolerance)
    story += ": " + allowance_text(*comparison.record.tolerance, engine) + "." +
             outliers_text(comparison);
  else
    story += ".";
  if (!is_noisy) return story;
  if (comparison.verdict == "same") return story + " The noise of the pictures explains it.";
  if (comparison.verdict == "undecided")
    return story + " The noise of the pictures could hide a difference; more samples would tell.";
  return comparison.verdict == "different" ? story + " It is more than the noise of the pictures."
                                           : story;
}

}  // namespace lobelia::gallery
