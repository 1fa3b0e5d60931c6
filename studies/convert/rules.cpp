#include "studies/convert/convert.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia::conversion {
namespace {

using Answer = std::optional<double>;

double squared(double x) { return x * x; }

// Babylon.js draws a Bezier curve from roughness 1 at n = 0 to 0.1 at 1300, and clamps n.
constexpr double kBabylonEnd = 1300, kBabylonMost = 1024, kBabylonLeast = 0.1;

double babylon_roughness(double n) {
  const double left = 1 - std::cbrt(std::min(n, kBabylonMost) / kBabylonEnd);
  return kBabylonLeast + (1 - kBabylonLeast) * left * left * left;
}

constexpr std::string_view kWalter =
    "Walter et al. 2007, section 5.2, for Beckmann; Karis 2013, \"Specular BRDF Reference\"; Unreal Engine and trimesh, "
    "as roughness = (2 / (n + 2))^(1/4)";
constexpr std::string_view kFbx2Gltf = "FBX2glTF, Raw2Gltf.cpp";
constexpr std::string_view kBlender =
    "Blender, obj_import_mtl.cc; assimp, glTF2Exporter.cpp, for a white specular colour";
constexpr std::string_view kBabylon = "Babylon.js, SpecularPowerToRoughness";
constexpr std::string_view kObj2Gltf = "obj2gltf, loadMtl.js";

constexpr Rule kToGgx[] = {
    {"Walter", "alpha = sqrt(2 / (n + 2))", kWalter,
     [](double n) -> Answer { return std::sqrt(2 / (n + 2)); }},
    {"FBX2glTF", "roughness = sqrt(2 / (n + 2))", kFbx2Gltf,
     [](double n) -> Answer { return 2 / (n + 2); }},
    {"Blender", "roughness = 1 - sqrt(min(n, 1000) / 1000)", kBlender,
     [](double n) -> Answer { return squared(1 - std::sqrt(std::min(n, 1000.0) / 1000)); }},
    {"Babylon", "roughness = 0.1 + 0.9 (1 - (min(n, 1024) / 1300)^(1/3))^3", kBabylon,
     [](double n) -> Answer { return squared(babylon_roughness(n)); }},
    {"obj2gltf", "roughness = 1 - min(n, 1000) / 1000", kObj2Gltf,
     [](double n) -> Answer { return squared(1 - std::min(n, 1000.0) / 1000); }},
};

constexpr Rule kFromGgx[] = {
    {"Walter", "n = 2 / alpha^2 - 2", kWalter,
     [](double alpha) -> Answer { return 2 * (1 - alpha) * (1 + alpha) / squared(alpha); }},
    {"FBX2glTF", "n = 2 / roughness^2 - 2", kFbx2Gltf,
     [](double alpha) -> Answer { return 2 * (1 - alpha) / alpha; }},
    {"Blender", "n = 1000 (1 - roughness)^2", kBlender,
     [](double alpha) -> Answer { return 1000 * squared(1 - std::sqrt(alpha)); }},
    {"Babylon", "n = 1300 (1 - ((roughness - 0.1) / 0.9)^(1/3))^3", kBabylon,
     [](double alpha) -> Answer {
       const double roughness = std::sqrt(alpha);
       if (roughness < babylon_roughness(kBabylonMost)) return std::nullopt;
       const double t = 1 - std::cbrt((roughness - kBabylonLeast) / (1 - kBabylonLeast));
       return kBabylonEnd * t * t * t;
     }},
    {"obj2gltf", "n = 1000 (1 - roughness)", kObj2Gltf,
     [](double alpha) -> Answer { return 1000 * (1 - std::sqrt(alpha)); }},
};

constexpr Rule kSame{"same", "n stays", "three.js, MTLLoader: Ns becomes shininess",
                     [](double n) -> Answer { return n; }};
constexpr std::string_view kFisher =
    "Fisher and Woo 1994, \"R.E versus N.H Specular Highlights\", Graphics Gems IV";

constexpr Rule kToHalfVector[] = {
    kSame, {"fisher", "n of N.H = 4 n of R.L", kFisher, [](double n) -> Answer { return 4 * n; }}};
constexpr Rule kToReflection[] = {
    kSame,
    {"fisher", "n of R.L = n of N.H / 4", kFisher, [](double n) -> Answer { return n / 4; }}};

}  // namespace

std::span<const Rule> rules(ShadingModel from, ShadingModel to) {
  if (from.is_ggx() && to.is_ggx()) return {};
  if (to.is_ggx()) return kToGgx;
  if (from.is_ggx()) return kFromGgx;
  const LobeAngle angle = info(*to.id).angle;
  if (angle == info(*from.id).angle) return {&kSame, 1};
  return angle == LobeAngle::kHalfVector ? std::span(kToHalfVector) : std::span(kToReflection);
}

}  // namespace lobelia::conversion
