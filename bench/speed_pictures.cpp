#include <fmt/format.h>
#include <hwy/highway.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "bench/sections.hpp"
#include "core/threads.hpp"
#include "renderer/fused.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::bench {
namespace {

constexpr int kSide = 1024;
constexpr double kMegapixels = 1e-6 * kSide * kSide;

/// The speed of a hand-written prototype of the head-on picture, megapixels a second on one core.
struct InstructionSet {
  const char* name;
  std::int64_t targets;
  double prototype_cs16, prototype_cosine;
};
constexpr InstructionSet kSets[] = {{"AVX2", HWY_AVX2 | HWY_SSSE3, 590, 290},
                                    {"AVX-512", HWY_AVX3 | HWY_AVX2 | HWY_SSSE3, 900, 500}};

std::vector<InstructionSet> sets_here() {
  std::vector<InstructionSet> result;
  for (const InstructionSet& set : kSets)
    if (hwy::SupportedTargets() & set.targets & -set.targets & (HWY_AVX2 | HWY_AVX3))
      result.push_back(set);
  return result;
}

Scene head_on(ModelId model, LobeId lobe) {
  Scene scene = read_scene(scene_file("head_on"));
  scene.film.width = scene.film.height = kSide;
  scene.materials[0].highlight.model = model;
  scene.materials[0].highlight.lobe = lobe;
  return scene;
}

std::unique_ptr<FusedRenderer> renderer_for(const InstructionSet& set, const Scene& scene) {
  hwy::SetSupportedTargetsForTest(set.targets);
  auto result =
      std::make_unique<FusedRenderer>(scene, make_plan(scene, EffectPolicy::kAsCalledFor));
  hwy::SetSupportedTargetsForTest(0);
  return result;
}

void require_peak(const Scene& scene, std::span<const float> values) {
  const Highlight& h = scene.materials[0].highlight;
  const double peak = *std::max_element(values.begin(), values.end());
  if (std::abs(peak / radiance_coefficient(h) - 1) < 1e-3) return;
  fmt::print(stderr, "wrong picture: its peak is {}\n", peak);
  std::exit(EXIT_FAILURE);
}

}  // namespace

void pictures() {
  const auto sets = sets_here();
  struct Case {
    ModelId model;
    LobeId lobe;
    std::size_t set;
    Scene scene;
    std::unique_ptr<FusedRenderer> renderer;
  };
  std::vector<Case> all;
  for (const ModelId model : all_models())
    for (const LobeId& lobe : all_lobes())
      for (std::size_t set = 0; set < sets.size(); ++set) {
        const Scene scene = head_on(model, lobe);
        all.push_back({model, lobe, set, scene, renderer_for(sets[set], scene)});
      }
  Image image(kSide, kSide);
  float* rgb = image.values().data();
  std::vector<std::function<void()>> cases;
  for (const Case& c : all)
    cases.push_back([&, r = c.renderer.get()] { r->render_rows(0, kSide, rgb); });
  cases.push_back([&] {
    std::memset(rgb, 0, image.values().size_bytes());
    asm volatile("" ::"r"(rgb) : "memory");
  });
  const auto times = interleaved(cases, 15);
  for (const Case& c : all) {
    c.renderer->render_rows(0, kSide, rgb);
    require_peak(c.scene, image.values());
  }

  fmt::print(
      "\nThe head-on picture, {} x {}: megapixels a second of one thread into memory used before, median (best) of 15\n"
      "interleaved rounds, and the part of a hand-written prototype's that the median is\n",
      kSide, kSide);
  fmt::print("{:<24}{:<20}", "model", "lobe");
  for (const auto& set : sets) fmt::print("{:>14}{:>8}{:>9}", set.name, "spread", "part");
  fmt::print("\n");
  double fastest = 1e9;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Case& c = all[i];
    const std::string_view lobe = lobe_names()[(i / sets.size()) % all_lobes().size()];
    if (c.set == 0) fmt::print("{:<24}{:<20}", info(c.model).name, lobe);
    const double rate = kMegapixels / times[i].median;
    const double prototype = lobe == "cs16"     ? sets[c.set].prototype_cs16
                             : lobe == "cosine" ? sets[c.set].prototype_cosine
                                                : 0;
    fmt::print("{:>6.0f} ({:>5.0f}){:>7.1f}%", rate, kMegapixels / times[i].least,
               100 * times[i].spread);
    fmt::print("{:>9}", prototype > 0 ? fmt::format("{:.0f} %", 100 * rate / prototype) : "");
    if (c.set + 1 == sets.size()) fmt::print("\n");
    fastest = std::min(fastest, times[i].median);
  }
  const double filling = times.back().median;

  // Whole renders, plan and memory included.
  const Scene scene = head_on(*find_model("phong_rdf"), *find_lobe("cs16"));
  RenderOptions options;
  options.threads = 1;
  RenderOptions one_by_one = options;
  one_by_one.allow_fused = false;
  const auto whole =
      interleaved({[&] { render(scene, options); }, [&] { render(scene, one_by_one); }}, 15);
  fmt::print(
      "A fresh picture (plan, memory, cs16): {:.0f} megapixels a second; by the kernels one by one {:.0f}\n",
      kMegapixels / whole[0].median, kMegapixels / whole[1].median);
  fmt::print(
      "Limit: {}. Filling the picture with zeros takes {:.2f} ms, {:.0f} % of the fastest picture's {:.2f} ms; "
      "fresh memory and the plan add {:.2f} ms.\n",
      filling < 0.5 * fastest ? "compute" : "memory", 1e3 * filling, 100 * filling / fastest,
      1e3 * fastest, 1e3 * std::max(0.0, whole[0].median - fastest));
}

