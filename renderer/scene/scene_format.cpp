#include "renderer/scene/scene_format.hpp"

#include <fmt/format.h>

#include "base/words/text.hpp"
#include "renderer/filter.hpp"
#include "renderer/formula.hpp"
#include "renderer/fresnel.hpp"
#include "renderer/scene/lights/lights.hpp"
#include "renderer/scene/sphere_lattice.hpp"

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

/// Holds the texts and tables that an ElementFormat refers to.
struct FilterTables {
  std::vector<std::string> defaults;
  std::vector<Parameter> parameters;
  std::vector<ElementFormat> formats;

  FilterTables() {
    const auto names = filter_names();
    defaults.reserve(names.size());
    parameters.reserve(names.size());
    for (const std::string_view name : names) {
      defaults.push_back(fmt::format("{}", find_filter(name)->radius));
      parameters.push_back(
          {"radius", ParameterType::kFloat, defaults.back(), 0.1, 16, "pixels", "half its width"});
      formats.push_back({"rfilter", name, "", std::span(&parameters.back(), 1)});
    }
  }
};

template <class L>
ElementFormat format_of_light() {
  static const auto parameters = [] {
    std::vector<Parameter> all;
    for (const LightParameter<L>& p : L::parameters()) all.push_back(p.parameter);
    return all;
  }();
  return {"emitter", L::kInfo.type, L::kInfo.meaning, parameters};
}

}  // namespace

std::span<const ElementFormat> emitter_formats() {
  static const auto formats =
      map_types<ElementFormat>(Lights{}, []<class L>() { return format_of_light<L>(); });
  return formats;
}

std::span<const ElementFormat> filter_formats() {
  static const FilterTables tables;
  return tables.formats;
}

std::span<const ElementFormat> material_formats() {
  static const std::vector<ElementFormat> formats = [] {
    std::vector<ElementFormat> result;
    for (const auto& model : models())
      result.push_back({"bsdf", model.name, model.title, kHighlightParameters});
    result.push_back({"bsdf", kGgx, "GGX by its roughness", kGgxParameters});
    return result;
  }();
  return formats;
}

std::span<const XmlElement> scene_elements() {
  static constexpr Parameter kId{"id", ParameterType::kString, "none", 0, 0, "", "its name"};
  static constexpr auto place = [](std::string_view name, std::string_view meaning) {
    return Parameter{name, ParameterType::kPoint, "", -kFar, kFar, "", meaning};
  };
  static const std::vector<XmlElement> elements{
      {"scene",
       "a scene",
       {{{"version", ParameterType::kString, "", 0, 0, "", "of the format"},
         {kSceneFormatVersion}}},
       {{{"sensor"}, 1, 1}, {{"emitter", "bsdf", "shape"}}, {{"integrator"}, 0, 1}}},
      {"sensor",
       "the camera",
       {},
       {{{"transform"}, 1, 1}, {{"film"}, 0, 1}, {{"sampler"}, 0, 1}},
       kSensors},
      {"transform",
       "where the camera is",
       {{{"name", ParameterType::kString, "", 0, 0, "", ""}, {"to_world"}}},
       {{{"lookat"}, 1, 1}}},
      {"lookat",
       "where the camera looks",
       {{place("origin", "the camera's place")},
        {place("target", "a point in the middle of the view")},
        {place("up", "a vector that is upright in the picture")}}},
      {"film", kFilm.meaning, {}, {{{"rfilter"}, 0, 1}}, std::span(&kFilm, 1)},
      {"rfilter", "how much a sample counts", {}, {}, filter_formats()},
      {"sampler", kSampler.meaning, {}, {}, std::span(&kSampler, 1)},
      {"integrator", kIntegrator.meaning, {}, {}, std::span(&kIntegrator, 1)},
      {"emitter", "a light", {{kId}}, {}, emitter_formats()},
      {"shape", "a shape", {{kId}}, {{{"bsdf", "ref"}, 1, 2}}, kShapes},
      {"bsdf", "a material", {{kId}}, {}, material_formats()},
      {"ref",
       "the material of that id",
       {{{"id", ParameterType::kString, "", 0, 0, "", "of a material"}}}},
  };
  return elements;
}

std::string scene_schema() { return xml_schema(scene_elements(), {"bsdf", "ref"}); }

