// The page on the hard cases: the textbook's float32 formulas beside ours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/records/stability.hpp"
#include "base/words/numbers.hpp"
#include "base/words/svg_chart.hpp"
#include "base/words/text.hpp"
#include "gallery/cells/picture.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/page_text.hpp"
#include "gallery/pages/views.hpp"

namespace lobelia::gallery::stability_page {
namespace {

using records::VerifyStability, records::StabilityErrors, records::StabilityCurve;

constexpr char kRecord[] = "stability/stability.json", kDirectory[] = "stability";
constexpr char kTitle[] = "The hard cases";
constexpr double kMinError = 1e-18, kMaxError = 10;  // in charts; a NaN is drawn at the top
constexpr char kShownGroup[] = "lobe";
constexpr double kShownExponent = 1e6;

std::string error_text(double error) {
  return std::isfinite(error) ? number_text(error, 2) : "no number";
}

double drawn(double error) { return std::isfinite(error) ? std::min(error, kMaxError) : kMaxError; }

std::string power_text(double exponent) {
  return exponent >= 1e4 ? power_of_ten_text(int(std::lround(std::log10(exponent))))
                         : number_text(exponent, 4);
}

/// The largest error of all lobes over the exponent. Without series if there are fewer than two exponents.
Chart exponent_chart(const VerifyStability& data) {
  Chart chart{
      .id = "over-exponent",
      .title = "Error over exponent",
      .description = "The largest error of all lobes, textbook and ours, over the exponent.",
      .width = 760,
      .height = 400,
      .y = {"largest error, of the peak", kMinError, kMaxError, true}};
  std::map<double, std::pair<double, double>> worst;
  for (const records::StabilityOfLobe& s : data.by_exponent) {
    if (s.group != kShownGroup || !(s.exponent > 0.0)) continue;
    auto& [naive, ours] = worst[*s.exponent];
    naive = std::max(naive, drawn(s.naive.of_peak));
    ours = std::max(ours, drawn(s.ours.of_peak));
  }
  if (worst.size() < 2) return chart;
  chart.x = {"exponent n", worst.begin()->first, worst.rbegin()->first, true};
  chart.series = {{"naive float32", {}, {}, 2}, {"ours", {}, {}, 1}};
  for (const auto& [n, errors] : worst) {
    chart.series[0].x.push_back(n), chart.series[0].y.push_back(errors.first);
    chart.series[1].x.push_back(n), chart.series[1].y.push_back(errors.second);
  }
  return chart;
}

const StabilityCurve* shown_curve(const VerifyStability& data) {
  const auto at = std::ranges::find(data.curves, kShownExponent, &StabilityCurve::exponent);
  if (at != data.curves.end()) return &*at;
  return data.curves.empty() ? nullptr : &data.curves.back();
}

/// The highlight over the angle, from the textbook's formula, from ours and exactly.
Chart angle_chart(const StabilityCurve& curve) {
  double most = 1;
  for (const double value : curve.naive)
    if (std::isfinite(value)) most = std::clamp(value, most, 2.0);
  const bool has_angles = !curve.degrees.empty() && curve.degrees.back() > 0;
  return {
      .id = "over-angle",
      .title = "A highlight's flank",
      .description = "The highlight over the angle: the truth, the textbook's float32 and ours.",
      .width = 760,
      .height = 400,
      .x = {"angle between light and mirror direction (degrees)", 0,
            has_angles ? curve.degrees.back() : 1, false},
      .y = {"value, of the peak", 0, most * 1.05, false},
      .series = {{"truth", curve.degrees, curve.truth, 0},
                 {"naive float32", curve.degrees, curve.naive, 2},
                 {"ours", curve.degrees, curve.ours, 1}}};
}

/// From which exponent on the textbook gives no number, and how large our error is at most.
std::string finding_of(const VerifyStability& data) {
  double first = 0, ours = 0, naive = 0;
  for (const records::StabilityOfLobe& s : data.by_exponent) {
    if (s.group != kShownGroup || !(s.exponent > 0.0)) continue;
    ours = std::max(ours, s.ours.of_peak);
    if (std::isfinite(s.naive.of_peak))
      naive = std::max(naive, s.naive.of_peak);
    else if (first == 0 || *s.exponent < first)
      first = *s.exponent;
  }
  const std::string textbook =
      first > 0 ? fmt::format("The textbook’s formulas give no number for some lobe from n = {} on",
                              power_text(first))
                : fmt::format("The textbook’s formulas are off by up to {} of the peak",
                              error_text(naive));
  return fmt::format("{}; ours are off by {} of the peak at most.", textbook, error_text(ours));
}

/// The largest difference from the truth, of the textbook and of ours.
std::string curve_finding(const StabilityCurve& curve) {
  double naive = 0, ours = 0;
  bool is_number = true;
  for (std::size_t i = 0; i < curve.truth.size(); ++i) {
    if (i < curve.naive.size()) {
      is_number = is_number && std::isfinite(curve.naive[i]);
      if (is_number) naive = std::max(naive, std::abs(curve.naive[i] - curve.truth[i]));
    }
    if (i < curve.ours.size()) ours = std::max(ours, std::abs(curve.ours[i] - curve.truth[i]));
  }
  const std::string textbook =
      is_number ? fmt::format("is off by up to {} of the peak", error_text(naive))
                : "is no number in places";
  return fmt::format("At n = {} the textbook’s curve {}; ours is off by {} at most.",
                     power_text(curve.exponent), textbook, error_text(ours));
}

void write_chart(Html& html, const char* title, const std::string& finding, const Chart& chart,
                 const std::string& words) {
  const Tag section(html, "section", {{"class", "charts"}});
  html.element("h2", title);
  html.element("p", {{"class", "finding"}}, finding);
  const Tag grid(html, "div", {{"class", "figure-grid"}});
  const Tag figure(html, "figure", {{"class", "chart-figure"}, {"id", chart.id + "-figure"}});
  html.element("h3", chart.title);
  html.raw(draw_chart(chart));
  html.element("figcaption", words);
}

void write_charts(Html& html, const VerifyStability& data) {
  const Chart over_exponent = exponent_chart(data);
  if (!over_exponent.series.empty())
    write_chart(html, "How the error grows", finding_of(data), over_exponent,
                "The worst of all lobes, against a reference of 50 digits. A line at the "
                "top edge means that the textbook gave no number.");
  if (const StabilityCurve* curve = shown_curve(data))
    write_chart(html, "What it does to one highlight", curve_finding(*curve), angle_chart(*curve),
                fmt::format("A modified Phong highlight of n = {}.", power_text(curve->exponent)));
}

void write_picture(Html& html, ViewPage& page, const std::filesystem::path& run,
                   const std::string& file, const std::string& words) {
  const Tag figure(html, "figure");
  html.element("figcaption", words);
  const Picture picture = inspect_picture(run / kDirectory, file);
  if (!picture.shown())
    return write_absence(html, picture.file.empty() ? "not recorded" : picture.why_not);
  page.files.push_back(std::string(kDirectory) + "/" + file);
  html.empty("img", {{"src", link_to({kDirectory, file})},
                     {"alt", words},
                     {"width", std::to_string(picture.width)},
                     {"height", std::to_string(picture.height)},
                     {"loading", "lazy"}});
}

/// The pictures lie beside the record, whatever path it has for them.
std::string name_of(const std::string& file) {
  const std::string name = std::filesystem::path(file).filename().string();
  if (!name.empty() && !is_plain_name(name))
    throw Error(ExitCode::kInput, "{}: '{}' is no plain name of a file", kRecord, printable(name));
  return name;
}

void write_pictures(ViewPage& page, const std::filesystem::path& run, const VerifyStability& data) {
  if (data.pictures.empty()) return;
  Html& html = page.main;
  const Tag section(html, "section");
  html.element("h2", "Close to a highlight");
  html.element(
      "p",
      "A modified Phong highlight that fills the picture. Errors relative to the peak: black 10⁻⁸ "
      "and below, blue 10⁻⁶, red 10⁻⁴, yellow 10⁻², white 1; magenta is no number.");
  for (const auto& [exponent, naive, ours] : data.pictures) {
    html.element("h3", "n = " + power_text(exponent));
    const Tag row(html, "div", {{"class", "picture-four"}});
    write_picture(html, page, run, name_of(naive.png), "naive float32");
    write_picture(html, page, run, name_of(ours.png), "ours");
    write_picture(html, page, run, name_of(naive.error),
                  "error of naive: at most " + error_text(naive.largest_error_of_peak));
    write_picture(html, page, run, name_of(ours.error),
                  "error of ours: at most " + error_text(ours.largest_error_of_peak));
  }
}

void write_error(Html& html, const StabilityErrors& error) {
  html.element("td", {{"class", std::isfinite(error.of_peak) ? "number" : "number over"}},
               error_text(error.of_peak));
  html.element("td", {{"class", "number"}}, error_text(error.ulp));
  html.element("td", {{"class", error.wrong_pixels > 0 ? "number over" : "number"}},
               count_text(error.wrong_pixels));
}

void write_case(Html& html, const records::StabilityOfCase& one) {
  const Tag row(html, "tr");
  {
    const Tag head(html, "th", {{"scope", "row"}});
    write_math(html, one.name);
    if (!one.meaning.empty()) math_element(html, "small", one.meaning);
  }
  html.element("td", {{"class", "number"}}, count_text(double(one.cases)));
  write_error(html, one.naive);
  write_error(html, one.ours);
  html.element("td", {{"class", "number"}},
               std::isfinite(one.of_bound)
                   ? fmt::format("{:.0f} %", 100 * std::min(one.of_bound, 1e6))
                   : "–");
  const Tag verdict(html, "td");
  write_status(html, info(one.outside > 0 ? CellStatus::kDiffers : CellStatus::kPass));
}

void write_group(Html& html, const VerifyStability& data, const std::string& group,
                 const std::string& meaning) {
  Attributes attributes{{"class", "case-group"}, {"id", "group-" + group}};
  if (group == kShownGroup) attributes.push_back({"open", "open"});
  const Tag details(html, "details", attributes);
  math_element(html, "summary", meaning.empty() ? group : group + ": " + meaning);
  const Tag scroll(html, "div", scroll_box("Cases: " + group));
  const Tag table(html, "table", {{"class", "figures cases"}});
  {
    const Tag head(html, "thead");
    {
      const Tag row(html, "tr");
      html.element("td", {{"colspan", "2"}}, "");
      html.element("th", {{"scope", "colgroup"}, {"colspan", "3"}}, "naive float32");
      html.element("th", {{"scope", "colgroup"}, {"colspan", "3"}}, "ours");
      html.element("td", {{"colspan", "2"}}, "");
    }
    const Tag row(html, "tr");
    for (const char* column : {"case", "tried", "of peak", "ulp", "wrong pixels", "of peak", "ulp",
                               "wrong pixels", "of its bound", "verdict"})
      html.element("th", {{"scope", "col"}}, column);
  }
  const Tag body(html, "tbody");
  for (const records::StabilityOfCase& one : data.by_case)
    if (one.group == group) write_case(html, one);
}

void write(ViewPage& page, const VerifyStability& data, const RunFiles& run) {
  Html& html = page.main;
  write_lead(
      html, kTitle,
      "Where float32 and geometry go wrong, the textbook's formulas (naive, without care) stand beside "
      "what Lobelia does, each held to a reference in 50 digits that shares no code with either.");
  {
    const Tag list(html, "ul", {{"class", "counts"}});
    for (const auto& [count, words] : {std::pair{data.cases, " cases"},
                                       {data.outside, " outside their stated bounds"},
                                       {data.not_compared, " not compared, for want of a bound"}}) {
      const Tag item(html, "li");
      html.element("strong", count_text(double(count)));
      html.text(words);
    }
  }
  write_charts(html, data);
  write_pictures(page, run, data);
  {
    const Tag section(html, "section", {{"class", "all-cases"}});
    html.element("h2", "Case by case");
    html.element(
        "p",
        "The largest error of each kind: relative to the highlight's peak, and in units in the last "
        "place of float32 at the true value. Of its bound: how much of the stated bound the worst "
        "case uses.");
    for (const auto& [group, meaning] : data.groups) write_group(html, data, group, meaning);
  }
  write_source(html, shell_join(data.command), kRecord);
  if (!data.instruction_set.empty())
    html.element("p", "Instruction set: " + data.instruction_set + ".");
  page.finding =
      data.outside == 0
          ? fmt::format("All {} hard cases stay within their stated error bounds.",
                        count_text(double(data.cases)))
          : fmt::format("{} of {} hard cases are outside their stated error bounds.",
                        count_text(double(data.outside)), count_text(double(data.cases)));
}

}  // namespace
}  // namespace lobelia::gallery::stability_page

namespace lobelia::gallery {
extern const View stability_view{
    "stability", "Stability", "stability.html",
    page_of(stability_page::kRecord, stability_page::kTitle, stability_page::write)};
}
