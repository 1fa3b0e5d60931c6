#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/kernels/kernels.hpp"
#include "studies/stability/cases.hpp"
#include "studies/stability/naive.hpp"
#include "studies/stability/vectors.hpp"

namespace lobelia::stability {
namespace {

constexpr int kHalfFloatChunks = 8;

/// The vectors with the largest error, by the screened truth.
struct WorstInHalf {
  double error = -1, value = 0, bound = 0, peak = 1;
  Triple at;
};

Row float16_row(const Highlight& h) {
  const LobeAngle angle = info(h.model).angle;
  double bounds[kHalvings];
  for (int halvings = 0; halvings < kHalvings; ++halvings)
    bounds[halvings] = shading_error_bound(Precision::kFloat16, h, std::exp2(-halvings));
  RandomVectors vectors(angle, h.exponent, 4);
  const auto chunk = std::make_unique<Chunk>();
  WorstInHalf ours, naive;
  for (int c = 0; c < kHalfFloatChunks; ++c) {
    chunk->fill(angle, [&] { return vectors.next(); });
    alignas(64) double value[kChunk];
    float16_shade(h)(h, kChunk, chunk->normal, chunk->to_eye, chunk->to_light, value);
    for (std::size_t i = 0; i < kChunk; ++i) {
      const Factor by = factor(h, chunk->n_dot_l[i], chunk->n_dot_v[i]);
      const auto lobe = double(screened_lobe(h.lobe, chunk->s[i], h.exponent));
      const double bound = by.bound(bounds[chunk->halvings[i]], lobe), peak = by.peak();
      const auto truth = double(lobe * by.value);
      const Triple& at = chunk->directions[i];
      const auto note = [&](WorstInHalf& worst, double given, double part) {
        const double error =
            std::isfinite(given) ? std::abs(given - truth) / peak * part : kInfinity;
        if (error > worst.error) worst = {error, given, bound, peak, at};
      };
      // A bound of the whole peak excludes nothing: any other vector is worse.
      note(ours, value[i], bound < 1 ? 1 / bound : 0);
      note(naive,
           naive::shape_in_half_floats(h, normalize(at.normal), normalize(at.to_eye),
                                       normalize(at.to_light)),
           1);
    }
  }
  const auto truth_at = [&](const Triple& d) {
    return truth::shape(h, d.normal, d.to_eye, d.to_light);
  };
  const double truth = truth_at(ours.at);
  return judged("float16", fmt::format("n = {:g}", h.exponent), Subject(h), truth,
                judge(naive.value, truth_at(naive.at), naive.peak),
                judge(ours.value, truth, ours.peak), ours.bound);
}

}  // namespace

Rows float16_rows(LobeId lobe) {
  Rows rows;
  for (const ModelId model : all_models())
    for (const double n : kHalfFloatExponents)
      rows.push_back(float16_row({model, lobe, Normalisation::kExact, n}));
  return rows;
}

}  // namespace lobelia::stability
