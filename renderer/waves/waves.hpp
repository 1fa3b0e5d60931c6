// Waves of rays. A chunk of rays at a time goes from the camera to surfaces, to lights and on, with every effect.
// PreparedScene holds the constants of a picture; each step of a wave has a file of its own.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/accelerator.hpp"
#include "renderer/filter.hpp"
#include "renderer/frame.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/light_tree.hpp"
#include "renderer/plan/plan.hpp"
#include "renderer/reflector.hpp"
#include "renderer/scene/lights/prepared_light.hpp"
#include "renderer/work.hpp"

namespace lobelia {

struct PixelSample {
  int x = 0, y = 0;
  std::uint32_t index = 0;
  double dx = 0, dy = 0;  ///< from the pixel's centre; only where one ray a pixel was asked for
};

/// The result of a camera ray.
struct SampleResult {
  Rgb radiance;      ///< not weighted
  bool negative;     ///< drawn from the filter's negative part
  int surface = -1;  ///< that the camera ray met: spheres, then planes; -1 none
};

namespace waves {

inline void copy(const Vec3Chunk& from, std::size_t i, Vec3Chunk& to, std::size_t j) {
  to.x[j] = from.x[i], to.y[j] = from.y[i], to.z[j] = from.z[i];
}
inline Vec3 get(const Vec3Chunk& from, std::size_t i) { return {from.x[i], from.y[i], from.z[i]}; }
inline void put(Vec3 v, Vec3Chunk& to, std::size_t i) {
  to.x[i] = v.x, to.y[i] = v.y, to.z[i] = v.z;
}

/// Pairs of random numbers that a ray takes; kPixel and kLens are the camera's.
enum Dimension : std::uint32_t {
  kPixel,
  kLens,
  kChoice,
  kScatter,
  kDirection,
  kAreaLight,     ///< one of many
  kPointOfLight,  ///< of that one
  kLamp,          ///< one of many
  kLight          ///< of light 0, of the others from there on
};
struct RandomPairs {
  alignas(64) double u[kChunk]{}, v[kChunk]{};
};

struct PreparedMaterial {
  Material material;
  Reflector reflector;
  Rgb specular;                    ///< reflectance times coefficient
  Rgb grazing;                     ///< the most that Schlick's factor adds to it, at grazing angles
  Rgb diffuse;                     ///< reflectance / pi
  bool scatters_to_light = false;  ///< the surface draws directions to some light

  explicit PreparedMaterial(const Material& m);
};

/// Everything that stays the same for a picture.
struct PreparedScene {
  /// Both must outlive it.
  PreparedScene(const Scene& scene, const Plan& plan);

