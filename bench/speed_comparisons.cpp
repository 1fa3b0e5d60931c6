#include <fmt/format.h>

#include <filesystem>

#include "bench/sections.hpp"
#include "core/files.hpp"

namespace lobelia::bench {
namespace {

namespace fs = std::filesystem;

/// A question that another program answers, too.
struct Question {
  std::string name;
  std::vector<std::string> theirs, metrics;
  int their_exit_code = 0;
};

void ask_both(const std::string& program, const Question& question, const fs::path& a,
              const fs::path& b) {
  const fs::path found = find_program(question.theirs.front());
  if (found.empty()) {
    fmt::print("{:<34}not on PATH\n", question.name);
    return;
  }
  std::vector<std::string> theirs = question.theirs;
  theirs.front() = found;
  constexpr int kRounds = 7;
  std::vector<double> ours_s, theirs_s, wall, processor;
  for (int round = 0; round < kRounds; ++round) {
    const ProcessResult other = run_process(theirs, {});
    if (other.exit_code != question.their_exit_code) {
      fmt::print(stderr, "{}: exit code {}\n{}\n", found.string(), other.exit_code,
                 other.output_tail);
      std::exit(EXIT_FAILURE);
    }
    const ProcessResult ours = compare(program, a, b, question.metrics);
    ours_s.push_back(ours.seconds);
    theirs_s.push_back(other.seconds);
    wall.push_back(ours.seconds / other.seconds);
    processor.push_back(ours.cpu_seconds / other.cpu_seconds);
  }
  const Times ratio = summary(processor);
  fmt::print("{:<34}{:>8.3f}{:>10.3f}{:>9.2f}{:>17.2f}{:>9.2f} to {:.2f}\n", question.name,
             summary(ours_s).median, summary(theirs_s).median, summary(wall).median, ratio.median,
             ratio.least, ratio.most);
}

}  // namespace

void others(const std::string& program) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name) { return directory.path() / name; };
  render_both_files(program, "head_on", 1920, 1080, file("a"));
  render_both_files(program, "two_lights", 1920, 1080, file("b"));
  fmt::print(
      "\nWhole commands: lobelia compare --metrics beside other programs, 1920 x 1080, medians of 7 pairs "
      "in turn\n");
  fmt::print("{:<34}{:>8}{:>10}{:>9}{:>17}{:>9}\n", "question", "ours s", "theirs s", "ratio",
             "processor ratio", "spread");
  const std::vector<std::string> idiff{"idiff", "-q",   "-fail",     "1e30",
                                       "-warn", "1e30", "-hardfail", "1e30"};
  const auto with = [](std::vector<std::string> command, const fs::path& a, const fs::path& b) {
    command.insert(command.end(), {a, b});
    return command;
  };
  ask_both(program,
           {"idiff, EXR: max_abs,rmse",
            with(idiff, file("a.exr"), file("b.exr")),
            {"--metrics=max_abs,rmse"}},
           file("a.exr"), file("b.exr"));
  ask_both(program,
           {"idiff, PNG: code.max,code.mean",
            with(idiff, file("a.png"), file("b.png")),
            {"--metrics=code"}},
           file("a.png"), file("b.png"));
  // odiff ends with 22 where pictures differ.
  ask_both(program,
           {"odiff, PNG: pixels_over.yiq=0.1",
            {"odiff", file("b.png"), file("a.png")},
            {"--metrics=pixels_over.yiq=0.1"},
            22},
           file("a.png"), file("b.png"));
  ask_both(
      program,
      {"flip, PNG: flip.ldr",
       {"flip", "-r", file("b.png"), "-t", file("a.png"), "-nexm", "-nerm", "-d", directory.path()},
       {"--metrics=flip.ldr", "--exposure=0"}},
      file("a.png"), file("b.png"));
}

void comparisons(const std::string& program) {
  const TemporaryDirectory directory;
  const fs::path a = directory.path() / "a.exr", b = directory.path() / "b.exr";
  fmt::print(
      "\nWhole commands: lobelia compare, all metrics, HDR-FLIP at 3 exposures, all processors\n");
  fmt::print("{:>12}{:>10}{:>14}{:>12}{:>14}{:>12}\n", "size", "s", "processor s", "peak MiB",
             "pictures MiB", "beyond MiB");
  double beyond = 0;
  for (const auto& [width, height] :
       {std::pair{256, 256}, std::pair{1920, 1080}, std::pair{4096, 4096}, std::pair{8192, 8192}}) {
    render_file(program, "head_on", width, height, a);
    render_file(program, "two_lights", width, height, b);
    const ProcessResult command = compare(program, a, b, {"--exposures=-2,2,3"});
    const double peak = double(command.peak_memory_bytes) / (1 << 20);
    const double pictures = 2 * 12.0 * width * height / (1 << 20);
    beyond = peak - pictures;
    fmt::print("{:>12}{:>10.2f}{:>14.2f}{:>12.0f}{:>14.0f}{:>12.0f}\n",
               fmt::format("{} x {}", width, height), command.seconds, command.cpu_seconds, peak,
               pictures, beyond);
  }
  fmt::print("Limit: the two pictures; the largest takes {:.0f} MiB beyond them.\n", beyond);

  fmt::print(
      "\nWhole sets: lobelia compare of two folders, default metrics; median of 3 interleaved rounds\n");
  fmt::print("{:>12}{:>8}{:>10}{:>10}{:>14}{:>14}\n", "size", "pairs", "threads", "s", "pictures/s",
             "Mpixel/s");
  for (const auto& [width, height, pairs] : {std::tuple{256, 256, 64}, std::tuple{1920, 1080, 8}}) {
    const fs::path folder = directory.path() / std::to_string(width);
    for (const auto& [name, scene] : {std::pair{"a", "head_on"}, std::pair{"b", "two_lights"}}) {
      fs::create_directories(folder / name);
      render_file(program, scene, width, height, a);
      for (int i = 0; i < pairs; ++i) fs::copy_file(a, folder / name / fmt::format("{:02}.exr", i));
    }
    std::vector<std::function<void()>> cases;
    for (const char* threads : {"1", "0"})
      cases.push_back([&, threads] {
        compare(program, folder / "a", folder / "b", {"--threads", threads});
      });
    const std::vector<Times> times = interleaved(cases, 3);
    for (std::size_t i = 0; i < cases.size(); ++i)
      fmt::print("{:>12}{:>8}{:>10}{:>10.2f}{:>14.1f}{:>14.1f}\n",
                 fmt::format("{} x {}", width, height), pairs, i == 0 ? "1" : "all",
                 times[i].median, 2 * pairs / times[i].median,
                 2e-6 * pairs * width * height / times[i].median);
  }
}

}  // namespace lobelia::bench
