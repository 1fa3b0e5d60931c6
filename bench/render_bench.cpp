// Whole pictures in memory: megapixels a second, one thread and all.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "lobelia_paths.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

void render_scene(benchmark::State& state, const std::string& name, const std::string& lobe,
                  int threads) {
  Scene scene =
      read_scene(std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/scenes/" + name + ".xml");
  scene.film = {512, 512};
  for (auto& material : scene.materials) material.highlight.lobe = *find_lobe(lobe);
  RenderOptions options;
  options.threads = threads;
  float brightest = 0;
  for (auto _ : state) {
    const RenderResult result = render(scene, options);
    brightest = *std::max_element(result.image.values().begin(), result.image.values().end());
  }
  if (!(brightest > 1)) state.SkipWithError("a black picture");
  state.SetItemsProcessed(std::int64_t(state.iterations()) * scene.film.width * scene.film.height);
}

const int kRegistered = [] {
  for (const char* scene : {"head_on", "point_light", "two_lights", "two_spheres"})
    for (const char* lobe : {"cosine", "cs16"})
      for (const int threads : {1, 0})
        benchmark::RegisterBenchmark((std::string("render/") + scene + "/" + lobe + "/" +
                                      (threads == 1 ? "1_thread" : "all_threads"))
                                         .c_str(),
                                     render_scene, scene, lobe, threads)
            ->UseRealTime();
  return 0;
}();

}  // namespace
}  // namespace lobelia
