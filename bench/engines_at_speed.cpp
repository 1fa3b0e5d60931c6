// The load of the processors while an engine renders many small pictures: bench_engines ENGINE [PROCESSES [COUNT]].
#include <fmt/format.h>
#include <sys/resource.h>

#include <atomic>
#include <thread>

#include "core/at_once.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "core/timing.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::bench {
namespace {

/// Processor seconds of all children that have ended.
double children_cpu() {
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

int argument(int argc, char** argv, int place, int otherwise) {
  long long value = otherwise;
  if (place < argc && (!parse_integer(argv[place], value) || value < 0 || value > 100000))
    throw Error(ExitCode::kUsage, "bench_engines ENGINE [PROCESSES [COUNT]]");
  return int(value);
}

void measure(int argc, char** argv) {
  const auto engine = make_engine(argc > 1 ? argv[1] : "", {});
  ReferenceOptions options;
  options.processes = argument(argc, argv, 2, 0);
  const int count = argument(argc, argv, 3, 200);
  std::vector<Scene> scenes(
      std::size_t(count), read_scene(LOBELIA_SOURCE_DIR "/reference_scenes/scenes/oblique_45.xml"));
  for (int i = 0; i < count; ++i)
    for (Material& material : scenes[std::size_t(i)].materials) material.highlight.exponent = i + 1;
  engine->status();
  const double cpu_before = children_cpu();
  std::atomic<int> failed = 0;
  options.scenes = scenes.size();
  Session session(*engine, options);
  const double wall = seconds_of([&] {
    for_each_at_once(scenes.size(), session.at_once(), [&](std::size_t i) {
      if (!session.render(scenes[i]).error.empty()) ++failed;
    });
  });
  const double cpu = children_cpu() - cpu_before;
  const double cores = std::max(1u, std::thread::hardware_concurrency());
  fmt::print(
      "{}, {} pictures of {} x {}: {:.1f} s, {:.1f} s of processors, {:.0f} % of {}; {} failed\n",
      engine->info().title, count, scenes[0].film.width, scenes[0].film.height, wall, cpu,
      100 * cpu / wall / cores, cores, failed.load());
}

}  // namespace
}  // namespace lobelia::bench

int main(int argc, char** argv) {
  try {
    lobelia::bench::measure(argc, argv);
  } catch (const lobelia::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return int(error.code());
  }
}
