// Light from everywhere, infinitely far away, given by a picture of the sky by latitude and longitude: the top row
// is +y, the middle column -z, and +x a quarter of the width to its right.
#pragma once

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

  struct Ready : EnvmapTable {
    explicit Ready(const EnvmapLight& light) : EnvmapTable(light.image, light.radiance) {}
  };

  /// The file stands for the picture.
  bool operator==(const EnvmapLight& other) const {
    return radiance == other.radiance && file == other.file && !image == !other.image;
  }
};
static_assert(LightType<EnvmapLight>);

}  // namespace lobelia
