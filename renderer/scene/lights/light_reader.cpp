#include "renderer/scene/lights/light_reader.hpp"

#include <system_error>

#include "base/pictures/contained_reader.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const std::string& file, std::string_view why) {
  throw Error(ExitCode::kInput, "filename '{}' {}", printable(file), why);
}

/// A sky takes twenty bytes a pixel in memory. Any file may have 4096 x 2048 pixels, files from 7 MB on 16384 x 8192.
constexpr PictureLimit kSkyLimit{std::uint64_t{1} << 24, 16};
constexpr std::string_view kAllowed =
    "; allowed: a relative path to a picture in the scene file's directory or below it";

void check_values(const std::string& file, const Image& image) {
  const auto values = image.values();
  const auto bad =
      std::ranges::find_if(values, [](float v) { return !(v >= 0 && double(v) <= kBrightest); });
  if (bad == values.end()) return;
  const auto pixel = (bad - values.begin()) / 3;
  refuse(file, fmt::format("has the value {} in pixel ({}, {}); allowed: 0 to {:g}", *bad,
                           pixel % image.width(), pixel / image.width(), kBrightest));
}

class ElementOfLight final : public LightSource {
 public:
  ElementOfLight(pugi::xml_node node, const Values& values, XmlSource& source,
                 EnvironmentMaps& maps)
      : node_(node), values_(values), source_(source), maps_(maps) {}

  bool has(std::string_view parameter) const override { return bool(values_[parameter].node); }

  void error(std::string_view parameter, const std::string& message) override {
    if (parameter.empty()) return source_.error(node_, message);
    const pugi::xml_node where = values_[parameter].node;
    source_.error(where.attribute("value"), where, message);
  }

  std::shared_ptr<const Image> picture(std::string_view parameter) override {
    if (!has(parameter)) return nullptr;
    try {
      return maps_.read(values_[parameter].text);
    } catch (const Error& problem) {
      if (problem.code() != ExitCode::kInput) throw;
      error(parameter, problem.what());
    }
    return nullptr;
  }

 private:
  pugi::xml_node node_;
  const Values& values_;
  XmlSource& source_;
  EnvironmentMaps& maps_;
};

void take(const Values& values, std::string_view name, double& to) { to = values.number(name); }
void take(const Values& values, std::string_view name, Vec3& to) { to = values.vec3(name); }
void take(const Values& values, std::string_view name, Rgb& to) { to = values.rgb(name); }
void take(const Values& values, std::string_view name, std::string& to) { to = values[name].text; }

template <class L>
Light make_light(const Values& values, LightSource& source) {
  L light;
  for (const LightParameter<L>& p : L::parameters())
    std::visit([&](auto member) { take(values, p.parameter.name, light.*member); }, p.member);
  if constexpr (requires { light.finish(source); }) light.finish(source);
  return light;
}

}  // namespace

EnvironmentMaps::EnvironmentMaps(const fs::path& directory) {
  std::error_code ignored;  // leaves directory_ empty
  if (!directory.empty()) directory_ = fs::canonical(directory, ignored);
}

fs::path EnvironmentMaps::inside(const std::string& file) const {
  // The name must fit into XML, because a scene may be written again.
  if (std::ranges::any_of(file, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    refuse(file, fmt::format("has control characters{}", kAllowed));
  if (directory_.empty())
    refuse(file, "cannot be looked for: this scene has no directory, it is not read from a file");
  const fs::path name(file);
  if (file.empty() || name.is_absolute())
    refuse(file, fmt::format("is {}{}", file.empty() ? "empty" : "absolute", kAllowed));
  const auto leaves = [](const fs::path& path) {
    return std::ranges::any_of(path, [](const fs::path& p) { return p == ".."; });
  };
  if (leaves(name)) refuse(file, fmt::format("has '..' in it{}", kAllowed));
  std::error_code error;
  fs::path path = fs::weakly_canonical(directory_ / name, error);
  if (error) refuse(file, fmt::format("cannot be looked for: {}", error.message()));
  require_inside(file, path);
  return path;
}

void EnvironmentMaps::require_inside(const std::string& file, const fs::path& real_path) const {
  if (!is_below(real_path, directory_))
    refuse(file,
           fmt::format("leads out of the scene file's directory by a symbolic link{}", kAllowed));
}

std::shared_ptr<const Image> EnvironmentMaps::read(const std::string& file) {
  const fs::path path = inside(file);
  auto& known = images_[path];
  if (known) return known;
  InputFile opened(path);
  // Check the open file: the path may lead elsewhere by now.
  require_inside(file, opened.real_path());
  auto image = std::make_shared<const Image>(
      read_picture(PictureFile(std::move(opened)), "", kSkyLimit).image);
  check_values(file, *image);
  pixels_ += std::int64_t(image->pixel_count());
  if (pixels_ > kMaxImagePixels)
    refuse(file, fmt::format("is too much: the scene's pictures have {} pixels; allowed: {} in all",
                             pixels_, kMaxImagePixels));
  return known = std::move(image);
}

std::optional<Light> LightReader::read(pugi::xml_node node) {
  static constexpr auto kMake = map_types<Light (*)(const Values&, LightSource&)>(
      Lights{}, []<class L>() { return &make_light<L>; });
  reader_.check_attributes(node);
  const auto formats = emitter_formats();
  const ElementFormat* format = reader_.format_of(node, formats);
  if (!format) return std::nullopt;
  static constexpr auto kKinds =
      map_types<LightKind>(Lights{}, []<class L>() { return L::kInfo.kind; });
  if (kKinds[std::size_t(format - formats.data())] == LightKind::kEnvironment &&
      !count_environment(node))
    return std::nullopt;
  const Values values = reader_.read_parameters(node, format->parameters);
  ElementOfLight element(node, values, reader_.source(), maps_);
  return kMake[std::size_t(format - formats.data())](values, element);
}

bool LightReader::count_environment(pugi::xml_node node) {
  return reader_.within(node, "constant and envmap emitters", kMaxEnvironments, environments_++);
}

void LightReader::check_pairs(pugi::xml_node node, std::size_t lights, std::size_t shapes) {
  if (shapes > 0 && lights > std::size_t(kMaxLightsTimesShapes) / shapes)
    reader_.source().error(
        node, fmt::format("{} emitters times {} spheres and planes; allowed: {} in all", lights,
                          shapes, kMaxLightsTimesShapes));
}

}  // namespace lobelia
