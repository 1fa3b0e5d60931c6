// Reads the materials of Mitsuba's scenes, of version 3 and of versions 0.x.
//
// Source: Mitsuba 3, plug-in reference, "BSDFs": phong, roughconductor, roughplastic and roughdielectric with their defaults.
//         Walter et al. 2007, section 5.2: Beckmann's distribution is nearly (N.H)^n with n = 2 / alpha^2 - 2, which Mitsuba 0.x
//         takes for its distribution "phong".
#include <fmt/format.h>

#include "base/words/text.hpp"
#include "reference_scenes/formats/mitsuba.hpp"
#include "reference_scenes/formats/mitsuba_source.hpp"
#include "studies/convert/assets/assets.hpp"

namespace lobelia::conversion {
namespace {

constexpr std::string_view kMitsubaMeaning =
    "Mitsuba: phong is modified_phong; alpha is that of GGX, or by Walter n = 2 / alpha^2 - 2 of Beckmann";
constexpr std::string_view kWrappers[] = {"twosided",  "mask",    "bumpmap",     "normalmap",
                                          "blendbsdf", "coating", "roughcoating"};

pugi::xml_node parameter_of(pugi::xml_node bsdf, const char* name) {
  return bsdf.find_child_by_attribute("name", name);
}

double value_of(pugi::xml_node bsdf, const char* name, double otherwise, double least, double most,
                FileMaterial& to) {
  const auto node = parameter_of(bsdf, name);
  const std::string_view tag = node.name();
  if (!node) {
    to.remark(fmt::format("{} is missing: Mitsuba's default {:g} is used", name, otherwise));
  } else if (tag != "float" && tag != "integer") {
    to.remark(fmt::format("{} is a <{}>, which is not read: Mitsuba's default {:g} is used", name,
                          printable(tag), otherwise));
  } else if (const auto number =
                 number_of(node.attribute("value").value(), least, most, name, to)) {
    return *number;
  } else {
    to.remark(fmt::format("Mitsuba's default {} {:g} is used", name, otherwise));
  }
  return otherwise;
}

void read_microfacets(pugi::xml_node bsdf, FileMaterial& to) {
  if (parameter_of(bsdf, "alpha_u") || parameter_of(bsdf, "alpha_v"))
    return to.remark("alpha_u and alpha_v: no model here depends on the direction");
  const double alpha = value_of(bsdf, "alpha", 0.1, 1e-6, 1e3, to);
  const auto node = parameter_of(bsdf, "distribution");
  const std::string_view given = node.attribute("value").value();
  if (given == "ggx") return to.set("ggx", alpha);
  if (!node) to.remark("distribution is missing: Mitsuba's default beckmann is used");
  if (node && given != "beckmann" && given != "phong")
    return to.remark(fmt::format("the distribution '{}' is not known", printable(given)));
  to.set("blinn_phong_heightfield", 2 / (alpha * alpha) - 2);
}

/// The index inside over the one outside, air.
void set_index(pugi::xml_node bsdf, double inside, FileMaterial& to) {
  const double in = value_of(bsdf, "int_ior", inside, 1, 10, to),
               out = value_of(bsdf, "ext_ior", 1.000277, 1, 10, to);
  const double f0 = reflectance_of_ior(in / out);
  to.f0 = std::clamp(f0, 1e-3, 1.0);
  to.remark(fmt::format("F0 is {:.4g}", f0));
}

void read_bsdf(pugi::xml_node bsdf, std::string_view type, FileMaterial& to) {
  if (type == "phong") {
    to.set(kMitsubaModel, value_of(bsdf, "exponent", 30, 0, kMaxExponent, to));
  } else if (type == "roughconductor") {
    read_microfacets(bsdf, to);
    to.remark("the Fresnel factor of a metal is left out");
  } else if (type == "roughplastic" || type == "roughdielectric") {
    read_microfacets(bsdf, to);
    if (to.model) set_index(bsdf, type == "roughplastic" ? 1.49 : 1.5046, to);
  } else {
    to.remark(
        fmt::format("the bsdf type '{}' has no highlight that is known here", printable(type)));
  }
}

/// Its own id, or that of a bsdf around it.
std::string_view id_of(pugi::xml_node bsdf) {
  for (; std::string_view(bsdf.name()) == "bsdf"; bsdf = bsdf.parent())
    if (const auto id = bsdf.attribute("id")) return id.value();
  return {};
}

}  // namespace

Assets read_mitsuba_materials(const std::string& text, const std::string& file_name) {
  MitsubaSource source(text, file_name);
  Assets assets{kMitsubaMeaning};
  assets.remarks = source.xml().error_lines();
  for (const auto& found : source.root().select_nodes("//bsdf")) {
    const auto bsdf = found.node();
    const std::string_view type = MitsubaSource::type(bsdf);
    if (bsdf.child("bsdf") && std::ranges::count(kWrappers, type) > 0) continue;
    FileMaterial& to = assets.add(id_of(bsdf));
    read_bsdf(bsdf, type, to);
    const auto around = bsdf.parent();
    if (std::string_view(around.name()) == "bsdf" && MitsubaSource::type(around) != "twosided")
      to.remark(fmt::format("the bsdf type '{}' around it is left out",
                            printable(MitsubaSource::type(around))));
  }
  return assets;
}

}  // namespace lobelia::conversion
