#include "cost/effects/without.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "renderer/plan/effects/catalogue.hpp"

namespace lobelia::cost {
namespace {

void each_material(Without& w, void (*change)(Material&)) {
  std::for_each(w.scene.materials.begin(), w.scene.materials.end(), change);
}

/// A light with a size becomes a lamp of the same power; any other light is returned as it is.
Light as_point(const Light& light) {
  const auto lamp = lamp_of_same_power(light);
  return lamp ? light_of(*lamp) : light;
}

struct Switch {
  std::string_view effect, instead;
  void (*off)(Without&);
};

constexpr Switch kSwitches[] = {
    {effects::Diffuse::kName, "black beneath the highlights",
     [](Without& w) { each_material(w, [](Material& m) { m.diffuse_reflectance = {}; }); }},
    {effects::Fresnel::kName, "the same reflectance at every angle",
     [](Without& w) {
       each_material(w, [](Material& m) { m.fresnel = lobelia::Fresnel::kNone; });
     }},
    {effects::Shadows::kName, "light through everything",
     [](Without& w) { w.experiment.shadows = false; }},
    {effects::AreaLights::kName, "points of the same power",
     [](Without& w) {
       std::transform(w.scene.lights.begin(), w.scene.lights.end(), w.scene.lights.begin(),
                      as_point);
     }},
    {effects::Environment::kName, "black where no surface is",
     [](Without& w) { std::erase_if(w.scene.lights, is_environment); }},
    {effects::Mirror::kName, "no mirrors",
     [](Without& w) { each_material(w, [](Material& m) { m.mirror_reflectance = {}; }); }},
    {effects::Glossy::kName, "direct light and mirrors alone",
     [](Without& w) { w.scene.depth.glossy = 0; }},
    {effects::Ground::kName, "no planes", [](Without& w) { w.scene.planes.clear(); }},
    {effects::DepthOfField::kName, "a pinhole",
     [](Without& w) { w.scene.camera.aperture_radius = 0; }},
    {effects::Antialiasing::kName, "one ray a pixel, through its centre",
     [](Without& w) { w.scene.sampler.sample_count = 1; }},
};
static_assert(std::size(kSwitches) == Effects::kSize, "a new effect needs its line here");

const Switch& find(std::string_view effect) {
  for (const Switch& one : kSwitches)
    if (one.effect == effect) return one;
  throw Error(ExitCode::kInternal, fmt::format("nothing switches {} off", effect));
}

}  // namespace

Without without(std::string_view effect, Scene scene) {
  Without result{std::move(scene), {}};
  find(effect).off(result);
  return result;
}

std::string_view in_place_of(std::string_view effect) { return find(effect).instead; }

}  // namespace lobelia::cost
