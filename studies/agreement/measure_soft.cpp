#include <algorithm>
#include <iterator>
#include <memory>

#include "renderer/render.hpp"
#include "studies/agreement/agreement.hpp"

namespace lobelia::agreement {
namespace {

struct Work {
  Variant variant;
  Engine* engine;
};

std::vector<Work> work_for(std::span<const std::unique_ptr<Engine>> engines) {
  std::vector<Work> work;
  for (const Variant& variant : variants())
    for (const auto& engine : engines)
      if (variant.rounding > 0 && variant.engine == engine->info().name &&
          engine->status().available())
        work.push_back({variant, engine.get()});
  return work;
}

}  // namespace

std::size_t soft_pictures(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines) {
  const std::size_t variants_here = work_for(engines).size();
  return variants_here == 0
             ? 0
             : soft_cases(scope).size() * (1 + variants_here * soft_points(scope).size());
}

std::vector<SoftRow> measure_soft(const Scope& scope,
                                  std::span<const std::unique_ptr<Engine>> engines,
                                  const std::function<void(std::string_view)>& on_picture) {
  const auto work = work_for(engines);
  if (work.empty()) return {};
  const auto cases = soft_cases(scope);
  std::vector<Image> truths;
  for (const SoftCase& one : cases) {
    truths.push_back(render(one.converged, {}).image);
    on_picture("our own samples");
  }
  std::vector<SoftRow> rows;
  for (const auto& [variant, engine] : work) {
    std::vector<SoftRow> of_variant;
    for (const SoftCase& one : cases) of_variant.push_back({one.what, variant, {}, {}, {}});
    for (const int points : soft_points(scope)) {
      ReferenceOptions options;
      options.shading = variant.shading;
      options.fine = variant.fine;
      options.points = points;
      Session session(*engine, options);
      // Each is an average of many pictures, which are rendered side by side.
      for (std::size_t i = 0; i < cases.size(); ++i) {
        const ReferenceResult result = session.render(cases[i].scene);
        on_picture(variant.title);
        SoftRow& row = of_variant[i];
        if (!result.error.empty()) {
          row.verdict = Verdict::kFailed;
          row.why = result.error;
          continue;
        }
        const auto statistics = replicate_statistics(result, truths[i], points, variant.rounding);
        const double peak = *std::ranges::max_element(truths[i].values());
        row.counts.push_back({points, statistics, statistics.rms / peak});
        if (row.verdict == Verdict::kFailed) continue;
        if (statistics.beyond > kBeyondAllowed) row.verdict = Verdict::kMissed;
        if (row.verdict == Verdict::kNoTarget) row.verdict = Verdict::kMet;
      }
    }
    std::ranges::move(of_variant, std::back_inserter(rows));
  }
  return rows;
}

}  // namespace lobelia::agreement