void trace(const std::string& path) {
  Scene scene = read_scene(path);
  scene.film.width = scene.film.height = kSide;
  Image image(kSide, kSide);
  for (const auto& set : sets_here()) {
    const auto renderer = renderer_for(set, scene);
    const auto times =
        interleaved({[&] { renderer->render_rows(0, kSide, image.values().data()); }}, 41);
    fmt::print("{} {:.6f}\n", set.name, times[0].median);
  }
}

void threads() {
  const int processors = oneapi::tbb::info::default_concurrency();
  Scene scene = head_on(*find_model("modified_phong"), *find_lobe("cosine"));
  scene.film.width = scene.film.height = 4096;
  std::vector<int> counts;
  for (int n = 1; n < processors; n *= 2) counts.push_back(n);
  counts.push_back(processors);
  std::vector<std::vector<double>> all(counts.size());
  std::vector<float> first;
  for (int round = 0; round < 9; ++round)
    for (std::size_t i = 0; i < counts.size(); ++i) {
      RenderOptions options;
      options.threads = counts[i];
      const RenderResult result = render(scene, options);
      all[i].push_back(result.render_seconds);
      const auto values = result.image.values();
      if (first.empty()) first.assign(values.begin(), values.end());
      if (!std::equal(first.begin(), first.end(), values.begin())) {
        fmt::print(stderr, "wrong picture with {} threads\n", counts[i]);
        std::exit(EXIT_FAILURE);
      }
    }
  fmt::print(
      "\nThreads: modified Phong with cos^n, 4096 x 4096, fresh memory; median of 9 interleaved rounds\n");
  fmt::print("{:>8}{:>10}{:>12}{:>12}{:>10}\n", "threads", "ms", "Mpixel/s", "efficiency",
             "spread");
  double efficiency = 1;
  const double one = summary(all[0]).median;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Times t = summary(all[i]);
    efficiency = one / t.median / counts[i];
    fmt::print("{:>8}{:>10.1f}{:>12.0f}{:>11.0f}%{:>9.1f}%\n", counts[i], 1e3 * t.median,
               16 * kMegapixels / t.median, 100 * efficiency, 100 * t.spread);
  }
  fmt::print("Limit: {}.\n", efficiency > 0.8
                                 ? "compute"
                                 : "what the processors share: memory, or another program");
}

}  // namespace lobelia::bench
