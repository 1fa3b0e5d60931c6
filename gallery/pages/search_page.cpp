// The page on the cheapest lobes: error over operations, for the whole range of exponents and for each.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/records/lobe_search.hpp"
#include "base/words/error_time_chart.hpp"
#include "base/words/numbers.hpp"
#include "base/words/text.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/page_text.hpp"
#include "gallery/pages/views.hpp"

namespace lobelia::gallery::search_page {
namespace {

using records::LobeSearch, records::SearchedLobe;

constexpr char kRecord[] = "search/search.json", kDirectory[] = "search";
constexpr char kTitle[] = "The cheapest lobes";

/// The paper's lobes and Schlick's: shown for comparison, never on the front.
bool is_known(const SearchedLobe& lobe) {
  return lobe.name == "schlick" || lobe.name.starts_with("cs");
}

std::string range_of(const LobeSearch& found) {
  return found.most_exponent ? fmt::format("n = {} to {}", number_text(found.least_exponent),
                                           number_text(*found.most_exponent))
                             : fmt::format("n = {} and above", number_text(found.least_exponent));
}

/// A chart of the lobes; errors[i] is the error of lobe i.
std::string chart_of(const LobeSearch& found, const std::vector<double>& errors,
                     const std::string& id, const std::string& title, bool narrow) {
  ErrorTimes times{id, title, "value", "operations", "largest error, of the peak", {}};
  double nearest = std::numeric_limits<double>::infinity(), dearest = 1,
         cheapest = found.lobes.front().price;
  std::map<int, double> nearest_of_price;
  for (std::size_t i = 0; i < found.lobes.size(); ++i)
    if (const SearchedLobe& lobe = found.lobes[i]; !is_known(lobe)) {
      const auto [it, is_first] = nearest_of_price.emplace(lobe.price, errors[i]);
      it->second = std::min(it->second, errors[i]);
    }
  ChartSeries known{"the paper's and Schlick's", {}, {}, 3, true};
  for (std::size_t i = 0; i < found.lobes.size(); ++i) {
    const SearchedLobe& lobe = found.lobes[i];
    const double price = lobe.price;
    const std::string label = fmt::format("{}: {} operations, error {}; {}", lobe.name, lobe.price,
                                          number_text(errors[i], 4), math_text(lobe.formula));
    dearest = std::max(dearest, price);
    if (is_known(lobe)) {
      known.x.push_back(price);
      known.y.push_back(errors[i]);
      known.point_labels.push_back(label);
      known.point_names.push_back(lobe.name);
      known.point_keys.push_back(lobe.name);
      continue;
    }
    // Lobes are cheapest first; of one price the nearest is on the front.
    const bool on_front = errors[i] <= nearest_of_price[lobe.price] && errors[i] < nearest;
    if (on_front) nearest = errors[i];
    times.points.push_back({lobe.name, label, price, 0, errors[i], 0, on_front, lobe.name});
  }
  Chart chart = error_time_chart(times);
  chart.x = {"operations, a division counted as six", cheapest - 1, dearest + 1};
  chart.width = narrow ? 380 : 800;
  chart.series.push_back(std::move(known));
  for (const double error : chart.series.back().y) chart.y.to = std::max(chart.y.to, error);
  return draw_chart(chart);
}

void write_chart(Html& html, const LobeSearch& found, const std::vector<double>& errors,
                 std::size_t number, const std::string& shown) {
  Attributes attributes{{"class", "chart-figure"}, {"data-exponent", shown}, {"data-name", shown}};
  if (number > 0) attributes.emplace_back("hidden", "hidden");
  const Tag figure(html, "figure", attributes);
  html.element("figcaption", shown);
  for (const bool narrow : {false, true}) {
    const Tag box(html, "div", {{"class", narrow ? "narrow" : "wide"}});
    html.raw(chart_of(found, errors, fmt::format("search-{}{}", number, narrow ? "-narrow" : ""),
                      shown, narrow));
  }
}

void write_charts(Html& html, const LobeSearch& found) {
  const Tag charts(html, "div", {{"class", "exponents"}});
  std::vector<double> errors;
  for (const SearchedLobe& lobe : found.lobes) errors.push_back(lobe.errors.max);
  write_chart(html, found, errors, 0, range_of(found));
  const std::size_t count = std::ranges::min(found.lobes, {}, [](const SearchedLobe& l) {
                              return l.by_exponents.size();
                            }).by_exponents.size();
  for (std::size_t e = 0; e < count; ++e) {
    for (std::size_t i = 0; i < errors.size(); ++i)
      errors[i] = found.lobes[i].by_exponents[e].error;
    write_chart(html, found, errors, e + 1,
                "n = " + number_text(found.lobes[0].by_exponents[e].exponent, 4));
  }
}

void write_lobes(Html& html, const LobeSearch& found, const std::filesystem::path& run,
                 ViewPage& page) {
  const Tag details(html, "details", {{"class", "variants"}});
  html.element("summary", fmt::format("All {} lobes, the cheapest first", found.lobes.size()));
  const Tag scroll(html, "div", scroll_box("Lobes"));
  const Tag element(html, "table", {{"class", "figures"}});
  write_columns(html,
                {"lobe", "operations", "time", "spread", "error at most", "at least", "formula"});
  const Tag body(html, "tbody");
  for (const SearchedLobe& lobe : found.lobes) {
    const Tag row(html, "tr", {{"data-key", lobe.name}});
    {
      const Tag head(html, "th", {{"scope", "row"}});
      const std::string shader = fmt::format("{}/{}.glsl", kDirectory, lobe.name);
      if (is_plain_name(lobe.name) &&
          file_type_at(run / shader) == std::filesystem::file_type::regular) {
        html.element("a", {{"href", shader}}, lobe.name);
        page.files.push_back(shader);
      } else {
        html.text(lobe.name);
      }
    }
    const auto number = [&](const std::string& text) {
      html.element("td", {{"class", "number"}}, text);
    };
    number(fmt::format("{}", lobe.price));
    number(short_time_text(lobe.seconds.median));
    number("± " + number_text(100 * lobe.seconds.spread, 2) + " %");
    number(number_text(lobe.errors.max, 4));
    number(lobe.lower_bound ? number_text(*lobe.lower_bound, 4) : "–");
    math_element(html, "td", {{"class", "formula"}}, lobe.formula);
  }
}

/// The nearest of the known lobes beside the nearest lobe at its price.
std::string finding_of(const LobeSearch& found) {
  const SearchedLobe *best = nullptr, *known = nullptr;
  for (const SearchedLobe& lobe : found.lobes)
    if (is_known(lobe) && (!known || lobe.errors.max < known->errors.max)) known = &lobe;
  for (const SearchedLobe& lobe : found.lobes)
    if (known && !is_known(lobe) && lobe.price <= known->price &&
        (!best || lobe.errors.max < best->errors.max))
      best = &lobe;
  if (!best || !(best->errors.max > 0)) return "";
  return fmt::format(
      "With {} operations “{}” misses cosⁿ by {} of the peak at most, and “{}” by {}: {} times "
      "nearer.",
      known->price, known->name, percent_text(known->errors.max), best->name,
      percent_text(best->errors.max), number_text(known->errors.max / best->errors.max, 2));
}

void write(ViewPage& page, const LobeSearch& found, const RunFiles& run) {
  Html& html = page.main;
  if (found.lobes.empty()) return write_absence(html, "No lobe was found.");
  write_lead(
      html, kTitle,
      fmt::format(
          "The lobes nearest to cosⁿ that so few operations can make, {}. 'Error at most' is proved for "
          "every angle and exponent, 'at least' for every lobe of the same shape. t is n (1 − cos).",
          range_of(found)));
  {
    const Tag section(html, "section", {{"id", "table-0"}});
    for (const std::string& answer : found.answers)
      html.element("p", {{"class", "finding"}}, answer);
    if (const std::string finding = finding_of(found); !finding.empty())
      html.element("p", {{"class", "finding"}}, finding);
    const Tag pair(html, "div", {{"class", "cost-pair"}});
    write_charts(html, found);
    write_lobes(html, found, run, page);
  }
  write_source(html, shell_join(found.command), kRecord);
}

}  // namespace
}  // namespace lobelia::gallery::search_page

namespace lobelia::gallery {
extern const View search_view{
    "search", "Cheapest lobes", "search.html",
    page_of(search_page::kRecord, search_page::kTitle, search_page::write)};
}
