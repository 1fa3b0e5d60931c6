#include <algorithm>
#include <iterator>
#include <memory>

#include "reference_scenes/agreement/agreement.hpp"
#include "renderer/render.hpp"

namespace lobelia::agreement {
namespace {

struct SoftWitness {
  std::string_view name;
  double rounding;  ///< of its pictures, as a part of the value
};
/// What is looked at is the average; one witness of each engine tells.
constexpr SoftWitness kSoftWitnesses[] = {{"povray_native_half", 4.9e-4},
                                          {"blender_expressed", 1e-4}};

struct Work {
  WitnessKind witness;
  double rounding;
  Engine* engine;
};

std::vector<Work> work_for(std::span<const std::unique_ptr<Engine>> engines) {
  std::vector<Work> work;
  for (const SoftWitness& soft : kSoftWitnesses)
    for (const auto& engine : engines) {
      const WitnessKind& witness = *std::ranges::find(witnesses(), soft.name, &WitnessKind::name);
      if (witness.engine == engine->info().name && engine->status().available())
        work.push_back({witness, soft.rounding, engine.get()});
    }
  return work;
}

}  // namespace

std::size_t soft_pictures(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines) {
  const std::size_t witnesses_here = work_for(engines).size();
  return witnesses_here == 0
             ? 0
             : soft_cases(scope).size() * (1 + witnesses_here * soft_points(scope).size());
}

std::vector<SoftRow> measure_soft(const Scope& scope,
                                  std::span<const std::unique_ptr<Engine>> engines,
                                  const std::function<void(std::string_view)>& on_picture) {
  const auto work = work_for(engines);
  if (work.empty()) return {};
  const auto cases = soft_cases(scope);
  std::vector<Scene> scenes;
  std::vector<Image> truths;
  for (const SoftCase& one : cases) {
    scenes.push_back(one.scene);
    truths.push_back(render(one.converged, {}).image);
    on_picture("our own samples");
  }
  std::vector<SoftRow> rows;
  for (const auto& [witness, rounding, engine] : work) {
    std::vector<SoftRow> of_witness;
    for (const SoftCase& one : cases) of_witness.push_back({one.what, witness, {}, {}, {}});
    for (const int points : soft_points(scope)) {
      ReferenceOptions options;
      options.witness = witness.witness;
      options.fine = witness.fine;
      options.points = points;
      engine->render(scenes, options, [&](std::size_t i, ReferenceResult result) {
        on_picture(witness.title);
        SoftRow& row = of_witness[i];
        if (!result.error.empty()) {
          row.verdict = Verdict::kFailed;
          row.why = result.error;
          return;
        }
        const auto statistics = replicate_statistics(result, truths[i], points, rounding);
        const double peak = *std::ranges::max_element(truths[i].values());
        row.counts.push_back({points, statistics, statistics.rms / peak});
        if (row.verdict == Verdict::kFailed) return;
        if (statistics.beyond > kBeyondAllowed) row.verdict = Verdict::kMissed;
        if (row.verdict == Verdict::kNoTarget) row.verdict = Verdict::kMet;
      });
    }
    std::ranges::move(of_witness, std::back_inserter(rows));
  }
  return rows;
}

}  // namespace lobelia::agreement
