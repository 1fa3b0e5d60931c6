// Cryptomatte: which objects cover a pixel, and by how much.
//
// Source: J. Friedman, A. C. Jones, "Fully automatic ID mattes with support for motion blur and transparency", SIGGRAPH
// 2015; Cryptomatte Specification 1.2. The layers NAME00, NAME01, ... hold two pairs each: the hash of an object's name
// in R and B, as the bits of a float, and the share of the pixel that it covers in G and A.
//
// Objects are compared as a set: their order in a pixel does not matter, and two pairs of one object count together.
#pragma once

#include <filesystem>
#include <map>

#include "compare/layer_types.hpp"

namespace lobelia {

/// The pairs of one file.
struct CoveredPixels {
  /// One pair of every pixel.
  struct Pair {
    std::vector<std::uint32_t, ZeroedMemory<std::uint32_t>> ids;
    PixelValues coverage;  ///< 0 where there is no object
  };
  int width = 0, height = 0;
  std::vector<Pair> pairs;
  std::map<std::uint32_t, std::string> names;  ///< of objects, as far as the manifest has them
};

/// The Cryptomatte that both layers belong to, if all their channels were read and their type is kIdentifier.
std::optional<CryptomatteRank> cryptomatte_of(const PictureSource& a, const PictureSource& b,
                                              const ComparisonOptions& options);

/// The layers of the file that belong to the Cryptomatte, with their alphas, and the layer that was read itself.
std::vector<std::string> cryptomatte_layers(const PictureSource& source,
                                            const CryptomatteRank& rank);

/// Reads all ranks, cut to the options' part; or all their data on a window of compare/overscan.hpp. Errors as
/// read_picture(); Error(kInput) too if ranks differ in size.
CoveredPixels read_cryptomatte(const std::filesystem::path& file, const PictureSource& source,
                               const CryptomatteRank& rank, const ComparisonOptions& options,
                               const std::optional<PixelWindow>& window = {});

/// Compares both, pixel by pixel. A coverage that is not finite makes the verdict non-finite. Errors as compare().
Comparison compare_cryptomattes(const CoveredPixels& a, const CoveredPixels& b,
                                const ComparisonOptions& options);

}  // namespace lobelia
