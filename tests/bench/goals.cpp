// bench_goals LOBELIA [--quick] [--only TEXT]... [--rounds N] [--commit NAME] [--committed DAY] [--keep RECORD]
//
// Measures every goal in rounds. Each round measures each goal once, ours beside the other, so that a change of the
// machine's speed affects all alike.
#include "tests/bench/goals.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/records/bench.hpp"
#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/timing.hpp"
#include "base/words/error_time_chart.hpp"
#include "base/words/text.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia::bench {
namespace {

struct Measured {
  const Goal* goal;
  std::vector<double> ours, other, ratios;
  std::string failure;

  void measure() {
    if (!failure.empty()) return;
    try {
      const Round round = goal->measure();
      ours.push_back(round.ours);
      other.push_back(round.other);
      ratios.push_back(goal->at_least ? round.other / round.ours : round.ours / round.other);
    } catch (const std::exception& error) {
      failure = error.what();
    }
  }

  records::BenchGoal record() const {
    records::BenchGoal made;
    made.id = goal->id;
    made.what = goal->what;
    made.unit = goal->unit;
    made.against = goal->against;
    made.ours = records::rounds_record(summary(ours));
    made.other = records::rounds_record(summary(other));
    made.ratio = records::rounds_record(summary(ratios));
    made.goal = goal->goal;
    made.at_least = goal->at_least;
    made.met = goal->at_least ? made.ratio.median >= goal->goal : made.ratio.median <= goal->goal;
    return made;
  }
};

void print(const records::BenchRun& bench) {
  const auto padded = [](const std::string& text, std::size_t width) {
    return fmt::format("{:<{}}", text, width);
  };
  fmt::print("{}, {} threads, {}{}\n", bench.host.processor, bench.host.threads,
             bench.instruction_set, bench.commit.empty() ? "" : ", commit " + bench.commit);
  fmt::print("{}{:>10}  {}{:>10}{:>9}{:>8}{:>9}\n", padded("what", 46), "ours",
             padded("held to", 42), "its", "ratio", "spread", "goal");
  std::size_t met = 0;
  for (const records::BenchGoal& goal : bench.goals) {
    met += goal.met;
    fmt::print("{}{:>10}  {}{:>10}{:>9.3g}{:>7.0f}%{:>9}  {}\n", padded(goal.what, 46),
               quantity_text(goal.ours.median, goal.unit), padded(goal.against, 42),
               quantity_text(goal.other.median, goal.unit), goal.ratio.median,
               100 * goal.ratio.spread,
               fmt::format("{} {:g}", goal.at_least ? ">=" : "<=", goal.goal),
               goal.met ? "met" : "not met");
  }
  for (const auto& [id, why] : bench.left_out) fmt::print("{}: not measured: {}\n", id, why);
  fmt::print("{} of {} goals are met. Medians; the spread is half the distance of the quartiles.\n",
             met, bench.goals.size());
}

struct Room {
  std::string_view name;  ///< its goals begin with it
  void (*add)(const Tools& tools, Goals& goals);
};
constexpr Room kRooms[] = {{"kernel", add_kernel_goals},      {"threads", add_thread_goals},
                           {"light", add_light_goals},        {"scale", add_scale_goals},
                           {"compare", add_comparison_goals}, {"start", add_start_goals},
                           {"gallery", add_gallery_goals}};

int run(int count, char** arguments) {
  CLI::App app{"Measures the goals of speed"};
  Tools tools;
  std::string program, keep;
  records::BenchRun bench;
  std::vector<std::string> only;
  int rounds = 0;
  app.add_option("LOBELIA", program, "The program")->required()->check(CLI::ExistingFile);
  app.add_flag("--quick", tools.quick, "Fewer rounds, and without what takes minutes");
  app.add_option("--only", only, "Goals whose id begins with this")->allow_extra_args(false);
  app.add_option("--rounds", rounds, "In place of each goal's own");
  app.add_option("--commit", bench.commit, "Name of the source's commit, for the record");
  app.add_option("--committed", bench.committed, "Its day");
  app.add_option("--keep", keep, "A record that this run is added to");
  CLI11_PARSE(app, count, arguments);
  tools.program = std::filesystem::absolute(program);
  const TemporaryDirectory scratch;
  tools.scratch = scratch.path();

  const auto is_wanted = [&](std::string_view id) {
    return only.empty() ||
           std::ranges::any_of(only, [&](const std::string& text) { return id.starts_with(text); });
  };
  // Before the rooms, which try other instruction sets.
  bench.instruction_set = kernels().instruction_set;
  Goals goals;
  for (const Room& room : kRooms)
    // Others are not added, because their scenes and pictures take seconds to make.
    if (is_wanted(room.name) || std::ranges::any_of(only, [&](const std::string& text) {
          return text.starts_with(room.name);
        }))
      room.add(tools, goals);
  bench.quick = tools.quick;
  bench.host = records::this_host();
  records::Bench kept;
  if (!keep.empty() && std::filesystem::exists(keep))
    kept = records::read_record<records::Bench>(keep);
  std::vector<Measured> all;
  for (const Goal& goal : goals.all)
    if (is_wanted(goal.id))
      all.push_back({.goal = &goal, .ours = {}, .other = {}, .ratios = {}, .failure = {}});
  const auto rounds_of = [&](const Measured& one) {
    const int own = tools.quick ? one.goal->quick_rounds : one.goal->rounds;
    return rounds > 0 ? std::min(rounds, std::max(1, own)) : own;
  };
  int most = 0;
  for (const Measured& one : all) most = std::max(most, rounds_of(one));
  for (int round = 0; round < most; ++round)
    for (Measured& one : all)
      if (round < rounds_of(one)) {
        fmt::print(stderr, "round {} of {}: {}\n", round + 1, rounds_of(one), one.goal->id);
        one.measure();
      }
  for (const Measured& one : all)
    if (!one.failure.empty())
      bench.left_out.emplace_back(one.goal->id, one.failure);
    else if (one.ratios.empty())
      bench.left_out.emplace_back(one.goal->id, "a quick run leaves it out");
    else
      bench.goals.push_back(one.record());
  for (const auto& [id, why] : goals.left_out)
    if (is_wanted(id)) bench.left_out.emplace_back(id, why);
  print(bench);
  if (keep.empty()) return EXIT_SUCCESS;
  kept.runs.push_back(std::move(bench));
  std::filesystem::create_directories(std::filesystem::absolute(keep).parent_path());
  records::write_record(keep, kept);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace lobelia::bench

int main(int count, char** arguments) try {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // someone may watch through a pipe
  return lobelia::bench::run(count, arguments);
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_goals: {}\n", error.what());
  return EXIT_FAILURE;
}
