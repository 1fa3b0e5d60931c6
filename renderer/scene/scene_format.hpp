// The scene format as data: which elements there are, and which parameters each takes. The reader
// checks against these tables and docs/scene_format.md is printed from them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/image.hpp"
#include "core/parameter.hpp"
#include "renderer/highlight.hpp"

namespace lobelia {

inline constexpr std::string_view kSceneFormatVersion = "1";
inline constexpr std::size_t kMaxSceneBytes = 16u << 20;
inline constexpr int kMaxLights = 64;
inline constexpr int kMaxSpheres = 1024;
inline constexpr int kMaxMaterials = 1024;

inline constexpr double kFar = 1e9;        ///< bound of every coordinate and length
inline constexpr double kBrightest = 1e9;  ///< bound of every irradiance and intensity

inline constexpr Parameter kPerspectiveParameters[] = {
    {"fov", ParameterType::kFloat, "", 1e-3, 179, "degrees", "full horizontal angle of view"},
};
inline constexpr Parameter kFilmParameters[] = {
    {"width", ParameterType::kInteger, "256", 1, kMaxImageSide, "pixels", "width of the picture"},
    {"height", ParameterType::kInteger, "256", 1, kMaxImageSide, "pixels", "height of the picture"},
};
inline constexpr Parameter kSamplerParameters[] = {
    {"sample_count", ParameterType::kInteger, "1", 1, 65536, "rays",
     "rays a pixel; 1 is the pixel's centre"},
    {"seed", ParameterType::kInteger, "0", 0, 9007199254740992.0, "",
     "chooses the positions where sample_count is over 1"},
};
inline constexpr Parameter kDirectionalParameters[] = {
    {"direction", ParameterType::kVector, "", -kFar, kFar, "", "where the light travels"},
    {"irradiance", ParameterType::kRgb, "1", 0, kBrightest, "W/m^2",
     "on a plane normal to the direction"},
};
inline constexpr Parameter kPointParameters[] = {
    {"position", ParameterType::kPoint, "", -kFar, kFar, "", "where the light stands"},
    {"intensity", ParameterType::kRgb, "1", 0, kBrightest, "W/sr",
     "irradiance is intensity / distance^2"},
};
inline constexpr Parameter kSphereParameters[] = {
    {"center", ParameterType::kPoint, "0, 0, 0", -kFar, kFar, "", "its centre"},
    {"radius", ParameterType::kFloat, "1", 1e-9, kFar, "", "its radius"},
};
inline constexpr Parameter kHighlightParameters[] = {
    {"lobe", ParameterType::kString, "cosine", 0, 0, "", "shape of the highlight"},
    {"normalisation", ParameterType::kString, "exact", 0, 0, "",
     "where its coefficient comes from"},
    {"exponent", ParameterType::kFloat, "", kMinExponent, kMaxExponent, "", "sharpness n"},
    {"fresnel", ParameterType::kString, "none", 0, 0, "",
     "schlick: the specular reflectance is that at normal incidence, and grows to 1"},
    {"specular_reflectance", ParameterType::kRgb, "1", 0, 1, "", "scales the highlight"},
    {"diffuse_reflectance", ParameterType::kRgb, "0", 0, 1, "", "Lambertian albedo beneath it"},
};

/// An element <tag type="type">.
struct ElementFormat {
  std::string_view tag, type, meaning;
  std::span<const Parameter> parameters;
};

inline constexpr ElementFormat kPerspective{"sensor", "perspective", "the camera",
                                            kPerspectiveParameters};
inline constexpr ElementFormat kFilm{"film", "hdrfilm", "size of the picture; inside the sensor",
                                     kFilmParameters};
inline constexpr ElementFormat kSampler{"sampler", "independent", "rays a pixel; inside the sensor",
                                        kSamplerParameters};
inline constexpr ElementFormat kDirectional{"emitter", "directional", "parallel light",
                                            kDirectionalParameters};
inline constexpr ElementFormat kPoint{"emitter", "point", "a light in a point", kPointParameters};
inline constexpr ElementFormat kSphere{"shape", "sphere", "a sphere", kSphereParameters};

/// What a string parameter may be, as a message or a table lists it; "" for a number.
std::string string_choices(const Parameter& parameter);

/// docs/scene_format.md, whole; a test keeps the file the same as this.
std::string scene_format_document();

}  // namespace lobelia
