#include <cmath>
#include <memory>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/kernels/kernels.hpp"
#include "studies/stability/cases.hpp"
#include "studies/stability/naive.hpp"
#include "studies/stability/vectors.hpp"

namespace lobelia::stability {
namespace {

constexpr std::size_t kChunks = 196;     ///< of kChunk vectors: 1e5
constexpr int kClimbs = 6;               ///< chunks about the worst vectors
constexpr std::size_t kNaiveEvery = 16;  ///< the naive formula is slow, and bad enough on these
constexpr Precision kPrecisions[] = {Precision::kFloat32, Precision::kMixed, Precision::kFloat64};

/// The largest error seen, and where.
struct Worst {
  double of_bound = -1;
  Triple at;
  double value = 0, bound = 0, peak = 1;
};

/// One model at one exponent in every precision.
class Trial {
 public:
  explicit Trial(const Highlight& highlight) : highlight_(highlight) {
    for (int halvings = 0; halvings < kHalvings; ++halvings) {
      const double least = std::exp2(-halvings);
      for (std::size_t p = 0; p < 3; ++p)
        bounds_[p][halvings] = shading_error_bound(kPrecisions[p], highlight, least);
      chosen_[halvings] = sufficient_precision(highlight, least);
    }
  }

  /// `lobe` has the lobe's true values at the chunk's vectors.
  void shade(const Chunk& chunk, const long double* lobe, bool with_naive) {
    Factor factors[kChunk];
    long double truth[kChunk];
    for (std::size_t i = 0; i < kChunk; ++i) {
      factors[i] = factor(highlight_, chunk.n_dot_l[i], chunk.n_dot_v[i]);
      truth[i] = lobe[i] * factors[i].value;
    }
    for (std::size_t p = 0; p < 3; ++p) {
      alignas(64) double value[kChunk];
      kernels().shade(highlight_, kPrecisions[p])(highlight_, kChunk, chunk.normal, chunk.to_eye,
                                                  chunk.to_light, value);
      for (std::size_t i = 0; i < kChunk; ++i) {
        const double peak = factors[i].peak();
        const double error = double(std::abs(value[i] - truth[i])) / peak;
        const int halvings = chunk.halvings[i];
        const auto bound_of = [&](double of_lobe) {
          return factors[i].bound(of_lobe, double(lobe[i]));
        };
        const double bound = bounds_[p][halvings];
        const auto note_here = [&](Worst& worst, double of_lobe) {
          note(worst, error, {0, chunk.directions[i], value[i], bound_of(of_lobe), peak});
        };
        note_here(by_precision[p], bound);
        if (chosen_[halvings] != kPrecisions[p]) continue;
        if (bound <= kAllowedShadingError)
          note_here(as_chosen, kAllowedShadingError);
        else
          note_here(beyond_float64, bound);
      }
    }
    if (with_naive)
      for (std::size_t i = 0; i < kChunk; ++i) {
        const Triple& d = chunk.directions[i];
        const double value = naive::shape(highlight_, d.normal, d.to_eye, d.to_light);
        const double error = double(std::abs(value - truth[i]));
        note(by_naive, std::isfinite(error) ? error : 1e300, {0, d, value, 1});
      }
  }

  /// Judges the worst by the truth.
  Row row(const std::string& name, const Worst& worst) const {
    const auto truth_at = [&](const Triple& d) {
      return truth::shape(highlight_, d.normal, d.to_eye, d.to_light);
    };
    const double truth = truth_at(worst.at);
    return judged("precision", name, Subject(highlight_), truth,
                  judge(by_naive.value, truth_at(by_naive.at), 1),
                  judge(worst.value, truth, worst.peak), worst.bound);
  }

  Worst by_precision[3], as_chosen, by_naive;
  Worst
      beyond_float64;  ///< where not even float64 promises kAllowedShadingError (docs/numerics.md)

 private:
  static void note(Worst& worst, double error, Worst here) {
    // A bound of the whole peak excludes nothing: any other vector is worse.
    here.of_bound = here.bound < 1 || !std::isfinite(error) ? error / here.bound : 0;
    if (here.of_bound > worst.of_bound) worst = here;
  }

  Highlight highlight_;
  double bounds_[3][kHalvings];
  Precision chosen_[kHalvings];
};

/// The models with the same angle, with one lobe.
class Trials {
 public:
  Trials(LobeAngle angle, LobeId lobe, double exponent)
      : angle_(angle), lobe_(lobe), exponent_(exponent) {
    for (const ModelId model : all_models())
      if (info(model).angle == angle)
        trials_.emplace_back(Highlight{model, lobe, Normalisation::kExact, exponent});
  }

  void shade(const Chunk& chunk, bool with_naive) {
    long double truth[kChunk];
    for (std::size_t i = 0; i < kChunk; ++i) truth[i] = screened_lobe(lobe_, chunk.s[i], exponent_);
    for (Trial& trial : trials_) trial.shade(chunk, truth, with_naive);
  }

  /// Tries more vectors near the worst.
  void climb(RandomVectors& vectors, Chunk& chunk) {
    for (int climb = 0; climb < kClimbs; ++climb)
      for (std::size_t p = 0; p < 3; ++p) {
        const Triple worst = trials_[std::size_t(climb) % trials_.size()].by_precision[p].at;
        chunk.fill(angle_, [&] { return vectors.beside(worst); });
        shade(chunk, false);
      }
  }

  void add_rows(Rows& rows) const {
    for (const Trial& trial : trials_) {
      if (trial.as_chosen.of_bound >= 0)
        rows.push_back(trial.row("in the precision that is chosen", trial.as_chosen));
      if (trial.beyond_float64.of_bound >= 0)
        rows.push_back(trial.row("where float64 promises less", trial.beyond_float64));
      for (std::size_t p = 0; p < 3; ++p)
        rows.push_back(
            trial.row("all in " + std::string(name(kPrecisions[p])), trial.by_precision[p]));
    }
  }

 private:
  LobeAngle angle_;
  LobeId lobe_;
  double exponent_;
  std::vector<Trial> trials_;
};

}  // namespace

Rows precision_rows(const std::vector<LobeId>& lobes, double exponent) {
  Rows rows;
  const auto chunk = std::make_unique<Chunk>();
  for (const LobeAngle angle : {LobeAngle::kReflection, LobeAngle::kHalfVector}) {
    std::vector<Trials> by_lobe;
    for (const LobeId& lobe : lobes) by_lobe.emplace_back(angle, lobe, exponent);
    RandomVectors vectors(angle, exponent, 1);
    for (std::size_t i = 0; i < kChunks; ++i) {
      chunk->fill(angle, [&] { return vectors.next(); });
      for (Trials& trials : by_lobe) trials.shade(*chunk, i % kNaiveEvery == 0);
    }
    for (Trials& trials : by_lobe) {
      trials.climb(vectors, *chunk);
      trials.add_rows(rows);
    }
  }
  return rows;
}

}  // namespace lobelia::stability
