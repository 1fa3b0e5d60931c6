#include "renderer/scene/scene_format.hpp"

#include <fmt/format.h>

#include "core/text.hpp"
#include "renderer/fresnel.hpp"

namespace lobelia {
namespace {

std::string range(const Parameter& p) {
  return p.type == ParameterType::kString ? string_choices(p)
                                          : fmt::format("{:g} to {:g}", p.min, p.max);
}

std::string table(const ElementFormat& format) {
  std::string text = fmt::format(
      "\n### `<{} type=\"{}\">`: {}\n\n"
      "| parameter | written | default | allowed | unit | meaning |\n|---|---|---|---|---|---|\n",
      format.tag, format.type, format.meaning);
  for (const auto& p : format.parameters)
    text += fmt::format("| `{}` | `<{}>` | {} | {} | {} | {} |\n", p.name, parameter_tag(p.type),
                        p.default_value.empty() ? "required" : p.default_value, range(p), p.unit,
                        p.meaning);
  return text;
}

}  // namespace

std::string string_choices(const Parameter& p) {
  if (p.name == "lobe") return allowed_lobes();
  if (p.name == "fresnel") return join(fresnel_names());
  if (p.name == "normalisation") return join(normalisation_names());
  return "";
}

std::string scene_format_document() {
  std::string text = fmt::format(
      "# Scene files, format version {}\n\n"
      "XML in the spirit of Mitsuba's: elements with a `type`, parameters as `<float name= "
      "value=>`,\n"
      "a camera by `<lookat>`, materials inside their shape or by `<ref id=>`. Whoever knows that\n"
      "format is at home. This page is printed by `lobelia scene-format`.\n\n"
      "```xml\n"
      "<scene version=\"{}\">\n"
      "  <sensor type=\"perspective\">\n"
      "    <float name=\"fov\" value=\"28\"/>\n"
      "    <transform name=\"to_world\">\n"
      "      <lookat origin=\"0, 0, 5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/>\n"
      "    </transform>\n"
      "    <film type=\"hdrfilm\">\n"
      "      <integer name=\"width\" value=\"256\"/>\n"
      "      <integer name=\"height\" value=\"256\"/>\n"
      "    </film>\n"
      "  </sensor>\n"
      "  <emitter type=\"directional\">\n"
      "    <vector name=\"direction\" value=\"0, 0, -1\"/>\n"
      "  </emitter>\n"
      "  <shape type=\"sphere\">\n"
      "    <bsdf type=\"modified_phong\">\n"
      "      <float name=\"exponent\" value=\"64\"/>\n"
      "    </bsdf>\n"
      "  </shape>\n"
      "</scene>\n"
      "```\n\n"
      "A point or a vector is `value=\"x, y, z\"` or `x= y= z=`; a colour is one number (grey) or\n"
      "three (linear Rec. 709). Right-handed; units and directions: "
      "[conventions](conventions.md).\n"
      "Every error is reported with its line and column, all of them in one run. Limits: {} MiB,\n"
      "{} emitters, {} shapes, {} materials, {} pixels. No DOCTYPE and no entities.\n\n"
      "`<scene version=>` holds one `<sensor>`, any `<emitter>`, `<shape>` and `<bsdf id=>`. The\n"
      "sensor holds `<transform name=\"to_world\">` with one `<lookat origin= target= up=/>`, and\n"
      "may hold one `<film>` and one `<sampler>`.\n",
      kSceneFormatVersion, kSceneFormatVersion, kMaxSceneBytes >> 20, kMaxLights, kMaxSpheres,
      kMaxMaterials, kMaxImagePixels);
  for (const auto& format : {kPerspective, kFilm, kSampler, kDirectional, kPoint, kSphere})
    text += table(format);
  text +=
      table({"bsdf", "MODEL", "a material: a highlight over a diffuse base", kHighlightParameters});
  text += "\nMODEL is one of:\n\n";
  for (const auto& model : models()) text += fmt::format("- `{}`: {}\n", model.name, model.title);
  return text;
}

}  // namespace lobelia
