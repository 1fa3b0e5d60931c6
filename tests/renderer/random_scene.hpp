// Scenes at random, each from one 64-bit seed, for laws that hold of every scene. A scene that breaks a law is
// made smaller while it still does, and is printed as the file that repeats it.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <string_view>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Up to so many samples a pixel. Above 16 a picture may leave some out where it looks even, and is another one
/// than that of all effects by as much.
inline constexpr int kMostRandomSamples = 16;

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  std::uint64_t bits() { return bits_(); }
  double even() { return double(bits_() >> 11) * 0x1p-53; }  ///< in [0, 1)
  double between(double low, double high) { return low + (high - low) * even(); }
  double log_between(double low, double high) { return low * std::pow(high / low, even()); }
  int below(int count) { return int(bits_() % std::uint64_t(count)); }
  bool chance(double p) { return even() < p; }
  template <class T>
  T one_of(std::span<const T> choices) {
    return choices[std::size_t(below(int(choices.size())))];
  }
  Vec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  Vec3 direction();

 private:
  std::mt19937_64 bits_;
};

enum class SceneKind {
  kExact,  ///< no light with a size that shines, no lens, one sample, no inter-reflection: nothing is random
  kAny,
};

/// Every material, light, camera, depth and effect has its chance. The scene is what its own text
/// (scene_to_xml) reads back as, but for an environment's picture, sky().
Scene random_scene(std::uint64_t seed, SceneKind kind);

/// The picture of every random environment: dim, with a small sun.
std::shared_ptr<const Image> sky();

/// The fault of a scene, in words; empty where there is none.
using SceneLaw = std::function<std::string(const Scene& scene, Random& random)>;

/// Holds `count` scenes to the law. Of the first that breaks it, the test fails with its seed, what is wrong and
/// the smallest scene that still is. From the environment, for `make fuzz`: LOBELIA_RANDOM_SEED, of the first
/// scene; LOBELIA_RANDOM_SECONDS, to go on for so long; LOBELIA_RANDOM_FINDS, a folder for scenes that break a
/// law.
void expect_of_random_scenes(SceneKind kind, int count, const SceneLaw& law);

/// The smallest scene that the search finds for which `fails` is still true.
Scene shrunk(Scene scene, const std::function<bool(const Scene&)>& fails);

}  // namespace lobelia
