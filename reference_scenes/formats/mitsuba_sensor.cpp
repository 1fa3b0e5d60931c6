// The camera of a scene of Mitsuba: sensor, film, filter and sampler.
#include <cmath>
#include <tuple>

#include "reference_scenes/formats/mitsuba.hpp"
#include "reference_scenes/formats/mitsuba_source.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace {

constexpr Parameter kMitsubaSensorParameters[] = {
    {"fov", ParameterType::kFloat, "45", 1e-3, 179, "degrees", ""},
    {"fov_axis", ParameterType::kString, "x", 0, 0, "", ""},
    {"focal_length", ParameterType::kString, "50mm", 0, 0, "", ""},
    {"aperture_radius", ParameterType::kFloat, "0", 0, kFar, "", ""},
    {"focus_distance", ParameterType::kFloat, "10000", kNear, kFar, "", ""},
    {"principal_point_offset_x", ParameterType::kFloat, "0", -kMostOffset, kMostOffset, "", ""},
    {"principal_point_offset_y", ParameterType::kFloat, "0", -kMostOffset, kMostOffset, "", ""},
};
constexpr Parameter kMitsubaFilmParameters[] = {
    {"width", ParameterType::kInteger, "768", 1, kMaxImageSide, "pixels", ""},
    {"height", ParameterType::kInteger, "576", 1, kMaxImageSide, "pixels", ""},
};
constexpr Parameter kMitsubaSamplerParameters[] = {
    {"sample_count", ParameterType::kInteger, "4", 1, 65536, "rays", ""},
    {"seed", ParameterType::kInteger, "0", 0, 9007199254740992.0, "", ""},
};
constexpr Parameter kTentParameters[] = {
    {"radius", ParameterType::kFloat, "1", 0.1, 16, "pixels", ""}};
constexpr Parameter kGaussianParameters[] = {
    {"stddev", ParameterType::kFloat, "0.5", 0.1 / 3, 16.0 / 3, "pixels", ""}};

class MitsubaSensorReader {
 public:
  MitsubaSensorReader(MitsubaSource& file, Scene& scene)
      : file_(file), source_(file.xml()), scene_(scene) {}

  /// Whether the scene has a camera now.
  bool read(pugi::xml_node node) {
    const bool lens = MitsubaSource::type(node) == "thinlens";
    if (!lens && MitsubaSource::type(node) != "perspective") {
      file_.unsupported(node, "perspective and thinlens are");
      return false;
    }
    const Values values =
        file_.values(node, kMitsubaSensorParameters, {"transform", "film", "sampler", "boolean"});
    for (const auto child : node.children("film")) read_film(child);
    for (const auto child : node.children("sampler")) read_sampler(child);
    Camera& camera = scene_.camera;
    if (!read_view(node)) return false;
    const auto fov = horizontal_fov(node, values);
    if (!fov) return false;
    camera.fov_degrees = *fov;
    if (lens) {
      camera.aperture_radius = values.number("aperture_radius");
      camera.focus_distance = values.number("focus_distance");
    }
    // Mitsuba's x is towards the left.
    if (const double x = values.number("principal_point_offset_x"); x != 0)
      camera.principal_point_offset_x = -x;
    camera.principal_point_offset_y = values.number("principal_point_offset_y");
    return true;
  }

