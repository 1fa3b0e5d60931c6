// The benchmarks of `lobelia cost`: from one evaluation of a lobe to light transport.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "studies/cost/table.hpp"

namespace lobelia::cost {

struct NamedScene {
  std::string name;  ///< its file's name without ending: part of a table's id
  Scene scene;
};

/// How long to measure: for a first impression, a report, or a paper.
enum class Effort { kQuick, kUsual, kThorough };

struct Options {
  std::vector<NamedScene> scenes;
  Effort effort = Effort::kUsual;
  /// Programs of engines by the engine's name; engines without one are found in $PATH.
  std::map<std::string, std::filesystem::path> programs;
  /// Gets the share of all that is done.
  std::function<void(double done, const std::string& what)> on_progress;
  double done = 0;
  std::string_view level;

  void progress(const std::string& what) const {
    if (on_progress) on_progress(done, std::string(level) + ": " + what);
  }
  int rounds(int quick, int usual, int thorough) const {
    return effort == Effort::kQuick ? quick : effort == Effort::kUsual ? usual : thorough;
  }
};

/// Each is in NAME_benchmark.cpp and has a line in benchmarks.cpp.
struct Benchmark {
  std::string_view name;     ///< as on the command line and in Table::level
  std::string_view meaning;  ///< for --help
  bool needs_scenes;         ///< measures only the scenes that were given
  std::vector<Table> (*measure)(const Options& options);
};

std::span<const Benchmark> benchmarks();
/// Those of these names, or without names all that have something to measure. Throws Error(kUsage) for one that needs
/// scenes.
std::vector<const Benchmark*> chosen_benchmarks(const std::vector<std::string>& names,
                                                bool has_scenes);
/// The tables of each, with their fronts.
records::Cost measure(const std::vector<const Benchmark*>& chosen, Options options,
                      std::vector<std::string> command);

/// One table per exponent, "lobe-n64", and those of half floats (half_floats.hpp).
std::vector<Table> measure_lobes(const Options& options);
/// The table of one exponent; times are medians of so many rounds. A quick one evaluates 2^20 numbers to find the
/// largest error of a variant, and may then give only a bracket of it.
Table lobe_table(double exponent, int rounds, bool quick);

/// One table per scene, by lobe and precision, rendered by one thread.
std::vector<Table> measure_pictures(const Options& options);

/// The built-in scenes.
std::vector<Table> measure_transport(const Options& options);

}  // namespace lobelia::cost
