// The interface of a light. Each light is one file in this folder and one line in catalogue.hpp.
//
// A light is a plain structure of its parameters. Its file has the table of these parameters, for the reader, the
// writer and the page of the scene format; where the light is; the lamps that stand for it in the reference
// engines; and last the light for registers of rays, which only prepared_light.cpp compiles, once for each
// instruction set.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "base/pictures/image.hpp"
#include "base/words/constants.hpp"
#include "base/words/vec.hpp"
#include "renderer/scene/parameter.hpp"

namespace lobelia {

// Bounds of the numbers in a scene.
inline constexpr double kFar = 1e9;        ///< of every coordinate and length
inline constexpr double kNear = 1e-9;      ///< the least size
inline constexpr double kBrightest = 1e9;  ///< of every irradiance, intensity and radiance

/// The cone of a spot, in degrees from its middle.
struct SpotCone {
  double beam = 0, cutoff = 0;
  double least_cosine() const { return std::cos(cutoff * kPi / 180); }
  /// cos(beam) - cos(cutoff), from sines, so that a narrow cone keeps its digits.
  double cosine_step() const {
    return 2 * std::sin((cutoff + beam) * kPi / 360) * std::sin((cutoff - beam) * kPi / 360);
  }
  /// The share of the intensity at this cosine from the middle: a smooth step.
  double share(double cosine) const {
    const double t = std::clamp((cosine - least_cosine()) / cosine_step(), 0.0, 1.0);
    return t * t * (3 - 2 * t);
  }
};

/// A light without a size. Every light turns into lamps for the reference engines, the formulas per pixel and the
/// fused kernels.
struct Lamp {
  bool is_distant = false;  ///< parallel light, from infinitely far away
  Vec3 position;            ///< of a near lamp
  Vec3 direction;           ///< of the light of a distant lamp, unit length
  Rgb strength;             ///< intensity, or irradiance of a distant lamp
  Vec3 normal = {};         ///< as PointLight::normal; the middle of a spot
  std::optional<SpotCone> spot = {};

  bool has_normal() const { return dot(normal, normal) > 0; }

  static Lamp near(Vec3 position, Rgb intensity, Vec3 normal = {}) {
    return {false, position, {}, intensity, normal};
  }
  static Lamp distant(Vec3 direction, Rgb irradiance) { return {true, {}, direction, irradiance}; }
};

/// The unit vector from a point to the lamp, the irradiance on a plane normal to that vector, and the distance.
struct Illumination {
  Vec3 to_light;
  Rgb irradiance;
  double distance = 0;  ///< infinite for a distant lamp
};

inline Illumination illuminate(const Lamp& lamp, Vec3 point) {
  if (lamp.is_distant) return {-lamp.direction, lamp.strength, kInfinity};
  const Vec3 offset = lamp.position - point, to_light = normalize(offset);
  const double along = -dot(lamp.normal, to_light);
  const double towards = lamp.spot           ? lamp.spot->share(along)
                         : lamp.has_normal() ? std::max(0.0, along)
                                             : 1;
  return {to_light, towards / dot(offset, offset) * lamp.strength, length(offset)};
}

enum class LightKind : std::uint8_t {
  kDelta,        ///< light from a single direction at each point
  kArea,         ///< a shining surface; rays pass through it and take up its radiance
  kEnvironment,  ///< light from everywhere, infinitely far away
};

struct LightInfo {
  std::string_view type;  ///< in a scene file: <emitter type="sphere">
  std::string_view meaning;
  LightKind kind;
  bool varies = false;         ///< an environment with a radiance that depends on the direction
  std::string_view note = {};  ///< printed below the tables of the scene format
};

/// A parameter and the member that holds it.
template <class L>
struct LightParameter {
  Parameter parameter;
  std::variant<double L::*, Vec3 L::*, Rgb L::*, std::string L::*> member;
  bool is_optional = false;  ///< a vector that is not written if it is zero
};

/// The radiance of a light with a size.
inline constexpr Parameter kLightRadiance{
    "radiance",   ParameterType::kRgb,          "1", 0, kBrightest,
    "W/(m^2 sr)", "the same in every direction"};

/// The element that a light is read from, for checks beyond its table.
class LightSource {
 public:
  virtual ~LightSource() = default;
  /// Whether the element has the parameter, without an error in it.
  virtual bool has(std::string_view parameter) const = 0;
  /// Reports an error at a parameter's value, or at the element where `parameter` is empty.
  virtual void error(std::string_view parameter, const std::string& message) = 0;
  /// The picture that a parameter names; null after an error.
  virtual std::shared_ptr<const Image> picture(std::string_view parameter) = 0;
};

/// The place of a light.
struct LightBounds {
  enum { kBall, kFar, kEverywhere } kind;
  Vec3 at;  ///< centre of a ball around the light; unit vector to a far light
  double radius = 0;
  bool is_ball = false;  ///< the light fills the ball
};

/// A direction drawn towards an environment.
struct DirectionSample {
  Vec3 to_light;   ///< unit
  double pdf = 0;  ///< per steradian; 0 if there is nothing to draw
  Rgb radiance;    ///< that arrives along it
};

/// An environment in a direction. Its radiance has two parts.
struct EnvironmentLook {
  Rgb smooth;      ///< that a surface samples well
  Rgb bright;      ///< that the environment draws itself
  double pdf = 0;  ///< of drawing this direction to the bright part, per steradian

