// The levels at which accuracy costs time: from one evaluation of a lobe to a whole program.
#pragma once

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
  std::string name;  ///< its file's, without ending: part of a table's id
  Scene scene;
};

/// How long to measure: a look, what a report is made with, or what a paper wants.
enum class Effort { kQuick, kUsual, kThorough };

struct Options {
  std::vector<NamedScene> scenes;
  Effort effort = Effort::kUsual;
  std::vector<std::pair<std::string, std::string>>
      programs;  ///< of engines, by name; else by $PATH
  std::function<void(const std::string& what)> on_progress;

  void progress(const std::string& what) const {
    if (on_progress) on_progress(what);
  }
  int rounds(int quick, int usual, int thorough) const {
    return effort == Effort::kQuick ? quick : effort == Effort::kUsual ? usual : thorough;
  }
};

/// Each is a file of its own and a line in levels.cpp.
struct Benchmark {
  std::string_view name;     ///< as on the command line and in Table::level
  std::string_view meaning;  ///< for --help
  bool needs_scenes;         ///< it measures the scenes that were given, and is nothing without one
  std::vector<Table> (*measure)(const Options& options);
};

std::span<const Benchmark> benchmarks();

}  // namespace lobelia::cost
