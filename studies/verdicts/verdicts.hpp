// How often the judge of noisy pictures calls them different: where both have one expectation, which is a false alarm, and
// where one is a little dimmer or moved.
#pragma once

#include <functional>
#include <vector>

#include "records/verdicts.hpp"
#include "studies/verdicts/pictures.hpp"

namespace lobelia::verdicts {

struct Options {
  int seeds = 20;   ///< pairs of each cell
  int changed = 0;  ///< of them so many are judged with each change, too; 0: all
  double significance = 0.01;
  int bootstraps = 0;         ///< 0: as `lobelia compare` has them
  bool small = false;         ///< two cells of each kind, without an engine
  std::vector<Noise> noises;  ///< these alone; empty: all
  std::map<std::string, std::filesystem::path> programs;  ///< by engine; otherwise those in $PATH
  /// Where the pairs are written, so that another judge can have them: NOISE-SIZE-SAMPLES-PICTURES/b1/SEED.exr, b2 and so on
  /// for the reference, and CHANGE/a1/SEED.exr and so on. Empty: nowhere.
  std::filesystem::path pictures;
};

/// The share of false alarms that a cell may have, in units of the significance.
inline constexpr double kMostOfPromise = 1.5;

/// Gets the fraction done, from any thread.
using OnProgress = std::function<void(double)>;

/// Judges all pairs as `lobelia compare` does by default. The same on every machine but for renders. Throws
/// Error(kInterrupted) on Ctrl-C, Error(kEngine) where a picture of an engine fails.
records::VerifyVerdicts measure(const Options& options, const OnProgress& on_progress);

}  // namespace lobelia::verdicts