  Rgb radiance() const { return smooth + bright; }
};

/// The light with the constants of a picture, L::Ready if it has any.
template <class L>
struct ReadyLight {
  using Type = L;
};
template <class L>
requires requires { typename L::Ready; }
struct ReadyLight<L> {
  using Type = typename L::Ready;
};

/// May also have finish(LightSource&), to check and complete the parameters after reading.
template <class L>
concept AnyLight = std::equality_comparable<L> && requires(const L& light) {
  { L::kInfo } -> std::convertible_to<const LightInfo&>;
  { L::parameters()[0] } -> std::convertible_to<LightParameter<L>>;
  /// Irradiance, intensity or radiance.
  { light.strength() } -> std::same_as<Rgb>;
  { light.bounds() } -> std::same_as<LightBounds>;
};

/// For registers: sample_light(light, count, point, drawn).
template <class L>
concept DeltaLight = AnyLight<L> && L::kInfo.kind == LightKind::kDelta&& requires(const L& light) {
  { light.lamp() } -> std::same_as<Lamp>;
};

/// For registers: sample_light(ready, count, point, u, v, drawn) and
/// meet_light(ready, count, origin, to_eye, densities, met).
template <class L>
concept AreaLight = AnyLight<L> &&
                    L::kInfo.kind == LightKind::kArea&& requires(const L& light, Vec3 v, double u) {
  /// A random point of the light. The average of these lamps is the light.
  { light.lamp(u, u) } -> std::same_as<Lamp>;
  /// A single lamp of the same power.
  { light.whole_lamp() } -> std::same_as<Lamp>;
  /// Distance along a ray of unit direction to the shining side; infinite if it misses.
  { light.distance(v, v) } -> std::same_as<double>;
  /// Half of its extent along a unit vector.
  { light.reach_along(v) } -> std::same_as<double>;
};

/// For registers: look_at(ready, count, to_eye, looks), against `to_eye`; and where it has a bright part,
/// sample_bright(ready, count, u, v, drawn).
template <class L>
concept EnvironmentLight =
    AnyLight<L> &&
    L::kInfo.kind == LightKind::kEnvironment&& requires(const typename ReadyLight<L>::Type& ready,
                                                        Vec3 direction, double u) {
  { ready.sample(u, u) } -> std::same_as<DirectionSample>;
  { ready.has_bright() } -> std::same_as<bool>;
  { ready.look(direction) } -> std::same_as<EnvironmentLook>;
};

template <class L>
concept LightType = DeltaLight<L> || AreaLight<L> || EnvironmentLight<L>;

}  // namespace lobelia
