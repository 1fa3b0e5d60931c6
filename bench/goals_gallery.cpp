// The page of a grid of 20 000 cells in a browser: bench/gallery.sh measures it once for all its goals.
#include <fmt/format.h>

#include <regex>

#include "bench/goals.hpp"
#include "bench/inputs.hpp"
#include "core/timing.hpp"
#include "lobelia_paths.hpp"

namespace lobelia::bench {
namespace {

/// The figure and its limit from a line such as "usable after   1.25 s   3 s  met".
Round figure_in(const std::string& output, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(output, found, std::regex("\n" + name + R"( +([0-9.]+) \S* +([0-9.]+) )")))
    throw std::runtime_error("bench/gallery.sh tells no '" + name + "': " + output);
  const Round round{std::stod(found[1]), std::stod(found[2])};
  // The browser's processes may be gone before their memory is looked at.
  if (round.ours <= 0) throw std::runtime_error("bench/gallery.sh could not measure " + name);
  return round;
}

}  // namespace

void add_gallery_goals(const Tools& tools, Goals& goals) {
  if (find_program("node").empty() || find_program("chromium").empty()) {
    goals.leave_out("gallery", "no Node.js or no Chromium here");
    return;
  }
  struct Figure {
    const char *id, *name, *unit;
  };
  const auto output = std::make_shared<std::string>();
  for (const Figure& one : {Figure{"files", "files", ""},
                            {"size", "size of the site", "MB"},
                            {"usable", "usable after", "s"},
                            {"find", "Find, slowest query, median of 5", "ms"},
                            {"memory", "memory: page and growth", "MB"}})
    goals.add({fmt::format("gallery.{}", one.id), fmt::format("20 000 cells: {}", one.name),
               one.unit, "what is allowed", false, 1, 1, 0, [=, program = tools.program_text()] {
                 if (output->empty())
                   *output = run({LOBELIA_SOURCE_DIR "/bench/gallery.sh", program}).output_tail;
                 return figure_in(*output, one.name);
               }});
}

}  // namespace lobelia::bench
