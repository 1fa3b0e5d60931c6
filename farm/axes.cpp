#include <fmt/format.h>

#include <algorithm>

#include "base/pictures/image.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "farm/grid.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/formula.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Replaces with '_' what is unsafe in a file name, including a dot (hidden file) or dash (option) in front.
std::string file_token(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](unsigned char c) {
        return !std::isalnum(c) && c != '_' && c != '.' && c != '+' && c != '-';
      },
      '_');
  if (text.starts_with('.') || text.starts_with('-')) text.front() = '_';
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
  Highlight of_model;
  if (!set_model(of_model, text))
    unknown("model", text, settable_models(), join(settable_models()));
  return {text, text == kGgx ? "GGX" : std::string(info(of_model.model).title), text,
          for_each_highlight([text](Highlight& h) { set_model(h, text); })};
}

LobeId lobe_of(const std::string& text) {
  const auto lobe = find_lobe(text);
  if (!lobe) unknown("lobe", text, lobe_names(), allowed_lobes());
  return *lobe;
}

/// A lobe's name, or "expression:1/(1 + n*s)".
AxisValue parse_lobe(const std::string& text, const fs::path&) {
  if (const auto prefix = fmt::format("{}:", kFormulaLobe); text.starts_with(prefix)) {
    const LobeId lobe = formula_lobe(std::string_view(text).substr(prefix.size()));
    return {text, lobe.formula->text(), identifier(lobe),
            for_each_highlight([lobe](Highlight& h) { h.lobe = lobe; })};
  }
  return {text, text, text, for_each_highlight([l = lobe_of(text)](Highlight& h) { h.lobe = l; })};
}

