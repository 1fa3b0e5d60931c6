// How often the judge of noisy pictures calls them different: where both have one expectation, which is a false alarm, and
// where one is a little dimmer or moved.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/verdicts.hpp"

namespace lobelia::verdicts {

/// The first four are made, the last rendered.
enum class Noise {
  kColours,  ///< normal, each value by itself, as strong everywhere, also on black
  kGrey,     ///< normal, the three values of a pixel together
  kGamma,    ///< each sample is exponential: as strong as the light, with a longer tail above
  kFireflies,  ///< gamma, and in each picture a fiftieth of the pixels has five times the peak besides
  kRenders,  ///< ours, of a highlight under a ball of light
};
inline constexpr std::string_view kNoiseNames[] = {"colours", "grey", "gamma", "fireflies",
                                                   "renders"};

/// One kind of pair.
struct Cell {
  Noise noise;
  int size;        ///< pixels of a side; rendered pictures have three quarters as many rows
  int samples;     ///< of a pixel in each picture
  int replicates;  ///< pictures of each side
};

/// A picture of the cell. Different seeds are independent. The highlight is `wider` times as wide.
Image picture_of(const Cell& cell, std::uint64_t seed, double wider = 1);

struct Options {
  int seeds = 20;   ///< pairs of each cell
  int changed = 0;  ///< of them so many are judged with each change, too; 0: all
  double significance = 0.01;
  int bootstraps = 0;         ///< 0: as `lobelia compare` has them
  bool small = false;         ///< two cells of each kind
  std::vector<Noise> noises;  ///< these alone; empty: all
};

/// The share of false alarms that a cell may have, in units of the significance.
inline constexpr double kMostOfPromise = 1.5;

/// Gets the fraction done, from any thread.
using OnProgress = std::function<void(double)>;

/// Judges all pairs as `lobelia compare` does by default. The same on every machine but for renders. Throws
/// Error(kInterrupted) on Ctrl-C.
records::VerifyVerdicts measure(const Options& options, const OnProgress& on_progress);

/// A line for each cell: false alarms, and how many of each change were found.
std::string report_text(const records::VerifyVerdicts& verdicts);
/// The same table for docs/verdicts.md.
std::string report_markdown(const records::VerifyVerdicts& verdicts);

}  // namespace lobelia::verdicts
