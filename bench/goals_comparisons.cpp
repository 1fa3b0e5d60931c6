// Comparing pictures beside reading them, beside NVIDIA's FLIP, and many pairs at once.
#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include "bench/goals.hpp"
#include "bench/inputs.hpp"
#include "core/files.hpp"

namespace lobelia::bench {
namespace {

namespace fs = std::filesystem;

struct Pair {
  fs::path a, b;
};

Pair rendered(const Tools& tools, const std::string& name, int width, int height,
              const std::string& ending) {
  Pair pair{tools.scratch / (name + "_a." + ending), tools.scratch / (name + "_b." + ending)};
  render_both_files(tools.program_text(), "head_on", width, height, pair.a);
  render_both_files(tools.program_text(), "two_lights", width, height, pair.b);
  return pair;
}

ProcessResult compare_pair(const Tools& tools, const Pair& pair,
                           const std::vector<std::string>& more) {
  return compare(tools.program_text(), pair.a, pair.b, more);
}

}  // namespace

void add_comparison_goals(const Tools& tools, Goals& goals) {
  const auto hd = std::make_shared<Pair>(rendered(tools, "hd", 1920, 1080, "exr"));
  goals.add({"compare.all_metrics", "all metrics of 1920 x 1080", "s",
             "max_abs alone, which reads them", false, 2, 7, 3, [=] {
               return Round{compare_pair(tools, *hd, {"--metrics=all"}).seconds,
                            compare_pair(tools, *hd, {"--metrics=max_abs"}).seconds};
             }});
  const fs::path flip = find_program("flip");
  for (const bool is_hdr : {false, true}) {
    const std::string id = is_hdr ? "compare.flip.hdr" : "compare.flip.ldr";
    if (flip.empty()) {
      goals.leave_out(id, "no program 'flip' on PATH: NVIDIA's tool, built from its source");
      continue;
    }
    const auto pair =
        is_hdr ? hd : std::make_shared<Pair>(rendered(tools, "flip", 1920, 1080, "png"));
    goals.add({id, fmt::format("{} of 1920 x 1080, one thread", is_hdr ? "HDR-FLIP" : "LDR-FLIP"),
               "s", "NVIDIA's FLIP, its processor time", true, 12, 7, 3, [=] {
                 const ProcessResult theirs = run(
                     {flip, "-r", pair->b, "-t", pair->a, "-nexm", "-nerm", "-d", tools.scratch});
                 std::vector<std::string> options{"--metrics=flip.ldr", "--threads", "1"};
                 // Without exposures HDR-FLIP is not measured. The tool chooses its own, as auto does.
                 if (is_hdr)
                   options = {"--metrics=flip.hdr", "--exposures", "auto", "--threads", "1"};
                 const ProcessResult ours = compare_pair(tools, *pair, options);
                 return Round{ours.cpu_seconds, theirs.cpu_seconds};
               }});
  }
  const int processors = oneapi::tbb::info::default_concurrency();
  goals.add({"compare.folder", "1000 pairs of 256 x 256, wall time", "s",
             "the processors' time, divided among them", true, 0.95, 3, 1, [=] {
               const fs::path folder = tools.scratch / "folder";
               if (!fs::exists(folder)) {
                 const Pair one = rendered(tools, "small", 256, 256, "exr");
                 for (const auto& [name, file] : {std::pair{"a", one.a}, {"b", one.b}}) {
                   fs::create_directories(folder / name);
                   for (int i = 0; i < 1000; ++i)
                     fs::copy_file(file, folder / name / fmt::format("{:04}.exr", i));
                 }
               }
               const ProcessResult all = compare_pair(tools, {folder / "a", folder / "b"}, {});
               return Round{all.seconds, all.cpu_seconds / processors};
             }});
}

}  // namespace lobelia::bench
