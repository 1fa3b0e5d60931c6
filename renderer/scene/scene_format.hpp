// The scene format as data: the elements and their parameters. The reader checks against these tables, and
// docs/scene_format.md is printed from them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/pictures/image.hpp"
#include "renderer/highlight.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/xml_format.hpp"

namespace lobelia {

inline constexpr std::string_view kSceneFormatVersion = "1";
inline constexpr std::size_t kMaxSceneBytes = 64u << 20;
inline constexpr int kMaxLights = 1 << 16;
inline constexpr int kMaxEnvironments =
    64;  ///< of the lights: each is looked at by every ray that leaves the scene
/// Lights times spheres and planes: each light is looked for on and in each of these.
inline constexpr std::int64_t kMaxLightsTimesShapes = std::int64_t{1} << 28;
inline constexpr int kMaxSpheres = 1 << 22;  ///< with those of lattices
inline constexpr int kMaxPlanes = 16;
inline constexpr int kMaxMaterials = 1024;
inline constexpr int kMaxDepth = 64;
/// The limit for a film. A picture over kMaxImagePixels is rendered in rows and never held in memory.
inline constexpr std::int64_t kMaxFilmPixels = std::int64_t{1} << 28;
/// Why the film's picture is too large to be held in memory, in words; empty if it is not.
std::string whole_picture_problem(const Film& film);
/// The mirror depth of a scene with a mirror that does not give one.
inline constexpr int kDefaultMirrorDepth = 8;

inline constexpr Parameter kFieldOfView{"fov",     ParameterType::kFloat,          "", 1e-3, 179,
                                        "degrees", "full horizontal angle of view"};
inline constexpr double kMostOffset = 10;
inline constexpr Parameter kOffsetX{
    "principal_point_offset_x",
    ParameterType::kFloat,
    "0",
    -kMostOffset,
    kMostOffset,
    "film widths",
    "how far right of the film's centre the view from origin to target meets it"};
inline constexpr Parameter kOffsetY{"principal_point_offset_y",
                                    ParameterType::kFloat,
                                    "0",
                                    -kMostOffset,
                                    kMostOffset,
                                    "film heights",
                                    "how far above it"};
inline constexpr Parameter kPerspectiveParameters[] = {kFieldOfView, kOffsetX, kOffsetY};
inline constexpr Parameter kThinLensParameters[] = {
    kFieldOfView,
    {"aperture_radius", ParameterType::kFloat, "0", 0, kFar, "", "of the lens; 0 is a pinhole"},
    {"focus_distance", ParameterType::kFloat, "", kNear, kFar, "",
     "along the view, of the plane that is sharp"},
    kOffsetX,
    kOffsetY,
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
inline constexpr Parameter kSphereParameters[] = {
    {"center", ParameterType::kPoint, "0, 0, 0", -kFar, kFar, "", "its centre"},
    {"radius", ParameterType::kFloat, "1", kNear, kFar, "", "its radius"},
};
inline constexpr Parameter kIntegratorParameters[] = {
    {"mirror_depth", ParameterType::kInteger, "0", 0, kMaxDepth, "",
     "how often light may go on by a mirror"},
    {"glossy_depth", ParameterType::kInteger, "0", 0, kMaxDepth, "",
     "how often by a highlight or a diffuse base"},
};
inline constexpr Parameter kPlaneParameters[] = {
    {"point", ParameterType::kPoint, "0, 0, 0", -kFar, kFar, "", "on the plane"},
    {"normal", ParameterType::kVector, "0, 1, 0", -kFar, kFar, "", "to either side"},
    {"checker_size", ParameterType::kFloat, "1", kNear, kFar, "",
     "side of a square, where it has two materials"},
};
inline constexpr int kMaxLatticeSide = 1024;
inline constexpr Parameter kLatticeParameters[] = {
    {"columns", ParameterType::kInteger, "", 1, kMaxLatticeSide, "spheres", "along x"},
    {"rows", ParameterType::kInteger, "1", 1, kMaxLatticeSide, "spheres", "along y"},
    {"layers", ParameterType::kInteger, "1", 1, kMaxLatticeSide, "spheres", "along z"},
    {"step", ParameterType::kVector, "", 0, kFar, "",
     "from centre to centre along x, y, z; over 0 where there is more than one sphere"},
    {"center", ParameterType::kPoint, "0, 0, 0", -kFar, kFar, "", "of the whole lattice"},
    {"radius", ParameterType::kFloat, "1", kNear, kFar, "", "of each sphere"},
    {"jitter", ParameterType::kFloat, "0", 0, 1, "",
     "moves each centre along x, y, z by up to this part of step / 2 - radius"},
    {"seed", ParameterType::kInteger, "0", 0, 9007199254740992.0, "", "chooses the moves"},
};
inline constexpr std::string_view kNoFormula = "none";
inline constexpr Parameter kHighlightParameters[] = {
    {"lobe", ParameterType::kString, "cosine", 0, 0, "", "shape of the highlight"},
    {"formula", ParameterType::kString, kNoFormula, 0, 0, "",
     "of the lobe expression, and of no other"},
    {"normalisation", ParameterType::kString, "exact", 0, 0, "",
     "where its coefficient comes from"},
    {"exponent", ParameterType::kFloat, "", kMinExponent, kMaxExponent, "", "sharpness n"},
    {"fresnel", ParameterType::kString, "none", 0, 0, "",
     "schlick: the reflectances of highlight and mirror are those at normal incidence, and grow to 1"},
    {"specular_reflectance", ParameterType::kRgb, "1", 0, 1, "", "scales the highlight"},
    {"diffuse_reflectance", ParameterType::kRgb, "0", 0, 1, "", "Lambertian albedo beneath it"},
    {"mirror_reflectance", ParameterType::kRgb, "0", 0, 1, "",
     "of a perfect mirror on top; with schlick below 0.02 it grows to 50 times its largest component only, "
     "so that 0 is no mirror at any angle"},
};

/// GGX has no lobe and no exponent to choose; the rest is a highlight's.
inline constexpr Parameter kGgxParameters[] = {
    {"roughness", ParameterType::kFloat, "1", kLeastRoughness, 1, "",
     "alpha is its square; or give alpha"},
    {"alpha", ParameterType::kFloat, "1", kLeastAlpha, 1, "", "in place of roughness"},
    {"fresnel", ParameterType::kString, "schlick", 0, 0, "", kHighlightParameters[4].meaning},
    {"specular_reflectance", ParameterType::kRgb, "1", 0, 1, "",
     "F0: 0.04 for most plastics, the colour of a metal"},
    kHighlightParameters[6],
    kHighlightParameters[7],
};

inline constexpr ElementFormat kPerspective{"sensor", "perspective", "the camera",
                                            kPerspectiveParameters};
inline constexpr ElementFormat kThinLens{"sensor", "thinlens", "a camera with a lens, and its blur",
                                         kThinLensParameters};
inline constexpr ElementFormat kSensors[] = {kPerspective, kThinLens};
inline constexpr ElementFormat kFilm{"film", "hdrfilm", "size of the picture; inside the sensor",
                                     kFilmParameters};
inline constexpr ElementFormat kSampler{"sampler", "independent", "rays a pixel; inside the sensor",
                                        kSamplerParameters};
inline constexpr ElementFormat kSphere{"shape", "sphere", "a sphere", kSphereParameters};
inline constexpr ElementFormat kPlane{"shape", "plane", "an infinite plane, plain or a checker",
                                      kPlaneParameters};
inline constexpr ElementFormat kLattice{"shape", "sphere_lattice",
                                        "columns x rows x layers spheres", kLatticeParameters};
inline constexpr ElementFormat kShapes[] = {kSphere, kPlane, kLattice};
inline constexpr ElementFormat kIntegrator{"integrator", "path", "how far light is followed",
                                           kIntegratorParameters};

/// <emitter type="..."> for every light, in the order of their catalogue.
std::span<const ElementFormat> emitter_formats();
/// <rfilter type="FILTER"> for every filter, with its own default radius.
std::span<const ElementFormat> filter_formats();
/// <bsdf type="MODEL"> for every model.
std::span<const ElementFormat> material_formats();

/// Every element but the parameters, <scene> first.
std::span<const XmlElement> scene_elements();

/// The allowed values of a string parameter, for messages and tables; "" for a number.
std::string string_choices(const Parameter& parameter);

/// All of docs/scene_format.md; a test compares the file with it.
std::string scene_format_document();
/// All of docs/reference/scene.xsd.
std::string scene_schema();

}  // namespace lobelia
