// The page on what accuracy costs in time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error_time_chart.hpp"
#include "core/numbers.hpp"
#include "core/text.hpp"
#include "gallery/page.hpp"
#include "gallery/views.hpp"
#include "records/cost.hpp"
#include "records/words.hpp"

namespace lobelia::gallery::cost_page {
namespace {

using records::CostError, records::CostTable, records::CostVariant;

constexpr char kRecord[] = "cost/cost.json", kCsv[] = "cost/cost.csv";
constexpr char kTitle[] = "What accuracy costs in time";
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kChartWidth = 800;          // beside a table
constexpr std::size_t kMaxSentences = 8;  // about a front; the rest can be unfolded

/// Empty for seconds.
std::string cost_unit(const CostTable& table) { return table.unit == "s" ? "" : table.unit; }

double cost_of(const CostVariant& variant) {
  return variant.seconds ? variant.seconds->median : variant.count.value_or(kUnknown);
}
double spread_of(const CostVariant& variant) {
  return variant.seconds ? variant.seconds->spread : 0;
}

double error_of(const CostVariant& variant, const CostError& error) {
  const double* value = records::find(variant.errors, error.id);
  return value ? *value : kUnknown;
}
double error_spread_of(const CostVariant& variant, const CostError& error) {
  const double* spread =
      variant.error_spreads ? records::find(*variant.error_spreads, error.id) : nullptr;
  return spread ? *spread : 0;
}

std::string cost_text(const CostTable& table, double cost) {
  if (std::isnan(cost)) return "–";
  return cost_unit(table).empty() ? short_time_text(cost) : number_text(cost);
}

std::string error_text(double error) { return std::isnan(error) ? "–" : number_text(error); }

/// Whether no other variant is both as fast and as accurate.
bool is_on_front(const CostTable& table, const CostError& error, const CostVariant& variant) {
  const records::CostFront* front = records::find(table.fronts, error.id);
  return front && std::ranges::find(front->variants, variant.name) != front->variants.end();
}

std::string chart_of(const CostTable& table, const CostError& error, const std::string& id) {
  ErrorTimes times{id, table.title, table.per, cost_unit(table), error.meaning, {}};
  for (const CostVariant& variant : table.variants) {
    const double cost = cost_of(variant), spread = spread_of(variant),
                 value = error_of(variant, error);
    times.points.push_back(
        {variant.name,
         fmt::format("{}: {} ± {} %, {} {}", variant.name, cost_text(table, cost),
                     number_text(100 * spread, 2), error.id, error_text(value)),
         cost, spread * cost, value, error_spread_of(variant, error),
         is_on_front(table, error, variant), variant.name});
  }
  Chart chart = error_time_chart(times);
  chart.width = kChartWidth;
  return draw_chart(chart);
}

void write_sentences(Html& html, const std::vector<std::string>& sentences) {
  const auto list = [&](std::size_t begin, std::size_t end) {
    const Tag ul(html, "ul");
    for (std::size_t i = begin; i < end; ++i) html.element("li", sentences[i]);
  };
  if (sentences.empty()) return;
  list(0, std::min(kMaxSentences, sentences.size()));
  if (sentences.size() <= kMaxSentences) return;
  const Tag details(html, "details");
  html.element("summary", fmt::format("{} more", sentences.size() - kMaxSentences));
  list(kMaxSentences, sentences.size());
}

void write_ways(Html& html, const CostTable& table) {
  const Tag details(html, "details", {{"class", "variants"}});
  html.element("summary",
               table.variants.size() == 1
                   ? "The one variant"
                   : fmt::format("All {} variants, the fastest first", table.variants.size()));
  const Tag scroll(html, "div", scroll_box("Ways: " + table.title));
  const Tag element(html, "table", {{"class", "figures"}});
  std::vector<std::string> titles = {
      "variant", (cost_unit(table).empty() ? "time per " : cost_unit(table) + " per ") + table.per,
      "±"};
  for (const CostError& error : table.errors) titles.push_back(error.id);
  titles.emplace_back("on the front by");
  write_columns(html, titles);
  std::vector<const CostVariant*> variants;
  for (const CostVariant& variant : table.variants) variants.push_back(&variant);
  // Unknown costs last: a NaN cannot be sorted.
  std::ranges::stable_sort(variants, {}, [](const CostVariant* variant) {
    const double cost = cost_of(*variant);
    return std::isnan(cost) ? HUGE_VAL : cost;
  });
  const Tag body(html, "tbody");
  for (const CostVariant* variant : variants) {
    const Tag row(html, "tr", {{"data-key", variant->name}});
    html.element("th", {{"scope", "row"}}, variant->name);
    html.element("td", {{"class", "number"}}, cost_text(table, cost_of(*variant)));
    html.element("td", {{"class", "number"}},
                 fmt::format("{} %", number_text(100 * spread_of(*variant))));
    for (const CostError& error : table.errors)
      html.element("td", {{"class", "number"}}, error_text(error_of(*variant, error)));
    std::string on;
    for (const CostError& error : table.errors)
      if (is_on_front(table, error, *variant)) on += (on.empty() ? "" : ", ") + error.id;
    html.element("td", on);
  }
}

void write_table(Html& html, const CostTable& table, std::size_t number) {
  const Tag section(html, "section", {{"id", fmt::format("table-{}", number)}});
  html.element("h2", table.title);
  const Tag pair(html, "div", {{"class", "cost-pair"}});
  {
    const Tag charts(html, "div");
    for (std::size_t e = 0; e < table.errors.size(); ++e) {
      const CostError& error = table.errors[e];
      html.element("h3", error.meaning);
      {
        const Tag figure(html, "figure", {{"class", "chart-figure"}});
        html.raw(chart_of(table, error, fmt::format("cost-{}-{}", number, e)));
      }
      if (const auto* front = records::find(table.fronts, error.id))
        write_sentences(html, front->in_words);
    }
    for (const std::string& remark : table.remarks) html.element("p", remark);
  }
  write_ways(html, table);
}

void write_cost(Html& html, const records::Cost& cost) {
  write_lead(html, kTitle,
             "Every variant of one thing, with its error and its time, measured in one run: "
             "medians of interleaved rounds, ± half the spread between quartiles. The front is "
             "the variants that no other beats in both time and error.");
  {
    const Tag nav(html, "nav", {{"aria-label", "What was measured"}});
    const Tag list(html, "ul");
    for (std::size_t i = 0; i < cost.tables.size(); ++i) {
      const Tag item(html, "li");
      html.element("a", {{"href", fmt::format("#table-{}", i)}}, cost.tables[i].title);
    }
  }
  for (std::size_t i = 0; i < cost.tables.size(); ++i) write_table(html, cost.tables[i], i);
  const Tag section(html, "section");
  html.element("h2", "How it was measured");
  write_command(html, shell_join(cost.command));
  {
    const Tag line(html, "p");
    html.text("All of it is in ");
    html.element("a", {{"href", kRecord}}, "cost.json");
    html.text(" and ");
    html.element("a", {{"href", kCsv}}, "cost.csv");
    html.text(".");
  }
  const Tag list(html, "dl");
  for (const auto& [name, value] : words_of(cost.host)) write_fact(html, name, value);
}

std::optional<ViewPage> read_and_draw(const std::filesystem::path& run) {
  return record_page<records::Cost>(run, kRecord, kTitle,
                                    [&](ViewPage& page, const records::Cost& record) {
                                      write_cost(page.main, record);
                                      if (std::filesystem::is_regular_file(run / kCsv))
                                        page.files.push_back(kCsv);
                                    });
}

}  // namespace
}  // namespace lobelia::gallery::cost_page

namespace lobelia::gallery {
extern const View cost_view{"cost", "Cost", "cost.html", cost_page::read_and_draw};
}
