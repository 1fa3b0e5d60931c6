// Pictures of highlights of known figures, as files of renderers show them: with noise, clipped, in few bits, averaged over
// pixels. They are made by formulas of their own, not by the code that is judged.
#pragma once

#include <optional>
#include <random>
#include <span>
#include <string>

#include "base/pictures/image.hpp"
#include "renderer/filter.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::profile_study {

enum class Noise {
  kNone,
  kGauss,  ///< a share of the peak, the same everywhere
  kGamma,  ///< a share of the value, skewed as that of a few samples
};
enum class Stored { kFloat, kHalf, kEightBit };

/// How pictures of one row of the table are made.
struct Kind {
  std::string name;
  bool with_scene = false;
  Noise noise = Noise::kNone;
  Stored stored = Stored::kFloat;
  bool clipped = false;
  std::optional<std::string> filter =
      {};                      ///< none: pixels' centres; "any": one drawn from the catalogue
  bool filter_is_told = true;  ///< by the scene
  bool slope = false;          ///< of the background
  bool rendered = false;       ///< by our renderer with 256 samples per pixel
};
std::span<const Kind> kinds();

/// A highlight of a scene: the sphere, the camera and the light are the scene's, the lobe's width is not.
struct MadeScene {
  Scene scene;
  Image image;
  std::string family;  ///< of records::kLobeFamilies
  double width = 0;    ///< exponent or alpha
};
MadeScene make_scene(const Kind& kind, std::mt19937& random);

/// A highlight without a scene, and the figures of what the picture would show without noise and rounding.
struct MadeBlob {
  Image image;
  double x = 0, y = 0;  ///< of the peak and of the centroid
  double peak = 0, major = 0, minor = 0, energy = 0;
};
MadeBlob make_blob(const Kind& kind, std::mt19937& random);

}  // namespace lobelia::profile_study
