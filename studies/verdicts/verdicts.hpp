// How often the judge of noisy pictures calls them different: where both have one expectation, which is a false alarm, and
// where one is a little dimmer or moved.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/verdicts.hpp"
#include "base/words/svg_chart.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia::verdicts {

/// The first four are made, the others rendered.
enum class Noise {
  kColours,  ///< normal, each value by itself, as strong everywhere, also on black
  kGrey,     ///< normal, the three values of a pixel together
  kGamma,    ///< each sample is exponential: as strong as the light, with a longer tail above
  kFireflies,  ///< gamma, and in each picture a fiftieth of the pixels has five times the peak besides
  kRenders,  ///< ours, of a highlight under a ball of light
  kCycles,   ///< Cycles' own light transport, of matt surfaces
};
inline constexpr std::string_view kNoiseNames[] = {"colours",   "grey",    "gamma",
                                                   "fireflies", "renders", "cycles"};

/// One kind of pair.
struct Cell {
  Noise noise;
  int size;        ///< pixels of a side; rendered pictures have three quarters as many rows
  int samples;     ///< of a pixel in each picture
  int replicates;  ///< pictures of each side
};

/// Renders the cells of kCycles, in one process, one picture at a time.
class Cycles {
 public:
  /// Takes the engine with its own light transport, from `programs` if that has it. Where it is absent, why_not() says so.
  explicit Cycles(const std::map<std::string, std::filesystem::path>& programs);
  ~Cycles();
  const std::string& why_not() const { return why_not_; }
  Image render(const Cell& cell, std::uint64_t seed);

 private:
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<Session> session_;
  std::string why_not_;
};

/// A picture of the cell. Different seeds are independent. The highlight is `wider` times as wide; that of kCycles has no
/// width. `cycles` is needed for kCycles alone. Throws Error(kEngine) if a picture fails.
Image picture_of(const Cell& cell, std::uint64_t seed, Cycles* cycles, double wider = 1);

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

/// A line for each cell: false alarms, and how many of each change were found.
std::string report_text(const records::VerifyVerdicts& verdicts);
/// The same table for docs/verdicts.md.
std::string report_markdown(const records::VerifyVerdicts& verdicts);

/// The share that is called different over how much dimmer a picture is: one chart for each kind of noise, a curve for each
/// cell.
std::vector<Chart> charts(const records::VerifyVerdicts& verdicts);
/// Writes verdicts-NOISE.svg into `directory`, which is made if it is not there.
void write_charts(const std::filesystem::path& directory, const records::VerifyVerdicts& verdicts);

}  // namespace lobelia::verdicts
