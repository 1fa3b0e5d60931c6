// The benchmarks of `lobelia cost`: from one evaluation of a lobe to a whole program.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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
  std::vector<std::pair<std::string, std::string>> programs;
  std::function<void(const std::string& what)> on_progress;

  void progress(const std::string& what) const {
    if (on_progress) on_progress(what);
  }
  int rounds(int quick, int usual, int thorough) const {
    return effort == Effort::kQuick ? quick : effort == Effort::kUsual ? usual : thorough;
  }
  /// Empty if none was named for that engine. "lobelia" is the running program.
  std::filesystem::path program(std::string_view engine) const;
};

/// Each is in NAME_benchmark.cpp and has a line in benchmarks.cpp.
struct Benchmark {
  std::string_view name;     ///< as on the command line and in Table::level
  std::string_view meaning;  ///< for --help
  bool needs_scenes;         ///< measures only the scenes that were given
  std::vector<Table> (*measure)(const Options& options);
};

std::span<const Benchmark> benchmarks();

/// One table per exponent, "lobe-n64", and those of half floats (half_floats.hpp).
std::vector<Table> measure_lobes(const Options& options);
/// The table of one exponent; times are medians of so many rounds. A quick one evaluates 2^20 numbers to find the
/// largest error of a variant, and may then give only a bracket of it.
Table lobe_table(double exponent, int rounds, bool quick);

/// One table per scene, by lobe and precision, rendered by one thread.
std::vector<Table> measure_pictures(const Options& options);

/// The built-in scenes, and the given ones that has_transport().
std::vector<Table> measure_transport(const Options& options);
/// Whether the scene has light to sample at random: area lights, a sky, a lens or inter-reflection.
bool has_transport(const Scene& scene);

/// Each given scene with one ray a pixel, by our program and by every available engine that supports it.
std::vector<Table> measure_engines(const Options& options);

/// Each given scene, else everything(): a variant with all effects, and one without each effect that is on.
std::vector<Table> measure_effects(const Options& options);

}  // namespace lobelia::cost
