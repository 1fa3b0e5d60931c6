// The page on what accuracy costs in time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/records/cost.hpp"
#include "base/records/words.hpp"
#include "base/words/error_time_chart.hpp"
#include "base/words/numbers.hpp"
#include "base/words/text.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/page_text.hpp"
#include "gallery/pages/views.hpp"

namespace lobelia::gallery::cost_page {
namespace {

using records::CostError, records::CostTable, records::CostVariant;

constexpr char kRecord[] = "cost/cost.json", kCsv[] = "cost/cost.csv";
constexpr char kTitle[] = "What accuracy costs in time";
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kChartWidth = 800;          // beside a table
constexpr int kNarrowWidth = 380;         // on a phone
constexpr std::size_t kMostNamed = 12;    // points that all have their name, and not a number
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

bool is_timed(const CostTable& table) { return cost_unit(table).empty(); }

/// "± 4 %", or that there was one run, which tells no spread.
std::string spread_text(const CostVariant& variant) {
  if (!variant.seconds) return "–";
  if (variant.seconds->rounds == 1) return "one run";
  if (spread_of(variant) == 0) return fmt::format("the same in {} runs", variant.seconds->rounds);
  return fmt::format("± {} %", number_text(100 * spread_of(variant), 2));
}

std::vector<std::string> parts_of(std::string_view meaning) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < meaning.size(); ++i)
    if (meaning.substr(i).starts_with(", "))
      parts.emplace_back(), ++i;
    else
      parts.back() += meaning[i];
  return parts;
}

/// The part of the title that differs between the errors of a table: "at n = 8".
std::string short_title(const CostTable& table, const CostError& error) {
  const auto is_shared = [&](const std::string& part) {
    return table.errors.size() > 1 && std::ranges::all_of(table.errors, [&](const CostError& e) {
             return std::ranges::count(parts_of(e.meaning), part) > 0;
           });
  };
  const std::vector<std::string> parts = parts_of(error.meaning);
  std::string title;
  for (const std::string& part : parts)
    if (!is_shared(part) && !part.starts_with("of the ") && !part.starts_with("relative to "))
      title += (title.empty() ? "" : ", ") + part;
  return math_text(title.empty() ? parts.front() : title);
}

/// Those whose cost is known, the cheapest first, then the others: the numbers of the rows and points.
std::vector<const CostVariant*> in_order(const CostTable& table) {
  std::vector<const CostVariant*> variants;
  for (const CostVariant& variant : table.variants) variants.push_back(&variant);
  // Unknown costs last: a NaN cannot be sorted.
  std::ranges::stable_sort(variants, {}, [](const CostVariant* variant) {
    const double cost = cost_of(*variant);
    return std::isnan(cost) ? HUGE_VAL : cost;
  });
  return variants;
}

std::string error_text(double error) { return std::isnan(error) ? "–" : number_text(error); }

/// Whether no other variant is both as fast and as accurate.
bool is_on_front(const CostTable& table, const CostError& error, const CostVariant& variant) {
  const records::CostFront* front = records::find(table.fronts, error.id);
  return front && std::ranges::find(front->variants, variant.name) != front->variants.end();
}

Chart chart_of(const CostTable& table, const CostError& error, const std::string& id, bool narrow) {
  ErrorTimes times{
      id, math_text(table.title), table.per, math_text(cost_unit(table)), math_text(error.meaning),
      {}};
  int row = 0;
  for (const CostVariant* one : in_order(table)) {
    const CostVariant& variant = *one;
    const double cost = cost_of(variant), spread = spread_of(variant),
                 value = error_of(variant, error);
    const std::string name = spoken_name(variant.name), place = std::to_string(++row);
    const bool named = table.variants.size() <= kMostNamed;
    times.points.push_back({named    ? name
                            : narrow ? place
                                     : place + " " + name,
                            fmt::format("{} {}: {}{}, {} {}", place, name, cost_text(table, cost),
                                        is_timed(table) ? ", " + spread_text(variant) : "",
                                        short_title(table, error), error_text(value)),
                            cost, spread * cost, value, error_spread_of(variant, error),
                            is_on_front(table, error, variant), variant.name});
  }
  Chart chart = error_time_chart(times);
  chart.width = narrow ? kNarrowWidth : kChartWidth;
  if (narrow && times.points.size() > kMostNamed) {  // as many points need room for their numbers
    chart.height = std::min(720, 400 + 5 * int(times.points.size()));
    chart.marker_radius = 3;
  }
  return chart;
}

/// A point alone shows nothing.
bool is_drawable(const CostTable& table, const CostError& error) {
  std::size_t points = 0;
  for (const ChartSeries& series : chart_of(table, error, "", false).series)
    points += series.markers ? series.x.size() : 0;
  return points > 1;
}

