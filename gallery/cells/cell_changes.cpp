#include "gallery/cells/cell_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/numbers.hpp"
#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

/// "+12 %", "× 25"; empty where there is nothing to divide by.
std::string relative_text(const MetricChange& metric) {
  const double was = metric.was.value_or(0), now = metric.now.value_or(0);
  if (!metric.was || !metric.now || was == 0 || !std::isfinite(was) || !std::isfinite(now))
    return "";
  const double ratio = now / was;
  if (ratio >= 10) return ", × " + number_text(ratio);
  return (ratio < 1 ? ", −" : ", +") + percent_text(std::abs(ratio - 1));
}

std::string change_text(const MetricChange& metric) {
  if (metric.was && !metric.now) return "gone";
  const std::string words =
      fmt::format("{} {}", info(metric.change).mark, info(metric.change).word);
  return metric.change == Change::kWorse || metric.change == Change::kBetter
             ? words + relative_text(metric)
             : words;
}

void write_rows(Html& html, const ShownFarm& farm, const std::vector<const MetricChange*>& rows) {
  const Tag wrap(html, "div", {{"class", "table-wrap"}, {"tabindex", "0"}});
  const Tag table(html, "table", {{"class", "then-and-now"}});
  write_columns(html, {"Measure", "Before", "Now", "Limit", "Change"});
  const Tag body(html, "tbody");
  for (const MetricChange* metric : rows) {
    const Tag row(html, "tr");
    html.element("th", {{"scope", "row"}}, farm.metrics.info(metric->id).title);
    for (const auto& value : {metric->was, metric->now, metric->limit})
      html.element("td", {{"class", "number"}},
                   value ? farm.metrics.text(metric->id, *value) : "–");
    html.element("td", {{"class", std::string(info(metric->change).name)}}, change_text(*metric));
  }
}

/// The main metric first; those that have a limit or changed; the others folded away.
void write_metrics(Html& html, const ShownFarm& farm, const EngineChange& engine) {
  std::vector<const MetricChange*> first, rest;
  for (const MetricChange& metric : engine.metrics) {
    if (metric.id == engine.main)
      first.insert(first.begin(), &metric);
    else
      (metric.limit || metric.change != Change::kSame || !metric.now ? first : rest)
          .push_back(&metric);
  }
  if (!first.empty()) write_rows(html, farm, first);
  if (rest.empty()) return;
  const Tag details(html, "details");
  html.element("summary", fmt::format("{} more {} as before", rest.size(),
                                      rest.size() == 1 ? "measure is" : "measures are"));
  write_rows(html, farm, rest);
}

void write_engine(Html& html, const ShownFarm& farm, const EngineChange& engine,
                  const CellHistory& past) {
  Attributes attributes = {{"class", "engine-change"}};
  if (engine.change != Change::kSame) attributes.push_back({"open", "open"});
  const Tag details(html, "details", attributes);
  {
    const Tag summary(html, "summary");
    html.element("strong", farm.engine_title(engine.engine));
    html.text(" ");
    write_badge(html, info(engine.change).name, info(engine.change).mark, info(engine.change).word);
    html.text(fmt::format(" · {} before, {} now", engine.was, engine.now));
  }
  const auto line = std::ranges::find(past.timelines, engine.engine, &Timeline::engine);
  if (line != past.timelines.end()) write_timeline(html, farm, *line);
  write_metrics(html, farm, engine);
}

void write_pictures_before(Html& html, const ShownFarm& farm, const CheckedCell& cell,
                           const CheckedCell& before) {
  if (before.images.empty())
    return html.element("p", "Every picture is the same file as before, or has another size now.");
  {
    const Tag line(html, "p");
    html.text("These pictures are other ones now; the viewer above has both: ");
    for (std::size_t i = 0; i < before.images.size(); ++i) {
      const EnginePicture& image = before.images[i];
      if (i > 0) html.text(", ");
      html.element(
          "a",
          {{"href", link_to({image.png.is_published ? image.png.file : image.png.small.file})}},
          farm.engine_title(image.engine) + ", before");
    }
    html.text(".");
  }
  if (before.record.exposure_stops != cell.record.exposure_stops)
    html.element(
        "p",
        "The exposure of the files was another one then. The viewer shows float pictures at one exposure.");
}

}  // namespace

std::string change_sentence(const History& history, const CellChange& change) {
  const std::string since = history.since();
  const std::string why = change.reason.empty() ? "" : ": " + change.reason;
  switch (change.change) {
    case Change::kWorse:
      return "Worse than on " + since + why + ".";
    case Change::kBetter:
      return "Better than on " + since + why + ".";
    case Change::kNew:
      return change.was ? "New: there was no picture on " + since + "."
                        : "New: the run of " + since + " does not have this cell.";
    case Change::kUnknown:
      return "Not comparable with " + since + why + ".";
    case Change::kSame:
      break;
  }
  return "As on " + since + ".";
}

void write_cell_changes(Html& html, const ShownFarm& farm, const History& history,
                        const CheckedCell& cell, const CellHistory& past) {
  const Tag section(html, "section", {{"class", "changes"}, {"aria-labelledby", "changes"}});
  html.element("h2", {{"id", "changes"}}, "What changed");
  html.element("p", change_sentence(history, past.change));
  if (past.change.was) {
    const Tag line(html, "p");
    html.text("Before: ");
    write_status(html, farm.words_of(*past.change.was));
    html.text(". Now: ");
    write_status(html, farm.words_of(cell.status));
    html.text(".");
  }
  if (past.before && !past.before->unreadable.empty())
    html.element("p", "Of the earlier run: " + past.before->unreadable);
  if (past.before)
    for (const Flaw& flaw : past.before->flaws)
      html.element("p", "Of the earlier run: " + flaw.message);
  for (const EngineChange& engine : past.change.engines) write_engine(html, farm, engine, past);
  if (past.before && past.before->has_record) write_pictures_before(html, farm, cell, *past.before);
}

}  // namespace lobelia::gallery
