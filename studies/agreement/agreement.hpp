// The measurement behind the table of agreement: every variant, every case.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "reference_scenes/engine.hpp"
#include "reference_scenes/replicates.hpp"
#include "studies/agreement/cases.hpp"
#include "studies/agreement/figures.hpp"
#include "studies/agreement/variants.hpp"

namespace lobelia::agreement {

enum class Verdict { kMet, kMissed, kNoTarget, kNotComparable, kFailed };
inline constexpr std::string_view kVerdictNames[] = {"met", "missed", "no target", "not comparable",
                                                     "failed"};

struct Row {
  std::size_t index = 0;  ///< of the case
  Variant variant;
  Figures figures;  ///< where there is a picture
  Verdict verdict = Verdict::kNoTarget;
  std::string why;  ///< not comparable, or failed
};

/// An engine's average at two numbers of points against what our own samples converge to.
struct SoftRow {
  std::string_view what;
  Variant variant;
  struct Count {
    int points = 0;
    ReplicateStatistics statistics;
    double rms_of_peak = 0;
  };
  std::vector<Count> counts;  ///< where there are pictures
  Verdict verdict = Verdict::kNoTarget;
  std::string why;
};
/// Values that may be beyond their limit: neighbours share their points, so a few fall out together.
inline constexpr std::size_t kBeyondAllowed = 3;

struct EngineHere {
  EngineInfo info;
  EngineStatus status;
};

struct Agreement {
  Scope scope;
  std::vector<EngineHere> engines;
  std::vector<Case> cases;
  std::vector<Row> rows;
  std::vector<SoftRow> soft;
  std::size_t count(Verdict verdict) const;
};

/// `on_progress` gets the fraction done and at what, from any thread.
using OnProgress = std::function<void(double, std::string_view)>;

/// By the engines that are available; the others are named in the result. Throws Error(kInterrupted) on Ctrl-C.
Agreement measure(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines,
                  const OnProgress& on_progress);

/// The soft part of it. `on_picture` is called after each result.
std::vector<SoftRow> measure_soft(const Scope& scope,
                                  std::span<const std::unique_ptr<Engine>> engines,
                                  const std::function<void(std::string_view)>& on_picture);
/// How often it will be called.
std::size_t soft_pictures(const Scope& scope, std::span<const std::unique_ptr<Engine>> engines);

}  // namespace lobelia::agreement