  const Scene& scene;
  const Plan& plan;
  CameraFrame frame;
  FilterSampler filter;
  std::vector<PreparedMaterial> materials;
  std::vector<std::unique_ptr<const PreparedLight>> lights;
  bool any_sized;                                 ///< rays may meet a light
  std::vector<std::size_t> single_lights;         ///< that no tree may stand for
  std::vector<std::size_t> lamps;                 ///< that a tree may stand for, at some points
  std::optional<LightTree> area_tree, lamp_tree;  ///< where the plan draws one of many lights
  std::vector<Tangents> checkers;                 ///< by plane
  std::vector<int> around_camera;                 ///< spheres that some camera rays may start in
  std::unique_ptr<Accelerator> accelerator;       ///< null where a loop is faster
  std::size_t first_of_tree = 0;                  ///< an area light of the tree
  bool one_by_one;  ///< each surface is shaded by itself, with its own occluders
  /// The same for all area lights where one of many is drawn.
  LightStrategy area_strategy(int material) const {
    return plan.strategy[first_of_tree][std::size_t(material)];
  }
  bool all_effects() const { return plan.policy == EffectPolicy::kAll; }
};

/// Rays after the same number of reflections.
struct Wave {
  enum class Kind { kCamera, kMirror, kScattered };
  Kind kind = Kind::kCamera;
  int level = 0;             ///< reflections so far
  Depth left;                ///< how many more of each kind are traced
  bool lights_only = false;  ///< rays to lights: surfaces only hide these
  std::uint32_t branch = 0;  ///< distinguishes the random numbers of a level's waves
  std::size_t count = 0;
  Vec3Chunk origin{}, to_eye{};         ///< rays run opposite to `to_eye`
  alignas(64) double leaves[kChunk]{};  ///< the surface where a ray starts; -1: none
  alignas(64) double distance[kChunk]{}, surface[kChunk]{};  ///< met by a ray; surface -1: none
  Vec3Chunk point{}, normal{};                               ///< there
  std::array<Rgb, kChunk> weight;
  std::array<int, kChunk> slot;  ///< the camera ray that a ray descends from
  /// The density and material of scattered rays, to weigh them against the lights' own draws.
  std::array<double, kChunk> pdf;
  std::array<int, kChunk> material;
  Vec3Chunk normal_at_origin{};  ///< only where one of many area lights is drawn
};

/// Hits of a wave that are shaded together: on one material and, where surfaces are few, on one surface.
struct Hits {
  int material = 0;
  int one_surface = -1;  ///< -1 where the surfaces differ
  std::size_t count = 0;
  Vec3Chunk point{}, normal{}, to_eye{};
  std::array<Rgb, kChunk> weight;
  std::array<int, kChunk> slot, surface;
  std::array<std::uint32_t, kChunk> pixel, index;
};

/// The buffers of one thread.
struct Workspace {
  Work work;
  std::vector<std::unique_ptr<Wave>> waves;        ///< by place_of()
  std::array<std::uint32_t, kChunk> pixel, index;  ///< of the camera rays
  std::array<Rgb, kChunk> radiance;                ///< that came back to them
  RandomPairs film, lens;                          ///< where camera rays cross these
  Vec3Chunk center{};                              ///< of the spheres that are met
  alignas(64) double radius[kChunk]{};
  std::vector<int> keys;  ///< of the groups of hits, and their sizes and places
  std::vector<std::size_t> group_size, group_begin, group_next;
  Hits hits;
  RandomPairs random;
  LightSamples drawn;  ///< towards a light, one for each hit
  LightMeetings met;
  std::array<EnvironmentLook, kChunk> looks;     ///< of work.looking
  std::array<LightTree::Choice, kChunk> chosen;  ///< one of many lights, for each hit
  std::vector<std::uint16_t> by_light;           ///< hits, sorted by it
  std::vector<int> looking;  ///< rays that may meet one of many lights, or the sky
  // The subset of hits or rays for which one of many lights was chosen.
  Vec3Chunk part_point{}, part_to_eye{};
  RandomPairs part_random;
  LightSamples part_drawn;
  alignas(64) double visible[kChunk]{}, specular[kChunk]{}, n_dot_l[kChunk]{}, fresnel[kChunk]{};
  Vec3Chunk scattered{};

  static std::size_t place_of(int level, Wave::Kind kind) {
    return 2 * std::size_t(level) + (kind == Wave::Kind::kScattered);
  }
  Wave& wave_at(int level, Wave::Kind kind) { return *waves[place_of(level, kind)]; }
  Wave& new_wave(int level, Wave::Kind kind);
  /// A pair of random numbers for each hit, in `random`.
  void draw(const Wave& wave, std::uint32_t dimension) {
    kernels().random(hits.count, hits.pixel.data(), hits.index.data(), dimension ^ wave.branch,
                     random.u, random.v);
  }
};

/// Renders at most kChunk samples, with one result for each.
void render(const PreparedScene& prepared, std::span<const PixelSample> samples,
            std::span<SampleResult> results, Workspace& work);

// The steps of render(), by file.

/// camera_rays.cpp: one ray for each sample.
void start(const PreparedScene& prepared, std::span<const PixelSample> samples,
           std::span<SampleResult> results, Wave& wave, Workspace& work);

/// surfaces.cpp: finds the surface that each ray meets, and the material there. hide() sets the factor in work.drawn
/// to 0 for hits that the light is hidden from.
void trace(const PreparedScene& prepared, Wave& wave, Workspace& work);
int material_at(const PreparedScene& prepared, const Wave& wave, std::size_t ray);
void hide(const PreparedScene& prepared, std::size_t light, Workspace& work);
/// The same for the light of work.chosen at each hit.
void hide_chosen(const PreparedScene& prepared, Workspace& work);

/// lighting.cpp: adds the radiance of lights that rays cross or end in, and the light that the hits reflect.
void add_met_lights(const PreparedScene& prepared, const Wave& wave, Workspace& work);
void light_hits(const PreparedScene& prepared, const Wave& wave, Workspace& work);

/// onward_rays.cpp: empties the waves that follow this one, then adds the rays that go on from the hits.
void start_onward(const Wave& wave, Workspace& work);
void spawn_onward(const PreparedScene& prepared, const Wave& wave, Workspace& work);

}  // namespace waves
}  // namespace lobelia
