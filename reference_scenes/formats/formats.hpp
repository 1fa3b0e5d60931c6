// The formats of the catalogue, each in a file of its own, and what several of them need.
#pragma once

#include "records/scene.hpp"
#include "reference_scenes/formats/catalogue.hpp"

namespace lobelia {

extern const SceneFormat kJsonFormat, kMitsubaFormat, kPovrayFormat, kBlenderPythonFormat;

/// The most spheres that are written out one by one. Our own reader takes at most kMaxSceneBytes.
inline constexpr std::size_t kMaxWrittenSpheres = 200'000;
/// Why a scene with so many spheres is not written; empty if it is.
std::string why_not_so_many_spheres(const Scene& scene);
/// The same, or why a format that spells out each type of light does not know one of the scene's.
std::string why_not_spelled_out(const Scene& scene);

/// The scene as numbers.
records::Scene scene_record(const Scene& scene);

}  // namespace lobelia
