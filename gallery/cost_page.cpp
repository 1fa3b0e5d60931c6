#include "gallery/cost_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error_time_chart.hpp"
#include "core/html.hpp"
#include "core/numbers.hpp"
#include "gallery/cost_data.hpp"
#include "gallery/page.hpp"
#include "gallery/record_page.hpp"

namespace lobelia::gallery {
namespace {

constexpr char kTitle[] = "What accuracy costs in time";
constexpr int kChartWidth = 800;           // beside a table
constexpr std::size_t kMostSentences = 8;  // of a front; the rest can be unfolded

std::string cost_text(const CostTable& table, double cost) {
  if (std::isnan(cost)) return "–";
  return table.cost_unit.empty() ? short_time_text(cost) : number_text(cost);
}

std::string error_text(double error) { return std::isnan(error) ? "–" : number_text(error); }

bool is_on(const CostError& error, const CostWay& way) {
  return std::find(error.front.begin(), error.front.end(), way.name) != error.front.end();
}

std::string chart_of(const CostTable& table, std::size_t e, const std::string& id) {
  ErrorTimes times{id, table.title, table.per, table.cost_unit, table.errors[e].meaning, {}};
  for (const CostWay& way : table.ways)
    times.points.push_back(
        {way.name,
         fmt::format("{}: {} ± {} %, {} {}", way.name, cost_text(table, way.median),
                     number_text(100 * way.spread, 2), table.errors[e].id,
                     error_text(way.errors[e])),
         way.median, way.spread * way.median, way.errors[e], way.error_spreads[e],
         is_on(table.errors[e], way), way.name});
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
  list(0, std::min(kMostSentences, sentences.size()));
  if (sentences.size() <= kMostSentences) return;
  const Tag details(html, "details");
  html.element("summary", fmt::format("{} more", sentences.size() - kMostSentences));
  list(kMostSentences, sentences.size());
}

void write_ways(Html& html, const CostTable& table) {
  const Tag details(html, "details", {{"class", "ways"}});
  html.element("summary", table.ways.size() == 1
                              ? "The one way"
                              : fmt::format("All {} ways, the fastest first", table.ways.size()));
  const Tag scroll(html, "div",
                   {{"class", "table-wrap"},
                    {"tabindex", "0"},
                    {"role", "region"},
                    {"aria-label", "Ways: " + table.title}});
  const Tag element(html, "table", {{"class", "figures"}});
  {
    const Tag head(html, "thead");
    const Tag row(html, "tr");
    html.element("th", {{"scope", "col"}}, "way");
    html.element("th", {{"scope", "col"}},
                 (table.cost_unit.empty() ? "time per " : table.cost_unit + " per ") + table.per);
    html.element("th", {{"scope", "col"}}, "±");
    for (const CostError& error : table.errors) html.element("th", {{"scope", "col"}}, error.id);
    html.element("th", {{"scope", "col"}}, "on the front by");
  }
  std::vector<const CostWay*> ways;
  for (const CostWay& way : table.ways) ways.push_back(&way);
  // NaN last: it compares as nothing.
  std::stable_sort(ways.begin(), ways.end(), [](const CostWay* a, const CostWay* b) {
    const double x = std::isnan(a->median) ? HUGE_VAL : a->median;
    const double y = std::isnan(b->median) ? HUGE_VAL : b->median;
    return x < y;
  });
  const Tag body(html, "tbody");
  for (const CostWay* way : ways) {
    const Tag row(html, "tr", {{"data-key", way->name}});
    html.element("th", {{"scope", "row"}}, way->name);
    html.element("td", {{"class", "number"}}, cost_text(table, way->median));
    html.element("td", {{"class", "number"}}, fmt::format("{} %", number_text(100 * way->spread)));
    for (const double error : way->errors)
      html.element("td", {{"class", "number"}}, error_text(error));
    std::string on;
    for (const CostError& error : table.errors)
      if (is_on(error, *way)) on += (on.empty() ? "" : ", ") + error.id;
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
        html.raw(chart_of(table, e, fmt::format("cost-{}-{}", number, e)));
      }
      write_sentences(html, error.in_words);
    }
    for (const std::string& remark : table.remarks) html.element("p", remark);
  }
  write_ways(html, table);
}

void write_cost(Html& html, const CostData& cost) {
  {
    const Tag header(html, "header");
    html.element("h1", kTitle);
    html.element("p", {{"class", "lead"}},
                 "Every way of making one thing, with its error and its time, measured in one run: "
                 "medians of interleaved rounds, ± half the spread between quartiles. The front is "
                 "those ways of which no other is both as fast and as accurate.");
  }
  {
    const Tag nav(html, "nav", {{"aria-label", "What was measured"}});
    const Tag list(html, "ul");
    for (std::size_t i = 0; i < cost.tables.size(); ++i) {
      const Tag item(html, "li");
      html.element("a", {{"href", fmt::format("#table-{}", i)}}, cost.tables[i].title);
    }
  }
  for (std::size_t i = 0; i < cost.tables.size(); ++i) write_table(html, cost.tables[i], i);
  {
    const Tag section(html, "section");
    html.element("h2", "How it was measured");
    write_command(html, cost.command);
    {
      const Tag line(html, "p");
      html.text("All of it is in ");
      html.element("a", {{"href", kCostRecord}}, "cost.json");
      html.text(" and ");
      html.element("a", {{"href", kCostTable}}, "cost.csv");
      html.text(".");
    }
    const Tag list(html, "dl");
    for (const auto& [name, value] : cost.host) {
      const Tag item(html, "div");
      html.element("dt", name);
      html.element("dd", value);
    }
  }
}

}  // namespace

std::optional<ViewPage> cost_view(const std::filesystem::path& run) {
  return record_page(run, kCostRecord, "cost", kTitle, [&](ViewPage& page, const Fields& record) {
    write_cost(page.main, read_cost(record));
    if (std::filesystem::is_regular_file(run / kCostTable)) page.files.push_back(kCostTable);
  });
}

}  // namespace lobelia::gallery
