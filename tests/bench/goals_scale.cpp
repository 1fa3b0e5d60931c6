// The goals of scale: crowds of spheres, large pictures and large grids.
#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <array>
#include <cmath>

#include "base/records/record.hpp"
#include "base/records/render.hpp"
#include "base/system/files.hpp"
#include "base/system/timing.hpp"
#include "renderer/render.hpp"
#include "tests/bench/goals.hpp"
#include "tests/bench/inputs.hpp"

namespace lobelia::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kCrowdSide = 256, kTinyCells = 1000;

/// Crowds of 1e3, 1e5 and 4e6 spheres: what a camera ray costs more from the second to the third, and from the first to
/// the second times `expected`.
Round crowd_growth(CrowdKind kind, double (*expected)(double)) {
  std::vector<double> seconds, growth;
  for (const auto& lattice : {std::array{10, 10, 10}, {50, 50, 40}, {200, 200, 100}}) {
    Scene scene = crowd(kind, lattice, kCrowdSide);
    scene.sampler.sample_count = 16;
    std::uint64_t rays = 1;
    const double least = least_seconds(3, [&] {
      const RenderResult result = render(scene, {});
      rays = result.work.camera_rays;
      return result.render_seconds - result.build_seconds;
    });
    seconds.push_back(least / double(rays));
    growth.push_back(expected(double(scene.spheres.size())));
  }
  return {seconds[2] - seconds[1],
          (seconds[1] - seconds[0]) * (growth[2] - growth[1]) / (growth[1] - growth[0])};
}

/// A farm of a thousand tiny cells into a new directory, from nothing.
ProcessResult tiny_farm(const Tools& tools, const fs::path& out) {
  std::string text = grid_of_models(kTinyCells / 10);
  text.insert(text.find("<axis"), "<film width=\"8\" height=\"8\"/>");
  write_file(tools.scratch / "tiny.xml", text);
  return run({tools.program_text(), "farm", tools.scratch / "tiny.xml", "-q", "-o", out});
}

/// Seconds in which the farm's engine and renderer made pictures, by their records, on all threads together.
double picture_seconds(const fs::path& out) {
  double sum = 0;
  for (const fs::directory_entry& cell : fs::directory_iterator(out / "cells")) {
    sum += records::read_record<records::Render>(cell.path() / "lobelia.json").seconds.total;
    sum += records::read_record<records::Reference>(cell.path() / "analytic.json").seconds.total;
  }
  return sum;
}

}  // namespace

void add_scale_goals(const Tools& tools, Goals& goals) {
  const auto add_crowd = [&](std::string id, std::string what, std::string against, double goal,
                             CrowdKind kind, double (*expected)(double)) {
    goals.add({std::move(id), std::move(what), "s", std::move(against), false, goal, 5, 0,
               [=] { return crowd_growth(kind, expected); }});
  };
  add_crowd("scale.crowd", "packed: a ray's growth, 1e5 to 4e6 spheres",
            "that of a logarithm, by 1e3 to 1e5", 1.5, CrowdKind::kPacked, std::log);
  // Its hierarchy of some 460 MB is many times the last cache, which the cube root does not know.
  add_crowd("scale.thin_crowd", "thin: a ray's growth, 1e5 to 4e6 spheres",
            "that of the cube root, by 1e3 to 1e5", 2.5, CrowdKind::kThin, std::cbrt);
  const std::string program = tools.program_text();
  goals.add({"scale.large_picture", "lobelia render, 16384 x 16384: memory", "GiB", "1 GiB", false,
             1, 1, 0, [=] {
               const ProcessResult result =
                   render_file(program, "head_on", 16384, 16384, tools.scratch / "large.exr");
               return Round{double(result.peak_memory_bytes) / (1 << 30), 1};
             }});
  const int cells = tools.quick ? 15000 : 150000;
  goals.add({"scale.plan", fmt::format("lobelia farm --dry-run of {} cells", cells), "s",
             fmt::format("{:g} s", cells / 15000.0), false, 1, 3, 3, [=] {
               const fs::path grid = tools.scratch / "large.xml";
               // No axis has more than 10000 values.
               const bool halved = cells > 100000;
               write_file(grid,
                          grid_of_models(cells / (halved ? 20 : 10),
                                         halved ? "<axis name=\"size\" values=\"64, 96\"/>" : ""));
               const ProcessResult result =
                   run({program, "farm", grid, "--dry-run", "-q", "-o", tools.scratch / "plan"});
               return Round{result.seconds, cells / 15000.0};
             }});
  const int processors = oneapi::tbb::info::default_concurrency();
  goals.add({"scale.own_cost",
             fmt::format("a farm of {} tiny cells: own time a result", kTinyCells), "s", "1 ms",
             false, 1, 3, 1, [=, farms = 0]() mutable {
               const fs::path out = tools.scratch / fmt::format("tiny_{}", ++farms);
               const ProcessResult farm = tiny_farm(tools, out);
               // The formulas integrate a coefficient to 50 digits for each cell, which is no cost of the farm. A cell has
               // four results: two pictures, a comparison and a profile.
               return Round{(farm.seconds - picture_seconds(out) / processors) / (4.0 * kTinyCells),
                            1e-3};
             }});
  goals.add({"scale.status", fmt::format("lobelia farm status of {} cells", kTinyCells), "s", "1 s",
             false, 1, 3, 1, [=] {
               const fs::path out = tools.scratch / "looked_at";
               if (!fs::exists(out)) tiny_farm(tools, out);
               return Round{run({program, "farm", "status", out}).seconds, 1};
             }});
}

}  // namespace lobelia::bench
