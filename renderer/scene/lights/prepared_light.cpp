#include "renderer/scene/lights/prepared_light.hpp"

#include "base/system/error.hpp"

#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC  // see kernels.cpp
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/scene/lights/prepared_light.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/geometry-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

HWY_INLINE Lanes choose(Mask mask, Lanes yes, Lanes no) {
  return Lanes(hn::IfThenElse(mask, yes.v, no.v));
}
HWY_INLINE Lanes clamp(Lanes x, Lanes low, Lanes high) {
  return Lanes(hn::Min(hn::Max(x.v, low.v), high.v));
}

/// Light from a point to each of some points: with_direction(factor, to_light) is the factor with what depends on the
/// direction.
template <class WithDirection>
HWY_INLINE void sample_point(Vec3 position, std::size_t count, const Vec3Chunk& point,
                             LightSamples& drawn, const WithDirection& with_direction) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    Lanes3 to_light;
    Lanes factor, distance;
    to_point_light(broadcast(position), load(point, i), to_light, factor, distance);
    store(to_light, drawn.to_light, i);
    with_direction(factor, to_light).store(drawn.factor + i);
    distance.store(drawn.distance + i);
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// Again, with the second halves of the files of lights.
#define LOBELIA_LIGHT_KERNELS
#include "renderer/scene/lights/catalogue.hpp"
#undef LOBELIA_LIGHT_KERNELS

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

[[noreturn]] void refuse(const char* why) { throw Error(ExitCode::kInternal, why); }

template <class L>
class PreparedLightOf final : public PreparedLight {
  static constexpr LightKind kKind = L::kInfo.kind;

 public:
  explicit PreparedLightOf(const L& light) : light_(light), ready_(light) {}

  void sample(std::size_t count, const Vec3Chunk& point, const double* u, const double* v,
              LightSamples& drawn) const override {
    if constexpr (kKind == LightKind::kDelta)
      sample_light(light_, count, point, drawn);
    else if constexpr (kKind == LightKind::kArea)
      sample_light(ready_, count, point, u, v, drawn);
    else
      for (std::size_t i = 0; i < count; ++i) {
        const DirectionSample one = ready_.sample(u[i], v[i]);
        drawn.to_light.x[i] = one.to_light.x;
        drawn.to_light.y[i] = one.to_light.y;
        drawn.to_light.z[i] = one.to_light.z;
        drawn.factor[i] = one.pdf > 0 ? 1 / one.pdf : 0;  // a density may underflow
        drawn.distance[i] = kInfinity;
        if constexpr (L::kInfo.varies) drawn.radiance[i] = one.radiance;
      }
  }

  void sample_bright(std::size_t count, const double* u, const double* v,
                     LightSamples& drawn) const override {
    if constexpr (kKind == LightKind::kEnvironment)
      HWY_NAMESPACE::sample_bright(ready_, count, u, v, drawn);
    else
      refuse("only environments have a bright part");
  }

  bool has_bright() const override {
    if constexpr (kKind == LightKind::kEnvironment)
      return ready_.has_bright();
    else
      return false;
  }

  void meet(std::size_t count, const Vec3Chunk& origin, const Vec3Chunk& to_eye, bool densities,
            LightMeetings& met) const override {
    if constexpr (kKind == LightKind::kArea)
      meet_light(ready_, count, origin, to_eye, densities, met);
    else
      refuse("only area lights are met by rays");
  }

  void look(std::size_t count, const Vec3Chunk& to_eye, EnvironmentLook* looks) const override {
    if constexpr (kKind == LightKind::kEnvironment)
      look_at(ready_, count, to_eye, looks);
    else
      refuse("only environments are looked at");
  }

  EnvironmentLook look(Vec3 direction) const override {
    if constexpr (kKind == LightKind::kEnvironment)
      return ready_.look(direction);
    else
      refuse("only environments are looked at");
  }

  Lamp lamp(double u, double v) const override {
    if constexpr (kKind == LightKind::kDelta) {
      return light_.lamp();
    } else if constexpr (kKind == LightKind::kArea) {
      return light_.lamp(u, v);
    } else {
      const DirectionSample drawn = ready_.sample(u, v);
      if (!(drawn.pdf > 0)) return Lamp::distant({0, 0, -1}, {});
      return Lamp::distant(-drawn.to_light, 1 / drawn.pdf * drawn.radiance);
    }
  }

  double distance(Vec3 origin, Vec3 direction) const override {
    if constexpr (kKind == LightKind::kArea)
      return light_.distance(origin, direction);
    else
      refuse("only area lights are met by rays");
  }

 private:
  L light_;
  typename ReadyLight<L>::Type ready_;
};

}  // namespace

std::unique_ptr<const PreparedLight> prepare_light(const Light& light) {
  return std::visit(
      []<class L>(const L& l) -> std::unique_ptr<const PreparedLight> {
        return std::make_unique<PreparedLightOf<L>>(l);
      },
      light);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(prepare_light);

std::unique_ptr<const PreparedLight> prepare(const Light& light) {
  return HWY_DYNAMIC_DISPATCH(prepare_light)(light);
}

std::vector<std::unique_ptr<const PreparedLight>> prepare(const std::vector<Light>& lights) {
  std::vector<std::unique_ptr<const PreparedLight>> prepared;
  for (const Light& light : lights) prepared.push_back(prepare(light));
  return prepared;
}

}  // namespace lobelia
#endif
