// bench_paired OLD NEW [--only TEXT]... [--rounds N]
//
// Runs commands with two builds of the program in turn, and says what became slower or faster by more than its noise.
// Exit code 1: something became slower.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/system/files.hpp"
#include "base/system/timing.hpp"
#include "tests/bench/inputs.hpp"
#include "tests/bench/paired_times.hpp"

namespace lobelia::bench {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<double> old_times, new_times;
};

Case without_program(const char* name, std::vector<std::string> command) {
  command.erase(command.begin());
  return {name, std::move(command), {}, {}};
}

std::vector<Case> cases_in(const fs::path& scratch, const std::string& program) {
  const auto picture = [&](const char* name, std::string_view scene, int side,
                           const char* threads) {
    std::vector<std::string> command =
        render_command(program, scene, side, side, scratch / "out.exr");
    command.insert(command.end(), {"--threads", threads});
    return without_program(name, std::move(command));
  };
  const fs::path a = scratch / "a.exr", b = scratch / "b.exr";
  render_file(program, "head_on", 1024, 1024, a);
  render_file(program, "two_lights", 1024, 1024, b);
  const auto pictures = [&](const char* name, const char* metrics) {
    return without_program(name, comparison(program, a, b, {"--metrics", metrics}));
  };
  write_file(scratch / "grid.xml", grid_of_models(2000));
  return {{"start", {"--version"}, {}, {}},
          picture("one small picture", "head_on", 64, "0"),
          picture("one large picture, one thread", "head_on", 2048, "1"),
          picture("one large picture", "head_on", 2048, "0"),
          picture("several lights", "two_lights", 1024, "1"),
          picture("slanted view", "oblique_45", 1024, "1"),
          pictures("comparison, cheap metrics", "max_abs"),
          pictures("comparison, all metrics", "all"),
          {"plan of 20 000 cells",
           {"farm", scratch / "grid.xml", "--dry-run", "-q", "-o", scratch / "plan"},
           {},
           {}}};
}

double seconds_of(const std::string& program, const Case& one) {
  std::vector<std::string> command{program};
  command.insert(command.end(), one.arguments.begin(), one.arguments.end());
  return run(command).seconds;
}

const char* word_of(PairedChange::Verdict verdict) {
  switch (verdict) {
    case PairedChange::Verdict::kSlower:
      return "slower";
    case PairedChange::Verdict::kFaster:
      return "faster";
    case PairedChange::Verdict::kNoneFound:
      break;
  }
  return "no change found";
}

int run_pairs(int count, char** arguments) {
  CLI::App app{"Says what became slower or faster from one build of lobelia to another"};
  std::string old_program, new_program;
  std::vector<std::string> only;
  int rounds = 21;
  app.add_option("OLD", old_program, "A program")->required()->check(CLI::ExistingFile);
  app.add_option("NEW", new_program, "Another")->required()->check(CLI::ExistingFile);
  app.add_option("--only", only, "Cases with this in their name")->allow_extra_args(false);
  app.add_option("--rounds", rounds, "How often each runs")
      ->check(CLI::Range(int(kLeastPairs), 1000));
  CLI11_PARSE(app, count, arguments);
  for (std::string* program : {&old_program, &new_program}) *program = fs::absolute(*program);
  const TemporaryDirectory scratch;
  std::vector<Case> cases = cases_in(scratch.path(), new_program);
  std::erase_if(cases, [&](const Case& one) {
    return !only.empty() && std::ranges::none_of(only, [&](const std::string& text) {
      return one.name.find(text) != one.name.npos;
    });
  });
  // One round to warm up; then who begins changes from round to round.
  for (int round = -1; round < rounds; ++round)
    for (Case& one : cases) {
      const bool old_first = round % 2 == 0;
      const double first = seconds_of(old_first ? old_program : new_program, one);
      const double second = seconds_of(old_first ? new_program : old_program, one);
      if (round < 0) continue;
      one.old_times.push_back(old_first ? first : second);
      one.new_times.push_back(old_first ? second : first);
    }
  fmt::print("{:<34}{:>10}{:>10}{:>8}  its bounds\n", "what", "old, ms", "new, ms", "ratio");
  bool is_slower = false;
  for (const Case& one : cases) {
    const PairedChange change = paired_change(one.old_times, one.new_times);
    is_slower |= change.verdict == PairedChange::Verdict::kSlower;
    fmt::print("{:<34}{:>10.2f}{:>10.2f}{:>8.3f}  {:<20}{}\n", one.name,
               1e3 * summary(one.old_times).median, 1e3 * summary(one.new_times).median,
               change.ratio, fmt::format("{:.3f} to {:.3f}", change.least, change.most),
               word_of(change.verdict));
  }
  fmt::print("New over old, medians of {} pairs; a change counts if 1 is outside of the bounds.\n",
             rounds);
  return is_slower ? 1 : 0;
}

}  // namespace
}  // namespace lobelia::bench

int main(int count, char** arguments) try {
  return lobelia::bench::run_pairs(count, arguments);
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_paired: {}\n", error.what());
  return 3;
}
