// Scenes for small programs that shade by an engine's own highlight: words and numbers, a line for each thing.
//
//   scene NAME                                      of its picture, NAME-0.pfm
//   seconds S                                       after which the program has to give up
//   film WIDTH HEIGHT                               pixels
//   window LEFT RIGHT BOTTOM TOP                    of the film, at distance 1
//   light directional X Y Z R G B                   unit vector to the light, irradiance
//   light point X Y Z R G B                         position, intensity
//   material KIND EXPONENT STRENGTH DR DG DB        diffuse albedo over pi
//   sphere X Y Z RADIUS MATERIAL
//   plane X Y Z NX NY NZ MATERIAL
//   end
//
// All places are in the camera's frame: it is in the origin, x is to the right, y upwards and z away from it. A material's
// kind is the engine's name for a highlight, and STRENGTH the factor in front of it that the engine does not have itself.
// Nothing that a user typed gets in.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "reference_scenes/engine_program.hpp"

namespace lobelia {

/// A material's highlight as an engine has it.
struct OwnHighlight {
  std::string_view kind = "none";
  double strength = 0;
};

/// For programs that shade single points, without shadows: why not, as a sentence.
std::string why_not_one_sphere(const Scene& scene);
bool has_point_lights(const Scene& scene);

/// An engine that is one of our small programs around an engine's library (scene_program.hpp), and shades by the engine's
/// own highlight or not at all: the differences between these engines.
struct NativeEngine {
  EngineInfo info;
  EngineProbe probe;
  std::string_view method;  ///< records::Reference::method
  /// The engine's own highlight with this model, lobe and exponent; none if it has no such.
  std::optional<OwnHighlight> (*own)(const Highlight&);
  /// Why it cannot show the scene for other reasons, as a sentence; empty if it can.
  std::string (*why_not)(const Scene&) = nullptr;
};

// One file each, in the folder of its name.
extern const NativeEngine kTachyon, kSunflow, kThree, kBabylon, kOpengl;

/// For an engine that is given points: the cosine is the product of two vectors of three components in float32; power
/// and colour round some more.
inline constexpr EngineFloor kFloat32PointFloor{.of_peak = 8 * kFloat32Rounding,
                                                .of_cosine = 4 * kFloat32Rounding};

/// The page decides the pictures of a program in a browser, too.
inline std::vector<std::filesystem::path> page_of(const std::filesystem::path& program,
                                                  std::string_view) {
  return {program.string() + ".html"};
}

/// `engine` must outlive it.
std::unique_ptr<Engine> make_native_engine(const NativeEngine& engine,
                                           const std::filesystem::path& program);

/// Writes the program's input for `scene` into `directory`, which exists.
void keep_native_input(const NativeEngine& engine, const Scene& scene,
                       const ReferenceOptions& options, const std::filesystem::path& directory);

}  // namespace lobelia