std::string string_choices(const Parameter& p) {
  if (p.name == "filename") return "a picture in the scene file's directory or below it";
  if (p.name == "lobe") return allowed_lobes(true);
  if (p.name == "formula") return "a formula of s, c, x and n";
  if (p.name == "fresnel") return join(fresnel_names());
  if (p.name == "normalisation") return join(normalisation_names());
  return "";
}

std::string scene_format_document() {
  std::string text = fmt::format(
      R"--(# Scene files, format version {}

For anyone who writes a scene by hand or by a program. [Write a scene](howto/write_a_scene.md) is a
gentler start.

The syntax follows Mitsuba's, but types and versions differ: `lobelia scene --from mitsuba`
[converts a scene](howto/convert_from_mitsuba.md). Example scenes are in
[reference_scenes/scenes](../reference_scenes/scenes); those in `effects/` have area lights, mirrors or a lens.
`lobelia scene-format` prints this page.

```xml
<scene version="{}">
  <sensor type="perspective">
    <float name="fov" value="28"/>
    <transform name="to_world">
      <lookat origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm">
      <integer name="width" value="256"/>
      <integer name="height" value="256"/>
    </film>
  </sensor>
  <emitter type="directional">
    <vector name="direction" value="0, 0, -1"/>
  </emitter>
  <shape type="sphere">
    <bsdf type="modified_phong">
      <float name="exponent" value="64"/>
    </bsdf>
  </shape>
</scene>
```

A point or a vector is `value="x, y, z"` or `x= y= z=`; a colour is one number (grey) or
three (linear Rec. 709). Right-handed; units and directions: [conventions](conventions.md).
No DOCTYPE and no entities.

Limits: {} MiB, {} spheres, {} planes, {} materials and {} pixels. There may be {} emitters
([many lights](#many-lights)), {} of them `constant` or `envmap`. Their number times that of
spheres and planes is at most {}. Only `lobelia render` takes over {} pixels ([large pictures](scale.md#large-pictures)).

`<scene version=>` holds one `<sensor>`, any `<emitter>`, `<shape>` and `<bsdf id=>`, and
may hold one `<integrator>`. The sensor holds `<transform name="to_world">` with one
`<lookat origin= target= up=/>`, and may hold one `<film>`, which may hold one `<rfilter>`,
and one `<sampler>`. A shape holds one `<bsdf>` or `<ref id=>`, or a plane two of them, which
then alternate as a checker.
)--",
      kSceneFormatVersion, kSceneFormatVersion, kMaxSceneBytes >> 20, kMaxSpheres, kMaxPlanes,
      kMaxMaterials, kMaxFilmPixels, kMaxLights, kMaxEnvironments, kMaxLightsTimesShapes,
      kMaxImagePixels);
  text += "\n## Elements\n";
  for (const auto& format : {kPerspective, kThinLens, kFilm}) text += table(format);
  Parameter radius = filter_formats().front().parameters.front();
  radius.default_value = "see below";
  text +=
      table({"rfilter", "FILTER",
             "how much a sample counts, by its distance from the pixel's centre; inside the film",
             std::span(&radius, 1)});
  text +=
      "\nWithout it every sample of a pixel counts the same. FILTER, and the radius that is its "
      "default:\n\n";
  for (const auto& filter : filter_formats())
    text += fmt::format("- `{}`: {}\n", filter.type, filter.parameters.front().default_value);
  text += table(kSampler) + table(kIntegrator);
  text += fmt::format(
      "\nWithout this element `mirror_depth` is {} where a material has a `mirror_reflectance`,\n"
      "and else 0.\n",
      kDefaultMirrorDepth);
  for (const auto& format : emitter_formats()) text += table(format);
  for (const std::string_view note :
       map_types<std::string_view>(Lights{}, []<class L>() { return L::kInfo.note; }))
    if (!note.empty()) text += fmt::format("\n{}", note);
  text += R"--(
### Many lights

Up to 64 lights with a size (`sphere`, `rectangle`) are sampled one by one at every point. Of more than 64, each point
draws one, with a probability that follows its power and its distance. The picture is the same on average. Its time
hardly grows with the number of lights, but its noise does: raise `sample_count`.

`directional` and `point` lights are summed at every point, without noise, so the time grows with their number. Where
`glossy_depth` is over 0 and there are more than 64 of them, this holds for the first surface only: later points draw
one. `lobelia plan` says what a scene gets.
)--";
  for (const auto& format : kShapes) text += table(format);
  text += "\n" + lattice_rule();
  text += table({"bsdf", "MODEL", "a material: a mirror over a highlight over a diffuse base",
                 kHighlightParameters});
  text += "\nMODEL is one of:\n\n";
  for (const auto& model : models()) text += fmt::format("- `{}`: {}\n", model.name, model.title);
  text += table(material_formats().back());
  text +=
      "\nIt is the model `microfacet_smith` with the lobe `ggx`, and the exponent 2 / alpha^2 - 2: "
      "isotropic,\nwith Smith's height-correlated shadowing. The writer spells it so.\n";
  text += fmt::format(
      R"--(
### A lobe by its formula

```xml
<string name="lobe" value="expression"/>
<string name="formula" value="max(0, 1 - n*s/16)^16"/>
```

A formula has numbers, `+ - * / ^`, parentheses, `pi`, the functions of one value exp, log (natural), sqrt,
abs, sin, cos, tan, asin, acos and atan, the functions of two pow, min and max, and these names:

| name | value |
|---|---|
| `s` | 1 - cos of the lobe's angle, 0 to 1; small angles keep their digits in it |
| `c` | 1 - s |
| `x` | the angle itself in radians |
| `n` | the exponent |

A power binds more tightly than a sign, and from the right: `-2^2` is -4, `2^3^2` is 2^9. At most {} bytes, {}
numbers, names and operations, {} levels; numbers are 0, or 1e-30 to 1e30. Every lobe is 0 from s = 1 on. A formula has
to be finite up to there, 1 at s = 0, nowhere negative, and must not rise: the reader tests it at a thousand places, with
the exponent of its material. Between them a value below 0, or none, counts as 0, and one above 1 as 1. The
normalisation is `exact`, with the energy by quadrature.

## Completion and checks in an editor

An editor that knows XML Schema completes names and marks mistakes as you type. [scene.xsd](reference/scene.xsd) is the
schema of scene files. The package `lobelia` installs it in `/usr/share/lobelia/schemas`. In VS Code, install the extension
"XML" by Red Hat. Then name the schema on the root element, by its path relative to the file:

```
<scene xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="scene.xsd" version="1">
```

Lobelia ignores both attributes. By hand, `xmllint` of the package `libxml2-utils` checks a file:

```sh
lobelia scene-format --xsd > scene.xsd
xmllint --noout --schema scene.xsd reference_scenes/scenes/oblique_45.xml
```

The schema finds less than the program does: it allows every parameter of any `<sensor>` in each `<sensor>`, with the widest
range, and so for `<bsdf>`.

## Try a lobe

`--formula` gives a formula to every material, without a build. Our picture and that of an engine that knows only the
formula should agree; `models` measures width, energy and reciprocity; `export` writes the shader, for one exponent.

```sh
lobelia render reference_scenes/scenes/oblique_45.xml --formula '1/(1 + n*s/4)^4' -o idea.exr
lobelia reference reference_scenes/scenes/oblique_45.xml --engine analytic --formula '1/(1 + n*s/4)^4' -o truth.exr
lobelia compare idea.exr truth.exr --fail max_abs=1e-5
lobelia models --formula '1/(1 + n*s/4)^4' --exponent 64
lobelia export --language glsl modified_phong --formula '1/(1 + n*s/4)^4' --exponent 64 -o idea.glsl
```

The kernels evaluate a formula one value at a time, far more slowly than a lobe of the catalogue: `lobelia cost SCENE
--level picture` measures both. A lobe that is worth it [gets a file](howto/add_a_lobe.md).
)--",
      kMaxFormulaBytes, kMaxFormulaNodes, kMaxFormulaDepth);
  return text;
}

std::string whole_picture_problem(const Film& film) {
  if (std::int64_t{film.width} * film.height <= kMaxImagePixels) return "";
  return fmt::format("a picture of {} x {} is too large to be held in memory; allowed: {} pixels",
                     film.width, film.height, kMaxImagePixels);
}

}  // namespace lobelia
