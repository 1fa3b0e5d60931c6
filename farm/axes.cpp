#include "farm/axes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Safe in a file name on every system: whatever else becomes '_', and so does a dot in front, which
/// would hide the file or be a directory.
std::string file_token(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](unsigned char c) {
        return !std::isalnum(c) && c != '_' && c != '.' && c != '+' && c != '-';
      },
      '_');
  if (text.starts_with('.')) text.front() = '_';
  return text;
}

[[noreturn]] void unknown(std::string_view what, const std::string& text,
                          std::span<const std::string_view> names, const std::string& allowed) {
  throw std::runtime_error(fmt::format("unknown {} '{}'; allowed: {}{}", what, printable(text),
                                       allowed, did_you_mean(text, names)));
}

template <class Change>
auto for_each_highlight(Change change) {
  return [change](Scene& scene) {
    for (auto& material : scene.materials) change(material.highlight);
  };
}

AxisValue parse_model(const std::string& text, const fs::path&) {
  const auto model = find_model(text);
  if (!model) unknown("model", text, model_names(), join(model_names()));
  return {text, std::string(info(*model).title), text,
          for_each_highlight([m = *model](Highlight& h) { h.model = m; })};
}

/// "cosine:exact": a normalisation belongs to its lobe, so the two vary together.
AxisValue parse_normalisation(const std::string& text, const fs::path&) {
  const auto colon = text.find(':');
  if (colon == text.npos)
    throw std::runtime_error(
        fmt::format("'{}' is not LOBE:NORMALISATION, as cs16:paper is", printable(text)));
  const std::string lobe_text = text.substr(0, colon), how_text = text.substr(colon + 1);
  const auto lobe = find_lobe(lobe_text);
  if (!lobe) unknown("lobe", lobe_text, lobe_names(), allowed_lobes());
  const auto how = find_normalisation(how_text);
  if (!how) unknown("normalisation", how_text, normalisation_names(), join(normalisation_names()));
  return {text, lobe_text + ", " + how_text, lobe_text + "_" + how_text,
          for_each_highlight([l = *lobe, n = *how](Highlight& h) {
            h.lobe = l;
            h.normalisation = n;
          })};
}

AxisValue parse_exponent(const std::string& text, const fs::path&) {
  double exponent = 0;
  if (!parse_number(text, exponent) || exponent < kMinExponent || exponent > kMaxExponent)
    throw std::runtime_error(fmt::format("exponent '{}'; allowed: {} to {:g}", printable(text),
                                         kMinExponent, kMaxExponent));
  return {text, fmt::format("n = {}", exponent), "n" + file_token(fmt::format("{}", exponent)),
          for_each_highlight([exponent](Highlight& h) { h.exponent = exponent; })};
}

/// A scene file whose lights replace those of the grid's scene.
AxisValue parse_light(const std::string& text, const fs::path& directory) {
  const fs::path file = directory / text;
  const Scene scene_of_lights = read_scene(file);
  if (const std::string picture = picture_of(scene_of_lights); !picture.empty())
    throw std::runtime_error(fmt::format("{}: {}", printable(text), picture));
  const auto lights = scene_of_lights.lights;
  std::string label = file.stem().string();
  std::replace(label.begin(), label.end(), '_', ' ');
  return {text, label, file_token(file.stem().string()),
          [lights](Scene& scene) { scene.lights = lights; }};
}

constexpr AxisKind kAxisKinds[] = {
    {"model", "names of models (lobelia models)", parse_model},
    {"normalisation", "LOBE:NORMALISATION, such as cs16:paper", parse_normalisation},
    {"exponent", "numbers", parse_exponent},
    {"light", "scene files whose lights are taken", parse_light},
};

}  // namespace

std::string picture_of(const Scene& scene) {
  for (const Light& light : scene.lights)
    if (const auto* sky = std::get_if<EnvironmentLight>(&light); sky && sky->image)
      return fmt::format(
          "the scene takes light from the picture '{}', and a cell keeps nothing but its scene file; "
          "allowed in a grid: every other light",
          printable(sky->file));
  return "";
}

std::span<const AxisKind> axis_kinds() { return kAxisKinds; }

}  // namespace lobelia