 private:
  /// In degrees; nothing after an error.
  std::optional<double> horizontal_fov(pugi::xml_node node, const Values& values) {
    const double aspect = double(scene_.film.width) / scene_.film.height;
    const auto from_diagonal = [&](double half_tangent) {
      return std::atan(half_tangent / std::sqrt(1 + 1 / (aspect * aspect))) * 360 / kPi;
    };
    std::string axis = values["fov_axis"].text;
    if (axis == "smaller") axis = aspect > 1 ? "y" : "x";
    if (axis == "larger") axis = aspect > 1 ? "x" : "y";
    const double given = values.number("fov"), half_tangent = std::tan(given * kPi / 360);
    double fov = 0;
    if (!values["fov"].node) {
      std::string length = values["focal_length"].text;
      if (length.ends_with("mm")) length.resize(length.size() - 2);
      double millimetres = 0;
      if (parse_number(length, millimetres) && millimetres > 0)
        fov = from_diagonal(std::hypot(36, 24) / 2 / millimetres);
    } else if (axis == "x") {
      fov = given;
    } else if (axis == "y") {
      fov = std::atan(half_tangent * aspect) * 360 / kPi;
    } else if (axis == "diagonal") {
      fov = from_diagonal(half_tangent);
    }
    if (fov >= kFieldOfView.min && fov <= kFieldOfView.max) return fov;
    source_.error(node, fmt::format("the horizontal field of view is not {:g} to {:g} degrees",
                                    kFieldOfView.min, kFieldOfView.max));
    return std::nullopt;
  }

  bool read_view(pugi::xml_node sensor) {
    const auto transform = file_.transform(sensor);
    if (!transform) return false;
    Camera& camera = scene_.camera;
    if (transform->lookat) {
      std::tie(camera.origin, camera.target, camera.up) =
          std::tie(transform->lookat->origin, transform->lookat->target, transform->lookat->up);
    } else {
      const Affine& t = transform->matrix;
      if (dot(cross(t.x, t.y), t.z) <= 0) {
        source_.error(sensor, "its transform mirrors the picture, which is not supported");
        return false;
      }
      camera.origin = t.origin;
      camera.target = t.origin + t.z;
      camera.up = t.y;
    }
    const Vec3 view = camera.target - camera.origin;
    if (length(view) > 0 && length(camera.up) > 0 &&
        length(cross(normalize(view), normalize(camera.up))) >= 1e-6)
      return true;
    source_.error(sensor, "its transform gives the camera no view or no upright");
    return false;
  }

  void read_film(pugi::xml_node node) {
    if (MitsubaSource::type(node) != "hdrfilm" && MitsubaSource::type(node) != "ldrfilm")
      file_.unsupported(node, "its size and filter are read as those of hdrfilm");
    const Values values = file_.values(node, kMitsubaFilmParameters, {"rfilter", "boolean"});
    const double width = values.number("width"), height = values.number("height");
    if (width * height > double(kMaxFilmPixels))
      return source_.error(
          node, fmt::format("{} x {} pixels; allowed: {} in all", width, height, kMaxFilmPixels));
    scene_.film.width = int(width);
    scene_.film.height = int(height);
    for (const auto child : node.children("rfilter")) read_filter(child);
  }

  void read_filter(pugi::xml_node node) {
    const std::string_view type = MitsubaSource::type(node);
    if (type == "tent") {
      scene_.film.filter = *find_filter(type);
      scene_.film.filter.radius = file_.values(node, kTentParameters).number("radius");
    } else if (type == "gaussian") {
      scene_.film.filter = *find_filter(type);
      scene_.film.filter.radius =
          kGaussianDeviations * file_.values(node, kGaussianParameters).number("stddev");
    } else if (type == "box" || type == "mitchell") {
      scene_.film.filter = *find_filter(type);
      file_.values(node, {});
    } else {
      file_.unsupported(node, "a Gaussian of half a pixel, Mitsuba's default, is used instead");
    }
  }

  void read_sampler(pugi::xml_node node) {
    const Values values = file_.values(node, kMitsubaSamplerParameters, {"boolean"});
    scene_.sampler = {int(values.number("sample_count")), std::uint64_t(values.number("seed"))};
  }

  MitsubaSource& file_;
  XmlSource& source_;
  Scene& scene_;
};

}  // namespace

bool read_mitsuba_sensor(MitsubaSource& file, pugi::xml_node node, Scene& scene) {
  scene.film = {768, 576, *find_filter("gaussian")};
  scene.sampler.sample_count = 4;
  return MitsubaSensorReader(file, scene).read(node);
}

}  // namespace lobelia
