// Comparing pictures beside reading them, beside NVIDIA's FLIP, and many pairs at once.
#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <stdexcept>

#include "base/system/files.hpp"
#include "tests/bench/goals.hpp"
#include "tests/bench/inputs.hpp"

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

/// Processor time of measuring with `options` on one thread, less that of reading the pictures. The least of a few runs
/// each, as reading takes longer than what is measured.
double without_reading(const Tools& tools, const Pair& pair, std::vector<std::string> options) {
  options.insert(options.end(), {"--threads", "1"});
  double both = 1e30, reading = 1e30;
  for (int i = 0; i < 3; ++i) {
    both = std::min(both, compare_pair(tools, pair, options).cpu_seconds);
    reading = std::min(
        reading, compare_pair(tools, pair, {"--metrics=max_abs", "--threads", "1"}).cpu_seconds);
  }
  return both - reading;
}

/// Processor time of the evaluation in NVIDIA's tool, on one thread: without the wall time that the rest took.
double tool_evaluation(const std::filesystem::path& flip, const Pair& pair,
                       const std::filesystem::path& scratch) {
  const ProcessResult result = run({find_program("env"), "OMP_NUM_THREADS=1", flip, "-r", pair.b,
                                    "-t", pair.a, "-nexm", "-nerm", "-d", scratch});
  const std::string name = "Evaluation time: ";
  const std::size_t at = result.output_tail.find(name);
  if (at == std::string::npos) throw std::runtime_error("flip prints no evaluation time");
  const double evaluation = std::stod(result.output_tail.substr(at + name.size()));
  return result.cpu_seconds - (result.seconds - evaluation);
}

}  // namespace

void add_comparison_goals(const Tools& tools, Goals& goals) {
  const auto hd = std::make_shared<Pair>(rendered(tools, "hd", 1920, 1080, "exr"));
  goals.add({"compare.all_metrics", "all metrics of 1920 x 1080", "s",
             "max_abs alone, which reads them", false, 2, 7, 3, [=] {
               return Round{compare_pair(tools, *hd, {"--metrics=all"}).seconds,
                            compare_pair(tools, *hd, {"--metrics=max_abs"}).seconds};
             }});
  goals.add({"compare.all_metrics_openimageio", "all metrics of 1920 x 1080", "s",
             "max_abs alone, read by OpenImageIO", false, 2, 7, 3, [=] {
               return Round{
                   compare_pair(tools, *hd, {"--metrics=all"}).seconds,
                   compare_pair(tools, *hd, {"--metrics=max_abs", "--any-format"}).seconds};
             }});
  goals.add({"compare.memory", "all metrics of 7680 x 4320: memory", "GiB", "1/8 GiB", false, 1, 1,
             0, [=] {
               const Pair large = rendered(tools, "8k", 7680, 4320, "exr");
               const ProcessResult result = compare_pair(tools, large, {"--metrics=all"});
               return Round{double(result.peak_memory_bytes) / (1 << 30), 0.125};
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
    goals.add({id,
               fmt::format("{} of 1920 x 1080, one thread, without reading",
                           is_hdr ? "HDR-FLIP" : "LDR-FLIP"),
               "s", "NVIDIA's FLIP, its evaluation", true, 12, 7, 3, [=] {
                 // Without exposures HDR-FLIP is not measured. The tool chooses its own, as auto does.
                 using Options = std::vector<std::string>;
                 const auto options = is_hdr ? Options{"--metrics=flip.hdr", "--exposures", "auto"}
                                             : Options{"--metrics=flip.ldr"};
                 return Round{without_reading(tools, *pair, options),
                              tool_evaluation(flip, *pair, tools.scratch)};
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