/// The cheapest first.
std::vector<const CostVariant*> front_of(const CostTable& table, const CostError& error) {
  std::vector<const CostVariant*> front;
  for (const CostVariant* variant : in_order(table))
    if (is_on_front(table, error, *variant) && cost_of(*variant) > 0 &&
        error_of(*variant, error) >= 0)
      front.push_back(variant);
  return front;
}

/// The ends of the front, by the table's first error.
std::string finding_of(const CostTable& table) {
  if (table.errors.empty() || table.variants.empty()) return "";
  const CostError& error = table.errors.front();
  const std::vector<const CostVariant*> front = front_of(table, error);
  const auto cost = [&](const CostVariant& variant) {
    return cost_text(table, cost_of(variant)) + (is_timed(table) ? "" : " " + cost_unit(table));
  };
  const auto told = [&](const CostVariant& variant) {
    const double value = error_of(variant, error);
    return cost(variant) + (value == 0 ? " and no error" : " and an error of " + error_text(value));
  };
  const auto name = [](const CostVariant& variant) {
    return "“" + spoken_name(variant.name) + "”";
  };
  if (table.variants.size() == 1)
    return fmt::format("Only {} was measured, at {}: there is nothing to compare it with.",
                       name(table.variants[0]), cost(table.variants[0]));
  if (front.empty()) return "";
  const CostVariant &cheap = *front.front(), &exact = *front.back();
  if (front.size() == 1)
    return fmt::format("No variant beats {} in time or in error: {}.", name(cheap), told(cheap));
  const double times = cost_of(exact) / cost_of(cheap);
  return fmt::format("The {} is {}, with {}. The least error has {}, with {}: {} times the {}.",
                     is_timed(table) ? "fastest" : "cheapest", name(cheap), told(cheap),
                     name(exact), told(exact), number_text(times, 2),
                     is_timed(table) ? "time" : cost_unit(table));
}

/// Which variant to take, by the table's first error: for each error that one may have, or where there is no front.
std::vector<std::string> findings_of(const CostTable& table) {
  const records::CostFront* front =
      table.errors.empty() ? nullptr : records::find(table.fronts, table.errors.front().id);
  if (front && front->answers && !front->answers->empty()) return *front->answers;
  const std::string finding = finding_of(table);
  return finding.empty() ? std::vector<std::string>() : std::vector{finding};
}

