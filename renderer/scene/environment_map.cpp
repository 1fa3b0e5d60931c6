#include "renderer/scene/environment_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/contained_reader.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const std::string& file, std::string_view why) {
  throw Error(ExitCode::kInput, fmt::format("filename '{}' {}", printable(file), why));
}

/// A sky takes twenty bytes a pixel in memory. Files of 7 MB and more may have 16384 x 8192 pixels, any file 4096 x 2048.
constexpr PictureLimit kSkyLimit{std::uint64_t{1} << 24, 16};
constexpr std::string_view kAllowed =
    "; allowed: a relative path to a picture in the scene file's directory or below it";

void check_values(const std::string& file, const Image& image) {
  const auto values = image.values();
  const auto bad = std::find_if(values.begin(), values.end(),
                                [](float v) { return !(v >= 0 && double(v) <= kBrightest); });
  if (bad == values.end()) return;
  const auto pixel = (bad - values.begin()) / 3;
  refuse(file, fmt::format("has the value {} in pixel ({}, {}); allowed: 0 to {:g}", *bad,
                           pixel % image.width(), pixel / image.width(), kBrightest));
}

}  // namespace

EnvironmentMaps::EnvironmentMaps(const fs::path& directory) {
  std::error_code ignored;  // then there is none
  if (!directory.empty()) directory_ = fs::canonical(directory, ignored);
}

fs::path EnvironmentMaps::inside(const std::string& file) const {
  // A scene writes the name down again, in XML: what that cannot hold is no name.
  if (std::any_of(file.begin(), file.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    refuse(file, fmt::format("has control characters{}", kAllowed));
  if (directory_.empty())
    refuse(file, "cannot be looked for: this scene has no directory, it is not read from a file");
  const fs::path name(file);
  if (file.empty() || name.is_absolute())
    refuse(file, fmt::format("is {}{}", file.empty() ? "empty" : "absolute", kAllowed));
  const auto leaves = [](const fs::path& path) {
    return std::any_of(path.begin(), path.end(), [](const fs::path& p) { return p == ".."; });
  };
  if (leaves(name)) refuse(file, fmt::format("has '..' in it{}", kAllowed));
  std::error_code error;
  const fs::path path = fs::weakly_canonical(directory_ / name, error);
  if (error) refuse(file, fmt::format("cannot be looked for: {}", error.message()));
  if (const fs::path way = path.lexically_relative(directory_); way.empty() || leaves(way))
    refuse(file,
           fmt::format("leads out of the scene file's directory by a symbolic link{}", kAllowed));
  return path;
}

std::shared_ptr<const Image> EnvironmentMaps::read(const std::string& file) {
  const fs::path path = inside(file);
  auto& known = images_[path];
  if (known) return known;
  auto image = std::make_shared<const Image>(read_picture(path, "", kSkyLimit).image);
  check_values(file, *image);
  pixels_ += std::int64_t(image->pixel_count());
  if (pixels_ > kMaxImagePixels)
    refuse(file, fmt::format("is too much: the scene's pictures have {} pixels; allowed: {} in all",
                             pixels_, kMaxImagePixels));
  return known = std::move(image);
}

}  // namespace lobelia
