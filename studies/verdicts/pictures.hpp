// Pictures with noise, of which every seed has the same expectation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "core/image.hpp"
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

}  // namespace lobelia::verdicts