void write_sentences(Html& html, const std::vector<std::string>& sentences) {
  const auto list = [&](std::size_t begin, std::size_t end) {
    const Tag ul(html, "ul");
    for (std::size_t i = begin; i < end; ++i) html.element("li", spoken_name(sentences[i]));
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
  html.element("summary", table.variants.size() == 1
                              ? "The one variant"
                              : fmt::format("All {} variants, the {} first", table.variants.size(),
                                            is_timed(table) ? "fastest" : "cheapest"));
  const Tag scroll(html, "div", scroll_box("Variants: " + math_text(table.title)));
  const Tag element(html, "table", {{"class", "figures"}});
  std::vector<std::string> titles = {
      "no.", "variant", (is_timed(table) ? "time per " : cost_unit(table) + " per ") + table.per};
  if (is_timed(table)) titles.emplace_back("spread");
  for (const CostError& error : table.errors) titles.push_back(short_title(table, error));
  write_columns(html, titles);
  const Tag body(html, "tbody");
  int number = 0;
  for (const CostVariant* variant : in_order(table)) {
    const bool on = std::ranges::any_of(
        table.errors, [&](const CostError& error) { return is_on_front(table, error, *variant); });
    Attributes attributes{{"data-key", variant->name}};
    if (on) attributes.push_back({"class", "front"});
    const Tag row(html, "tr", attributes);
    const auto figure = [&](const std::string& text) {
      html.element("td", {{"class", "number"}}, text);
    };
    figure(std::to_string(++number));
    html.element("th", {{"scope", "row"}}, spoken_name(variant->name));
    figure(cost_text(table, cost_of(*variant)));
    if (is_timed(table)) figure(spread_text(*variant));
    for (const CostError& error : table.errors)
      figure((is_on_front(table, error, *variant) ? "● " : "") +
             error_text(error_of(*variant, error)));
  }
}

/// The chart for screens and for phones.
void write_chart(Html& html, const CostTable& table, std::size_t number, std::size_t e) {
  const CostError& error = table.errors[e];
  const std::string id = fmt::format("cost-{}-{}", number, e), title = short_title(table, error);
  const Tag figure(
      html, "figure",
      {{"class", "chart-figure"}, {"data-name", table.id + "-" + error.id}, {"data-title", title}});
  html.element("h3", math_text(error.meaning));
  for (const bool narrow : {false, true}) {
    const Tag box(html, "div", {{"class", narrow ? "narrow" : "wide"}});
    html.raw(draw_chart(chart_of(table, error, narrow ? id + "-narrow" : id, narrow)));
  }
}

/// One chart, and those by the other errors below it.
void write_charts(Html& html, const CostTable& table, std::size_t number) {
  std::vector<std::size_t> drawn;
  for (std::size_t e = 0; e < table.errors.size(); ++e)
    if (is_drawable(table, table.errors[e])) drawn.push_back(e);
  if (drawn.empty()) return;
  write_chart(html, table, number, drawn[0]);
  if (drawn.size() == 1) return;
  const Tag details(html, "details", {{"class", "more-charts"}});
  html.element("summary", drawn.size() == 2 ? "By another error"
                                            : fmt::format("By {} other errors", drawn.size() - 1));
  for (std::size_t i = 1; i < drawn.size(); ++i) write_chart(html, table, number, drawn[i]);
}

void write_words(Html& html, const CostTable& table) {
  const bool has_words = std::ranges::any_of(
      table.fronts, [](const auto& front) { return !front.second.in_words.empty(); });
  if (!has_words && table.remarks.empty()) return;
  const Tag details(html, "details", {{"class", "in-words"}});
  html.element("summary", "In words, and how it was measured");
  for (const CostError& error : table.errors) {
    const auto* front = records::find(table.fronts, error.id);
    if (!front || front->in_words.empty()) continue;
    html.element("h3", "By the " + short_title(table, error));
    write_sentences(html, front->in_words);
  }
  for (const std::string& remark : table.remarks) math_element(html, "p", remark);
}

void write_table(Html& html, const CostTable& table, std::size_t number) {
  const Tag section(html, "section", {{"id", fmt::format("table-{}", number)}});
  html.element("h2", math_text(table.title));
  for (const std::string& finding : findings_of(table))
    html.element("p", {{"class", "finding"}}, spoken_name(finding));
  {
    const Tag pair(html, "div", {{"class", "cost-pair"}});
    {
      const Tag charts(html, "div", {{"class", "charts"}});
      write_charts(html, table, number);
    }
    write_ways(html, table);
  }
  write_words(html, table);
}

/// The step along a front that buys the least accuracy for its time.
std::string dearest_step(const records::Cost& record) {
  std::string sentence;
  double dearest = 0;
  for (const CostTable& table : record.tables)
    for (const CostError& error : table.errors) {
      std::vector<const CostVariant*> front = front_of(table, error);
      std::erase_if(front, [&](const CostVariant* variant) {
        return !variant->seconds || error_of(*variant, error) == 0;
      });
      for (std::size_t i = 1; i < front.size(); ++i) {
        const double time = cost_of(*front[i]) / cost_of(*front[i - 1]);
        const double gain = error_of(*front[i - 1], error) / error_of(*front[i], error);
        if (time < 1.5 || gain < 2 || std::log(time) / std::log(gain) <= dearest) continue;
        dearest = std::log(time) / std::log(gain);
        sentence = fmt::format(
            "The most expensive accuracy: “{}” takes {} times as long as “{}”, for an error {} times "
            "as small ({}).",
            spoken_name(front[i]->name), number_text(time, 2), spoken_name(front[i - 1]->name),
            number_text(gain, 2), math_text(table.title));
      }
    }
  return sentence;
}

void write(ViewPage& page, const records::Cost& cost, const RunFiles& run) {
  Html& html = page.main;
  write_lead(html, kTitle,
             "Each table has every variant of one thing, with its error and its time. Times are "
             "medians of interleaved rounds, ± half the spread between quartiles. On the front are "
             "the variants that no other beats in both time and error. A ring is a point that lies "
             "on another.");
  {
    const Tag nav(html, "nav", {{"aria-label", "What was measured"}});
    const Tag list(html, "ul");
    for (std::size_t i = 0; i < cost.tables.size(); ++i) {
      const Tag item(html, "li");
      html.element("a", {{"href", fmt::format("#table-{}", i)}}, math_text(cost.tables[i].title));
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
  page.finding = dearest_step(cost);
  if (file_type_at(run / kCsv) == std::filesystem::file_type::regular) page.files.push_back(kCsv);
}

}  // namespace
}  // namespace lobelia::gallery::cost_page

namespace lobelia::gallery {
extern const View cost_view{"cost", "Cost", "cost.html",
                            page_of(cost_page::kRecord, cost_page::kTitle, cost_page::write)};
}
