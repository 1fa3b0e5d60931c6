// The page on speed: what 'make bench' measured last, and each goal over the commits before.
#include <fmt/format.h>

#include <algorithm>

#include "base/records/bench.hpp"
#include "base/words/error_time_chart.hpp"
#include "base/words/numbers.hpp"
#include "base/words/svg_chart.hpp"
#include "base/words/text.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/page_text.hpp"
#include "gallery/pages/views.hpp"

namespace lobelia::gallery::bench_page {
namespace {

using records::Bench, records::BenchGoal, records::BenchRun;

constexpr char kRecord[] = "bench/bench.json", kTitle[] = "Speed, and what was asked";
constexpr std::size_t kMaxDrawn = 100;  // runs, the latest

std::string goal_text(const BenchGoal& goal) {
  return (goal.at_least ? "≥ " : "≤ ") + number_text(goal.goal, 3);
}

std::string name_of(const BenchRun& run) {
  if (run.commit.empty()) return "a source without commits";
  return run.committed.empty() ? run.commit : fmt::format("{} of {}", run.commit, run.committed);
}

const BenchGoal* find_goal(const BenchRun& run, const std::string& id) {
  const auto found = std::ranges::find(run.goals, id, &BenchGoal::id);
  return found == run.goals.end() ? nullptr : &*found;
}

/// The ratio over the runs. Without points if there are fewer than two: one would say nothing.
Chart chart_of(std::span<const BenchRun> runs, const BenchGoal& goal, std::size_t number) {
  Chart chart{
      .id = fmt::format("goal-{}", number),
      .title = goal.what,
      .description = fmt::format("The ratio to {} over the runs, and the goal.", goal.against),
      .width = 380,
      .height = 220,
      .x = {"run, the latest last", 0.5, double(runs.size()) + 0.5},
      .y = {goal.at_least ? "times faster" : "part of what is allowed"}};
  ChartSeries asked{"goal", {chart.x.from, chart.x.to}, {goal.goal, goal.goal}, 2};
  ChartSeries measured{"measured", {}, {}, 1, true};
  double most = goal.goal;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (const BenchGoal* one = find_goal(runs[i], goal.id)) {
      measured.x.push_back(double(i + 1));
      measured.y.push_back(one->ratio.median);
      measured.y_error.push_back(one->ratio.median * one->ratio.spread);
      measured.point_labels.push_back(
          fmt::format("{}: {}", name_of(runs[i]), number_text(one->ratio.median, 3)));
      most = std::max(most, one->ratio.median + measured.y_error.back());
    }
  chart.y.to = round_up(1.05 * most);
  if (measured.x.size() > 1) chart.series = {std::move(asked), std::move(measured)};
  return chart;
}

void write_table(Html& html, const BenchRun& run) {
  const Tag scroll(html, "div", scroll_box("Goals"));
  const Tag table(html, "table", {{"class", "figures"}});
  write_columns(html,
                {"what", "ours", "held to", "its figure", "ratio", "spread", "goal", "verdict"});
  const Tag body(html, "tbody");
  for (const BenchGoal& goal : run.goals) {
    const Tag row(html, "tr");
    html.element("th", {{"scope", "row"}}, goal.what);
    const auto cell = [&](const std::string& text) {
      html.element("td", {{"class", "number"}}, text);
    };
    cell(quantity_text(goal.ours.median, goal.unit));
    html.element("td", goal.against);
    cell(quantity_text(goal.other.median, goal.unit));
    cell(number_text(goal.ratio.median, 3));
    cell(goal.ratio.rounds < 2 ? "one round"
                               : "± " + number_text(100 * goal.ratio.spread, 2) + " %");
    cell(goal_text(goal));
    const Tag verdict(html, "td");
    goal.met ? write_badge(html, "pass", "✓", "met") : write_badge(html, "differs", "≠", "not met");
  }
}

/// A sentence for each reason.
void write_left_out(Html& html, const BenchRun& run) {
  std::vector<std::string> reasons;
  for (const auto& [id, why] : run.left_out)
    if (std::ranges::find(reasons, why) == reasons.end()) reasons.push_back(why);
  for (const std::string& reason : reasons) {
    std::vector<std::string_view> goals;
    for (const auto& [id, why] : run.left_out)
      if (why == reason) goals.push_back(id);
    html.element("p", fmt::format("{} {} not measured: {}.", join(goals),
                                  goals.size() == 1 ? "was" : "were", reason));
  }
}

void write(ViewPage& page, const Bench& bench, const RunFiles&) {
  Html& html = page.main;
  write_lead(
      html, kTitle,
      "Each goal is measured in rounds, in turn with what it is held to: another program, or the "
      "limit of the machine. A ratio is the median of the rounds' own ratios.");
  if (bench.runs.empty()) return write_absence(html, "Nothing was measured.");
  const std::size_t left = bench.runs.size() - std::min(bench.runs.size(), kMaxDrawn);
  const std::span<const BenchRun> runs = std::span(bench.runs).subspan(left);
  const BenchRun& last = runs.back();
  const auto met = std::ranges::count(last.goals, true, &BenchGoal::met);
  page.finding =
      fmt::format("{} of {} goals of speed are met by {}.", met, last.goals.size(), name_of(last));
  html.element("p", {{"class", "finding"}}, page.finding);
  {
    const Tag list(html, "dl", {{"class", "facts"}});
    write_fact(html, "Machine",
               fmt::format("{}, {} threads, {}", last.host.processor, last.host.threads,
                           last.instruction_set));
    write_fact(html, "Rounds", last.quick ? "few: a quick run" : "");
  }
  write_table(html, last);
  write_left_out(html, last);
  html.element("h2", "Over the commits");
  std::size_t drawn = 0;
  {
    const Tag grid(html, "div", {{"class", "figure-grid"}});
    for (const BenchGoal& goal : last.goals) {
      const Chart chart = chart_of(runs, goal, drawn);
      if (chart.series.empty()) continue;
      ++drawn;
      const Tag figure(html, "figure", {{"class", "chart-figure"}});
      html.element("figcaption", fmt::format("{}, {} asked", goal.what, goal_text(goal)));
      html.raw(draw_chart(chart));
    }
  }
  if (drawn == 0) html.element("p", "There is one run so far.");
  write_source(html, "make bench", kRecord);
}

}  // namespace
}  // namespace lobelia::gallery::bench_page

namespace lobelia::gallery {
extern const View bench_view{"bench", "Speed", "bench.html",
                             page_of(bench_page::kRecord, bench_page::kTitle, bench_page::write)};
}
