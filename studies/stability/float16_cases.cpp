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
  double error = -1, value = 0, bound = 0;
  Triple at;
};

Row float16_row(const Highlight& h) {
  const LobeAngle angle = info(h.model).angle;
  const bool cosine = info(h.model).applies_cosine;
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
      const double bound = bounds[chunk->halvings[i]];
      const auto truth = double(screened_lobe(h.lobe, chunk->s[i], h.exponent) *
                                (cosine ? chunk->n_dot_l[i] : 1.0L));
      const Triple& at = chunk->directions[i];
      const auto note = [&](WorstInHalf& worst, double given, double part) {
        const double error = std::isfinite(given) ? std::abs(given - truth) * part : kInfinity;
        if (error > worst.error) worst = {error, given, bound, at};
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
                judge(naive.value, truth_at(naive.at), 1), judge(ours.value, truth, 1), ours.bound);
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
