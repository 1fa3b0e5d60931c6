// Light from everywhere, infinitely far away, given by a picture of the sky by latitude and longitude: the top row
// is +y, the middle column -z, and +x a quarter of the width to its right.
#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_ENVMAP_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_ENVMAP_HPP

#include <mutex>
#include <optional>

#include "renderer/scene/lights/envmap_table.hpp"
#include "renderer/scene/lights/light.hpp"

namespace lobelia {

struct EnvmapLight {
  Rgb radiance;                        ///< scales the picture, >= 0
  std::shared_ptr<const Image> image;  ///< scene-linear, finite, >= 0, W/(m^2 sr)
  std::string file;                    ///< the picture, as the scene file names it

  static constexpr LightInfo kInfo{
      .type = "envmap",
      .meaning = "light from everywhere, by a picture",
      .kind = LightKind::kEnvironment,
      .varies = true,
      .note =
          "Several `constant` and `envmap` emitters add up. The picture of an envmap lies in the "
          "directory\n"
          "of the scene file or below it; its values are finite and not negative. It has at most "
          "16777216\n"
          "pixels, and 16 more for each byte of its file.\n"};
  static constexpr auto parameters() {
    return std::to_array<LightParameter<EnvmapLight>>({
        {{"filename", ParameterType::kString, "", 0, 0, "",
          "by latitude and longitude: the top row is +y, the middle column -z, +x to the right of "
          "it"},
         &EnvmapLight::file},
        {{"radiance", ParameterType::kRgb, "1", 0, kBrightest, "W/(m^2 sr)", "scales the picture"},
         &EnvmapLight::radiance},
    });
  }
  void finish(LightSource& source) { image = source.picture("filename"); }

  Rgb strength() const { return radiance; }
  LightBounds bounds() const { return {LightBounds::kEverywhere, {}}; }

  class Ready {
   public:
    explicit Ready(const EnvmapLight& light)
        : image_(light.image),
          scale_(light.radiance),
          bright_(image_, scale_, smooth_luminance(*image_)) {}
    DirectionSample sample(double u, double v) const {
      std::call_once(once_, [this] { whole_.emplace(image_, scale_, 0.0); });
      return whole_->sample(u, v);
    }
    bool has_bright() const { return !bright_.is_black(); }
    const EnvmapTable& bright() const { return bright_; }
    EnvironmentLook look(Vec3 direction) const { return bright_.look(direction); }

   private:
    std::shared_ptr<const Image> image_;
    Rgb scale_;
    EnvmapTable bright_;
    /// For lamps and studies, made when it is used.
    mutable std::once_flag once_;
    mutable std::optional<EnvmapTable> whole_;
  };

  /// The file stands for the picture.
  bool operator==(const EnvmapLight& other) const {
    return radiance == other.radiance && file == other.file && !image == !other.image;
  }
};
static_assert(LightType<EnvmapLight>);

}  // namespace lobelia

#endif

#ifdef LOBELIA_LIGHT_KERNELS
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

/// The angle from +x to (x, y), from -pi to pi.
HWY_INLINE Lanes angle_of(Lanes y, Lanes x) {
  const hn::ScalableTag<double> d;
  const auto up = hn::Abs(y.v), aside = hn::Abs(x.v);
  const auto large = hn::Max(hn::Max(up, aside), hn::Set(d, 1e-300));
  auto angle = hn::Atan(d, hn::Div(hn::Min(up, aside), large));
  angle = hn::IfThenElse(hn::Gt(up, aside), hn::Sub(hn::Set(d, kPi / 2), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x.v, hn::Zero(d)), hn::Sub(hn::Set(d, kPi), angle), angle);
  return Lanes(hn::CopySign(angle, y.v));
}

inline void look_at(const EnvmapLight::Ready& light, std::size_t count, const Vec3Chunk& to_eye,
                    EnvironmentLook* looks) {
  const hn::ScalableTag<double> d;
  const EnvmapTable& sky = light.bright();
  alignas(64) double column[kChunk], row[kChunk], squared_sine[kChunk];
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 eye = load(to_eye, i);
    const Lanes turn = angle_of(-eye.x, eye.z);
    const Lanes polar(hn::Acos(d, clamp(-eye.y, Lanes(-1.0), Lanes(1.0)).v));
    ((Lanes(0.5) + Lanes(1 / (2 * kPi)) * turn) * Lanes(double(sky.width()))).store(column + i);
    (Lanes(sky.height() / kPi) * polar).store(row + i);
    (eye.x * eye.x + eye.z * eye.z).store(squared_sine + i);
  }
  for (std::size_t i = 0; i < count; ++i) sky.prefetch({column[i], row[i]});
  for (std::size_t i = 0; i < count; ++i)
    looks[i] = sky.look(EnvmapTable::Place{column[i], row[i]}, squared_sine[i]);
}

inline void sample_bright(const EnvmapLight::Ready& light, std::size_t count, const double* u,
                          const double* v, LightSamples& drawn) {
  const hn::ScalableTag<double> d;
  const EnvmapTable& sky = light.bright();
  alignas(64) double turn[kChunk], polar[kChunk];
  for (std::size_t i = 0; i < count; ++i) {
    const EnvmapTable::Draw one = sky.draw(u[i], v[i]);
    turn[i] = sky.turn(one.place);
    polar[i] = sky.polar_angle(one.place);
    drawn.factor[i] = one.density > 0 ? 1 / one.density : 0;  // a density may underflow
    drawn.distance[i] = kInfinity;
    drawn.radiance[i] = one.radiance;
  }
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const auto turned = hn::LoadU(d, turn + i), down = hn::LoadU(d, polar + i);
    const Lanes sine(hn::Sin(d, down));
    store({sine * Lanes(hn::Sin(d, turned)), Lanes(hn::Cos(d, down)),
           -(sine * Lanes(hn::Cos(d, turned)))},
          drawn.to_light, i);
    (sine * Lanes::load(drawn.factor + i)).store(drawn.factor + i);
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
