#include <fmt/format.h>

#include <algorithm>

#include "verify/stability/report.hpp"

namespace lobelia::stability {
namespace {

constexpr char kColumns[] = "{:<46}{:>7}  {:>9}{:>9}{:>7}   {:>9}{:>9}{:>7}  {:>8}  {}\n";

std::string heading(const std::string& first) {
  return fmt::format("{:<46}{:>7}  {:<25}   {:<25}  {:>8}\n", "", "", "naive float32", "ours",
                     "used of") +
         fmt::format(kColumns, first, "cases", "of peak", "ulp", "pixels", "of peak", "ulp",
                     "pixels", "bound", "");
}

std::string number(double value) { return fmt::format("{:.2g}", value); }

std::string verdict(const Summary& s) {
  if (s.outside > 0) return fmt::format("{} OUTSIDE", s.outside);
  return s.not_compared > 0 ? fmt::format("{} not compared", s.not_compared) : "within";
}

std::string summary_lines(const std::vector<Summary>& summaries, const std::string& first) {
  std::string text = heading(first), group;
  for (const Summary& s : summaries) {
    if (s.group != group) text += s.group + "\n";
    group = s.group;
    text +=
        fmt::format(kColumns, "  " + s.name, s.cases, number(s.naive.of_peak), number(s.naive.ulp),
                    s.naive.wrong_pixels, number(s.ours.of_peak), number(s.ours.ulp),
                    s.ours.wrong_pixels, fmt::format("{:.2f}", s.of_bound), verdict(s));
  }
  return text;
}

std::string row_lines(const Rows& rows) {
  std::string text = fmt::format(
      "{:<12}{:<44}{:<24}{:<19}{:>7}{:>15}{:>15}{:>10}{:>10}{:>15}{:>10}{:>10}{:>10}{:>10}\n",
      "group", "case", "model", "lobe", "n", "truth", "naive", "of peak", "ulp", "ours", "of peak",
      "ulp", "bound", "ulp");
  for (const Row& r : rows)
    text += fmt::format(
        "{:<12}{:<44}{:<24}{:<19}{:>7g}{:>15.7g}{:>15.7g}{:>10}{:>10}{:>15.7g}{:>10}{:>10}{:>10}{:>10}{}\n",
        r.group, r.name, r.model, r.lobe, r.exponent, r.truth, r.naive.value,
        number(r.naive.of_peak), number(r.naive.ulp), r.ours.value, number(r.ours.of_peak),
        number(r.ours.ulp), number(r.bound_of_peak), number(r.bound_ulp),
        r.outcome == Outcome::kWithin ? "" : fmt::format("  {}", name(r.outcome)));
  return text;
}

/// One point of one highlight, by its exponent: digits that a reader can compare.
std::string digits(const Rows& rows) {
  std::string text =
      "\nThe flank of modified Phong's cos^n, in digits\n\n" +
      fmt::format("{:>9}  {:<14}{:<16}{:<14}\n", "n", "truth", "naive float32", "ours");
  for (const Row& r : rows)
    if (r.group == "vectors" && r.name == "flank, oblique" && r.model == "modified_phong" &&
        r.lobe == "cosine")
      text += fmt::format("{:>9g}  {:<14.8f}{:<16.8f}{:<14.8f}\n", r.exponent, r.truth,
                          r.naive.value, r.ours.value);
  return text;
}

std::string timings(const Report& report) {
  std::string text =
      "\nResults that would be denormal, beside ordinary ones: ns a point at n = 1024\n\n" +
      fmt::format("  {:<20}{:<10}{:>10}{:>11}{:>8}\n", "lobe", "precision", "ordinary", "underflow",
                  "ratio");
  for (const Stall& s : report.stalls)
    text += fmt::format("  {:<20}{:<10}{:>10.2f}{:>11.2f}{:>8.2f}\n", s.lobe, s.precision,
                        s.ordinary.median_ns, s.underflow.median_ns,
                        s.underflow.median_ns / s.ordinary.median_ns);
  text += "\nThe price of precision: ns a point, median (and spread between the quartiles)\n\n" +
          fmt::format("  {:<20}{:<24}{:>16}{:>16}{:>16}\n", "lobe", "model", "float32", "mixed",
                      "float64");
  for (const Price& p : report.prices) {
    text += fmt::format("  {:<20}{:<24}", p.lobe, p.model);
    for (const Timing& t : p.by_precision)
      text += fmt::format("{:>8.2f} ({:.2f}) ", t.median_ns, t.spread_ns);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string report_text(const Report& report, bool all) {
  std::string text = all ? row_lines(report.rows)
                         : summary_lines(by_lobe(report.rows), "worst of each lobe") + "\n" +
                               summary_lines(by_case(report.rows), "worst of each case") +
                               digits(report.rows);
  if (!report.stalls.empty()) text += timings(report);
  for (const PicturePair& p : report.pictures)
    text +=
        fmt::format("\nclose to a highlight of n = {:g}: naive off by {} of the peak, ours by {}",
                    p.exponent, number(p.naive_error), number(p.ours_error));
  if (!report.pictures.empty()) text += "\n";
  return text + fmt::format("\n{} cases: {} within their bounds, {} outside, {} not compared\n",
                            report.rows.size(), report.count(Outcome::kWithin),
                            report.count(Outcome::kOutside), report.count(Outcome::kNotCompared));
}

}  // namespace lobelia::stability