/// "exact", or "cosine:exact" where a normalisation and its lobe vary together.
AxisValue parse_normalisation(const std::string& text, const fs::path&) {
  const auto colon = text.find(':');
  const bool alone = colon == text.npos;
  const std::string how_text = alone ? text : text.substr(colon + 1);
  const auto how = find_normalisation(how_text);
  if (!how && alone)
    throw std::runtime_error(fmt::format(
        "'{}' is neither a normalisation ({}) nor LOBE:NORMALISATION, as cs16:paper is{}",
        printable(text), join(normalisation_names()), did_you_mean(text, normalisation_names())));
  if (alone)
    return {text, text, text,
            for_each_highlight([n = *how](Highlight& h) { h.normalisation = n; })};
  const std::string lobe_text = text.substr(0, colon);
  const LobeId lobe = lobe_of(lobe_text);
  if (!how) unknown("normalisation", how_text, normalisation_names(), join(normalisation_names()));
  return {text, lobe_text + ", " + how_text, lobe_text + "_" + how_text,
          for_each_highlight([l = lobe, n = *how](Highlight& h) {
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

AxisValue parse_roughness(const std::string& text, const fs::path&) {
  double roughness = 0;
  if (!parse_number(text, roughness) || roughness < kLeastRoughness || roughness > 1)
    throw std::runtime_error(
        fmt::format("roughness '{}'; allowed: {} to 1", printable(text), kLeastRoughness));
  return {
      text, fmt::format("roughness {}", roughness), "r" + file_token(fmt::format("{}", roughness)),
      for_each_highlight([e = exponent_of_roughness(roughness)](Highlight& h) { h.exponent = e; })};
}

/// Turns a light about the camera's target until the angle there between the light and the eye is `degrees`, on the side
/// where the light is; from the eye's own direction to the upper right.
void turn_light(Scene& scene, double degrees) {
  std::vector<Light*> lights;
  for (Light& light : scene.lights)
    if (!is_environment(light)) lights.push_back(&light);
  const auto lamp = lights.size() == 1 ? find_lamp(*lights[0]) : std::nullopt;
  if (!lamp)
    throw std::runtime_error(fmt::format(
        "the axis 'angle' turns the one directional, point or spot light of a scene, and this scene has {}",
        lights.empty()       ? "none"
        : lights.size() == 1 ? "one with a size"
                             : fmt::format("{} lights", lights.size())));
  const Vec3 target = scene.camera.target, eye = normalize(scene.camera.origin - target);
  const Vec3 from = lamp->is_distant ? -lamp->direction : lamp->position - target;
  if (!(length(from) > 0))
    throw std::runtime_error(
        "the axis 'angle' turns a light about the camera's target, and this scene has it there");
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  Vec3 aside = from - dot(from, eye) * eye;
  if (length(aside) < 1e-9 * length(from)) aside = frame.right + frame.up;
  const double angle = degrees * kPi / 180;
  const Vec3 to_light = std::cos(angle) * eye + std::sin(angle) * normalize(aside);
  Lamp turned = *lamp;
  if (lamp->is_distant) {
    turned.direction = -to_light;
  } else {
    turned.position = target + length(from) * to_light;
    if (lamp->has_normal()) turned.normal = -to_light;
  }
  *lights[0] = light_of(turned);
}

AxisValue parse_angle(const std::string& text, const fs::path&) {
  double degrees = 0;
  if (!parse_number(text, degrees) || degrees < 0 || degrees > 180)
    throw std::runtime_error(fmt::format("angle '{}'; allowed: 0 to 180 degrees", printable(text)));
  return {text, fmt::format("{}°", degrees), "a" + file_token(fmt::format("{}", degrees)),
          [degrees](Scene& scene) { turn_light(scene, degrees); }};
}

Scene scene_of_file(const std::string& text, const fs::path& directory) {
  Scene scene = read_scene(directory / text);
  if (const std::string picture = picture_of(scene); !picture.empty())
    throw std::runtime_error(fmt::format("{}: {}", printable(text), picture));
  return scene;
}

/// Named by its file, without directory and extension.
AxisValue value_of_file(const std::string& text, const fs::path& directory) {
  const std::string stem = (directory / text).stem().string();
  std::string label = stem;
  std::replace(label.begin(), label.end(), '_', ' ');
  // Other alphabets would all become the same underscores.
  const bool is_ascii = std::ranges::all_of(stem, [](char c) { return (c & 0x80) == 0; });
  return {text, label,
          is_ascii ? file_token(stem) : file_token(stem) + "-" + hex(sha256(stem)).substr(0, 8)};
}

AxisValue parse_scene_file(const std::string& text, const fs::path& directory) {
  AxisValue value = value_of_file(text, directory);
  value.scene = std::make_shared<const Scene>(scene_of_file(text, directory));
  return value;
}

/// A scene file whose lights replace those of the grid's scene.
AxisValue parse_light(const std::string& text, const fs::path& directory) {
  AxisValue value = value_of_file(text, directory);
  value.apply = [lights = scene_of_file(text, directory).lights](Scene& scene) {
    scene.lights = lights;
  };
  return value;
}

AxisValue parse_samples(const std::string& text, const fs::path&) {
  const Parameter& range = kSamplerParameters[0];
  long long count = 0;
  if (!parse_integer(text, count) || double(count) < range.min || double(count) > range.max)
    throw std::runtime_error(
        fmt::format("samples '{}'; allowed: whole numbers from {:.0f} to {:.0f}", printable(text),
                    range.min, range.max));
  return {text, fmt::format("{}", count), fmt::format("spp{}", count),
          [count](Scene& scene) { scene.sampler.sample_count = int(count); }};
}

/// "320x240", or one number for a square.
AxisValue parse_size(const std::string& text, const fs::path&) {
  const auto cross = text.find('x');
  const std::string_view whole = text;
  long long width = 0, height = 0;
  const bool numbers = parse_integer(whole.substr(0, cross), width) &&
                       parse_integer(cross == text.npos ? whole : whole.substr(cross + 1), height);
  const auto is_side = [](long long side) { return side >= 1 && side <= kMaxImageSide; };
  if (!numbers || !is_side(width) || !is_side(height) || width * height > kMaxImagePixels)
    throw std::runtime_error(
        fmt::format("size '{}'; allowed: 256 or 320x240, each side from 1 to {}, {} pixels in all",
                    printable(text), kMaxImageSide, kMaxImagePixels));
  return {text, fmt::format("{} × {}", width, height), fmt::format("{}x{}", width, height),
          [width, height](Scene& scene) {
            scene.film.width = int(width);
            scene.film.height = int(height);
          }};
}

AxisValue parse_engine(const std::string& text, const fs::path&) {
  std::vector<std::string_view> names;
  for (const auto& engine : engine_infos()) {
    if (engine.name == text) return {text, std::string(engine.title), text};
    names.push_back(engine.name);
  }
  unknown("engine", text, names, join(names));
}

constexpr AxisKind kAxisKinds[] = {
    {"scene", "scene files", parse_scene_file},
    {"model", "names of models (lobelia models)", parse_model},
    {"lobe", "names of lobes (lobelia models), or expression:FORMULA", parse_lobe},
    {"normalisation", "normalisations, or LOBE:NORMALISATION such as cs16:paper",
     parse_normalisation},
    {"exponent", "numbers", parse_exponent},
    {"roughness", "numbers, of GGX", parse_roughness},
    {"light", "scene files whose lights are taken", parse_light},
    {"angle", "degrees, of the light from the eye", parse_angle},
    {"samples", "whole numbers, of rays a pixel", parse_samples},
    {"size", "256 or 320x240, in pixels", parse_size},
    {"engine", "names of engines", parse_engine},
};

}  // namespace

std::string picture_of(const Scene& scene) {
  for (const Light& light : scene.lights)
    if (const std::string file = picture_file(light); !file.empty())
      return fmt::format(
          "the scene takes light from the picture '{}', and a cell keeps nothing but its scene file; "
          "allowed in a grid: every other light",
          printable(file));
  return "";
}

std::pair<std::string, std::string> conflict_of(const Grid& grid) {
  const auto find = [&](std::string_view name) {
    const auto found = std::ranges::find(grid.axes, name, &Axis::name);
    return found == grid.axes.end() ? nullptr : &*found;
  };
  const auto first = [&](const Axis* axis, const auto& is) -> const AxisValue* {
    if (!axis) return nullptr;
    const auto found = std::ranges::find_if(axis->values, is);
    return found == axis->values.end() ? nullptr : &*found;
  };
  for (const char* other : {"lobe", "normalisation"})
    if (find(other) && first(find("model"), [](const AxisValue& v) { return v.value == kGgx; }))
      return {
          "model",
          fmt::format(
              "'{}', which has a lobe and an exact normalisation of its own, beside an axis '{}'",
              kGgx, other)};
  const AxisValue* both = first(
      find("normalisation"), [](const AxisValue& v) { return v.value.find(':') != v.value.npos; });
  if (find("lobe") && both)
    return {"normalisation",
            fmt::format("LOBE:NORMALISATION '{}' beside an axis 'lobe'; allowed there: {}",
                        both->value, join(normalisation_names()))};
  for (const auto& [one, other] : {std::pair{"roughness", "exponent"}, {"angle", "light"}})
    if (find(one) && find(other))
      return {one,
              fmt::format("an axis '{}' beside an axis '{}'; allowed: one of them", one, other)};
  if (const Axis* angle = find("angle")) {
    std::vector<const Scene*> scenes{&grid.scene};
    if (const Axis* of_scenes = find("scene")) {
      scenes.clear();
      for (const AxisValue& value : of_scenes->values) scenes.push_back(value.scene.get());
    }
    for (const Scene* scene : scenes) {
      Scene copy = *scene;
      try {
        angle->values.front().apply(copy);
      } catch (const std::runtime_error& e) {
        return {"angle", e.what()};
      }
    }
  }
  return {};
}

std::span<const AxisKind> axis_kinds() { return kAxisKinds; }

std::vector<std::string> split_values(std::string_view axis, std::string_view text) {
  constexpr std::string_view kSeparators = ", \t\n\r";
  if (axis != "lobe") return split(text, kSeparators);
  std::vector<std::string> values;
  int depth = 0;
  bool in_value = false;
  for (const char c : text) {
    depth += (c == '(') - (c == ')');
    const bool separates = depth <= 0 && kSeparators.find(c) != std::string_view::npos;
    if (!separates && !in_value) values.emplace_back();
    if (!separates) values.back() += c;
    in_value = !separates;
  }
  return values;
}

}  // namespace lobelia
