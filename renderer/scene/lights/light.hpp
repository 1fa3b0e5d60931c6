// The interface of a light. Each light is one file in this folder and one line in catalogue.hpp.
//
// A light is a plain structure of its parameters. Its file has the table of these parameters, which drives the
// reader, the writer and the page of the scene format; where the light is; the lamps that stand for it in the
// reference engines; and, below, the same light for registers of rays, which prepared_light.cpp alone compiles,
// once for each instruction set.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "core/image.hpp"
#include "core/parameter.hpp"
#include "core/vec.hpp"
#include "renderer/scene/lights/lamp.hpp"
#include "renderer/scene/ranges.hpp"

namespace lobelia {

enum class LightKind : std::uint8_t {
  kDelta,        ///< light from a single direction at each point
  kArea,         ///< a shining surface. Rays pass through it and take up its radiance.
  kEnvironment,  ///< light from everywhere, infinitely far away
};

struct LightInfo {
  std::string_view type;  ///< in a scene file: <emitter type="sphere">
  std::string_view meaning;
  LightKind kind;
  bool varies = false;         ///< of an environment: its radiance depends on the direction
  std::string_view note = {};  ///< printed below the tables of the scene format
};

/// A parameter and the member that holds it.
template <class L>
struct LightParameter {
  Parameter parameter;
  std::variant<double L::*, Vec3 L::*, Rgb L::*, std::string L::*> member;
  bool is_optional = false;  ///< a vector that is not written where it is zero
};

/// The radiance of a light with a size.
inline constexpr Parameter kLightRadiance{
    "radiance",   ParameterType::kRgb,          "1", 0, kBrightest,
    "W/(m^2 sr)", "the same in every direction"};

/// The element that a light is read from, for what its table cannot say.
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

/// Where a light is.
struct LightBounds {
  enum { kBall, kFar, kEverywhere } kind;
  Vec3
      at;  ///< the centre of a ball around the light, or the unit vector to a light that is far away
  double radius = 0;
  bool is_ball = false;  ///< the light is that ball, and not only in it
};

/// A direction drawn towards an environment.
struct DirectionSample {
  Vec3 to_light;   ///< unit
  double pdf = 0;  ///< per steradian; 0 where there is nothing to draw
  Rgb radiance;    ///< that arrives along it
};

/// An environment's radiance in a direction, and the density with which it draws that direction.
struct EnvironmentLook {
  Rgb radiance;
  double pdf;
};

/// The light with what is worked out once for a picture; most need nothing.
template <class L>
struct ReadyLight {
  using Type = L;
};
template <class L>
requires requires { typename L::Ready; }
struct ReadyLight<L> {
  using Type = typename L::Ready;
};

/// May also have finish(LightSource&), which checks and completes what the table has read.
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
  /// A random point of it: the average of these lamps is the light.
  { light.lamp(u, u) } -> std::same_as<Lamp>;
  /// A single lamp of the same power.
  { light.whole_lamp() } -> std::same_as<Lamp>;
  /// Along a ray of unit direction to where it meets the shining side; infinite where it misses.
  { light.distance(v, v) } -> std::same_as<double>;
  /// How far it reaches from its centre along a unit vector, to either side.
  { light.reach_along(v) } -> std::same_as<double>;
};

template <class L>
concept EnvironmentLight =
    AnyLight<L> &&
    L::kInfo.kind == LightKind::kEnvironment&& requires(const typename ReadyLight<L>::Type& ready,
                                                        Vec3 direction, double u) {
  { ready.sample(u, u) } -> std::same_as<DirectionSample>;
  { ready.look(direction) } -> std::same_as<EnvironmentLook>;
};

template <class L>
concept LightType = DeltaLight<L> || AreaLight<L> || EnvironmentLight<L>;

}  // namespace lobelia
