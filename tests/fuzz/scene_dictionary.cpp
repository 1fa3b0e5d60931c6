// Prints the words of the scene format, from its tables, as a dictionary for libFuzzer, which would not find them by
// changing bytes.
#include <fmt/format.h>

#include <set>
#include <string>

#include "renderer/fresnel.hpp"
#include "renderer/highlight.hpp"
#include "renderer/scene/scene_format.hpp"

namespace {

using namespace lobelia;

std::set<std::string> words() {
  std::set<std::string> found{"<scene version=\"1\">",
                              "</scene>",
                              "</sensor>",
                              "</film>",
                              "</rfilter>",
                              "</emitter>",
                              "</bsdf>",
                              "</shape>",
                              "</integrator>",
                              "<transform name=\"to_world\">",
                              "</transform>",
                              "<lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/>",
                              "<ref id=\"m\"/>",
                              " id=\"m\"",
                              "/>",
                              " value=\"",
                              " x=\"",
                              "<![CDATA[",
                              "<!--",
                              "-->",
                              "<!DOCTYPE",
                              "&#10;",
                              "&amp;",
                              "<?xml?>",
                              "nan",
                              "inf",
                              "-0",
                              "1e400",
                              "1e-320",
                              "1e9",
                              "-1e9",
                              "9007199254740992",
                              "4194304"};
  const auto add = [&](const ElementFormat& format) {
    found.insert(fmt::format("<{} type=\"{}\">", format.tag, format.type));
    for (const Parameter& p : format.parameters) {
      const bool triple = p.type == ParameterType::kPoint || p.type == ParameterType::kVector;
      found.insert(fmt::format("<{} name=\"{}\" value=\"{}\"/>", parameter_tag(p.type), p.name,
                               !p.default_value.empty() ? p.default_value
                               : triple                 ? "1,0,0"
                                                        : "1"));
    }
  };
  for (const auto& format : {kPerspective, kThinLens, kFilm, kSampler, kIntegrator}) add(format);
  for (const auto& format : emitter_formats()) add(format);
  for (const auto& format : kShapes) add(format);
  for (const auto& format : filter_formats()) add(format);
  for (const auto& format : material_formats()) add(format);
  for (const char* part :
       {"expression", "max(0, 1 - n*s/16)^16", "exp(-n*x^2/2)", "c", "pi", "acos(", "1e-3"})
    found.insert(part);
  for (const auto names : {lobe_names(), normalisation_names(), fresnel_names()})
    for (const auto name : names) found.insert(std::string(name));
  return found;
}

}  // namespace

int main() {
  for (const std::string& word : words()) {
    std::string quoted;
    for (const char c : word)
      quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    fmt::print("\"{}\"\n", quoted);
  }
}
