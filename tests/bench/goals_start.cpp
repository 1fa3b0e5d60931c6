// The start of the program: beside an empty one with the same libraries, and beside POV-Ray's whole command. And the page
// of a grid of 20 000 cells in a browser: tests/bench/gallery.sh measures it once for all its goals.
#include <fmt/format.h>

#include <regex>

#include "base/system/timing.hpp"
#include "lobelia_paths.hpp"
#include "tests/bench/goals.hpp"
#include "tests/bench/inputs.hpp"

namespace lobelia::bench {
namespace {

double seconds_for(const std::vector<std::string>& command, const ProcessOptions& options = {}) {
  constexpr int kRuns = 5;
  std::vector<double> all;
  for (int i = 0; i < kRuns; ++i) {
    const ProcessResult result = run_process(command, options);
    if (result.exit_code != 0)
      throw std::runtime_error(
          fmt::format("{} ends with exit code {}", command[0], result.exit_code));
    all.push_back(result.seconds);
  }
  return summary(all).median;
}

}  // namespace

void add_start_goals(const Tools& tools, Goals& goals) {
  const std::string program = tools.program_text();
  // Neither command loads a module, so this is all that they use. (LD_TRACE_LOADED_OBJECTS would skip relocations and
  // the libraries' own initialisers.)
  const std::vector<std::string> loading{
      std::filesystem::read_symlink("/proc/self/exe").replace_filename("bench_empty").string()};
  const auto render = [=](int side) {
    return render_command(program, "head_on", side, side, tools.scratch / "start.exr");
  };
  const auto add = [&](const std::string& id, const std::string& what,
                       const std::vector<std::string>& command) {
    goals.add({id, what, "s", "an empty program with its libraries", false, 1, 9, 5, [=] {
                 return Round{seconds_for(command), seconds_for(loading)};
               }});
  };
  add("start.version", "lobelia --version", {program, "--version"});
  add("start.render", "lobelia render, 64 x 64", render(64));
  if (find_program("povray").empty()) {
    goals.leave_out("start.whole", "no POV-Ray here");
    return;
  }
  goals.add({"start.whole", "lobelia render, 256 x 256", "s", "POV-Ray's whole command", true, 40,
             9, 5, [=] {
               const std::filesystem::path place = tools.scratch / "whole.in";
               if (!std::filesystem::exists(place))
                 run({program, "reference", scene_file("head_on"), "--engine", "povray", "-q", "-o",
                      tools.scratch / "whole.exr", "--keep-input", place, "--width", "256",
                      "--height", "256"});
               ProcessOptions there;
               there.working_directory = place;
               return Round{seconds_for(render(256)), seconds_for({"/bin/sh", "povray.sh"}, there)};
             }});
}

namespace {

/// The figure and its limit from a line such as "usable after   1.25 s   3 s  met".
Round figure_in(const std::string& output, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(output, found, std::regex("\n" + name + R"( +([0-9.]+) \S* +([0-9.]+) )")))
    throw std::runtime_error("tests/bench/gallery.sh tells no '" + name + "': " + output);
  const Round round{std::stod(found[1]), std::stod(found[2])};
  // The browser's processes may be gone before their memory is looked at.
  if (round.ours <= 0) throw std::runtime_error("tests/bench/gallery.sh could not measure " + name);
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
    goals.add(
        {fmt::format("gallery.{}", one.id), fmt::format("20 000 cells: {}", one.name), one.unit,
         "what is allowed", false, 1, 1, 0, [=, program = tools.program_text()] {
           if (output->empty())
             *output = run({LOBELIA_SOURCE_DIR "/tests/bench/gallery.sh", program}).output_tail;
           return figure_in(*output, one.name);
         }});
}

}  // namespace lobelia::bench
