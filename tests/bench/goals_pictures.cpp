// Kernels beside POV-Ray's tracing, and on several threads.
#include <fmt/format.h>
#include <hwy/highway.h>
#include <oneapi/tbb/info.h>

#include <regex>

#include "base/system/files.hpp"
#include "base/system/timing.hpp"
#include "renderer/fused.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/bench/goals.hpp"
#include "tests/bench/inputs.hpp"

namespace lobelia::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 1024;

struct InstructionSet {
  const char *name, *title;
  std::int64_t targets;
};
constexpr InstructionSet kSets[] = {{"avx2", "AVX2", HWY_AVX2 | HWY_SSSE3},
                                    {"avx512", "AVX-512", HWY_AVX3 | HWY_AVX2 | HWY_SSSE3}};

Scene head_on(int side) {
  Scene scene = read_scene(scene_file("head_on"));
  scene.film.width = scene.film.height = side;
  return scene;
}

/// One picture by one thread into memory that was used before.
class OneThread {
 public:
  OneThread(const Scene& scene, std::int64_t targets) : image_(kSide, kSide) {
    hwy::SetSupportedTargetsForTest(targets);
    renderer_ =
        std::make_unique<FusedRenderer>(scene, make_plan(scene, EffectPolicy::kAsCalledFor));
    hwy::SetSupportedTargetsForTest(0);
  }
  double seconds() {
    return warm_seconds([&] { renderer_->render_rows(0, kSide, image_.values().data()); });
  }

 private:
  std::unique_ptr<FusedRenderer> renderer_;
  Image image_;
};

/// The "Trace Time" of POV-Ray's statistics, for the same picture by one thread.
class PovRayTrace {
 public:
  PovRayTrace(const Tools& tools, const Scene& scene) : input_(tools.scratch / "povray.in") {
    const fs::path file = tools.scratch / "povray.xml";
    write_file(file, scene_to_xml(scene));
    run({tools.program_text(), "reference", file, "--engine", "povray", "--threads", "1", "-q",
         "-o", tools.scratch / "povray.exr", "--keep-input", input_});
    for (const fs::directory_entry& entry : fs::directory_iterator(input_))
      if (entry.path().extension() == ".ini") {
        const std::string text = read_file(entry.path(), 1 << 20);
        write_file(entry.path(), std::regex_replace(text, std::regex("Statistic_Console=off"),
                                                    "Statistic_Console=on"));
      }
  }
  double seconds() const {
    ProcessOptions options;
    options.working_directory = input_;
    const ProcessResult result = run_process({"/bin/sh", "povray.sh"}, options);
    std::smatch found;
    if (result.exit_code != 0 ||
        !std::regex_search(result.output_tail, found,
                           std::regex(R"(Trace Time:.*\(([0-9.]+) seconds\))")))
      throw std::runtime_error("POV-Ray tells no time of tracing");
    return std::stod(found[1]);
  }

 private:
  fs::path input_;
};

}  // namespace

void add_kernel_goals(const Tools& tools, Goals& goals) {
  if (find_program("povray").empty()) {
    goals.leave_out("kernel", "no POV-Ray here");
    return;
  }
  const Scene scene = head_on(kSide);
  const auto povray = std::make_shared<PovRayTrace>(tools, scene);
  for (const InstructionSet& set : kSets) {
    const std::string id = fmt::format("kernel.{}.cosine", set.name);
    if (!(hwy::SupportedTargets() & set.targets & -set.targets & (HWY_AVX2 | HWY_AVX3))) {
      goals.leave_out(id, "this processor does not have it");
      continue;
    }
    const auto ours = std::make_shared<OneThread>(scene, set.targets);
    goals.add({id, fmt::format("head-on, cosⁿ, 1024 x 1024, {}", set.title), "s",
               "POV-Ray's tracing", true, 100, 5, 3, [=] {
                 return Round{ours->seconds(), povray->seconds()};
               }});
  }
}

void add_thread_goals(const Tools&, Goals& goals) {
  const int processors = oneapi::tbb::info::default_concurrency();
  for (const int side : {1024, 4096}) {
    const auto scene = std::make_shared<Scene>(head_on(side));
    // Every pixel of the disc is computed.
    scene->materials[0].diffuse_reflectance = {0.5, 0.5, 0.5};
    // The least of three, as a thread that sleeps may begin milliseconds late.
    const auto seconds = [scene](int threads) {
      RenderOptions options;
      options.threads = threads;
      return least_seconds(3, [&] { return render(*scene, options).render_seconds; });
    };
    // Untimed: pictures that come after other goals pay for memory and threads that the next ones find.
    const auto warm_up = [=] {
      for (const int threads : {1, processors}) seconds(threads);
    };
    goals.add({fmt::format("threads.{}", side),
               fmt::format("{0} threads, {1} x {1}, times their number", processors, side), "s",
               "one thread", true, 0.93, 15, 7, [=] {
                 warm_up();
                 const double one = seconds(1);
                 return Round{processors * seconds(processors), one};
               }});
  }
}

}  // namespace lobelia::bench
