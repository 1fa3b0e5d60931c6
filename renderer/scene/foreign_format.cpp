#include "renderer/scene/foreign_format.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lobelia {
namespace {

constexpr std::size_t kLooked = 64 << 10;

struct Format {
  std::string_view name;
  std::string_view beginning;  ///< of the file, behind white space
  std::string_view further;    ///< what it holds as well; without a beginning, how a line begins
};

/// The first that fits counts.
constexpr Format kFormats[] = {
    {"a glTF model", "glTF", ""},
    {"a USD scene", "#usda", ""},
    {"a USD scene", "PXR-USDC", ""},
    {"a zip archive, perhaps of USD", "PK\x03\x04", ""},
    {"a Blender file", "BLENDER", ""},
    {"a PLY mesh", "ply\n", ""},
    {"an STL mesh", "solid ", ""},
    {"a RenderMan scene", "##RenderMan", ""},
    {"an OpenEXR picture", "v/1\x01", ""},
    {"a PNG picture", "\x89PNG", ""},
    {"a glTF model", "{", "\"asset\""},
    {"a record of Lobelia", "{", "\"schemaVersion\""},
    {"JSON", "{", ""},
    {"JSON", "[", ""},
    {"a pbrt scene", "", "WorldBegin"},
    {"a pbrt scene", "", "Camera \""},
    {"a pbrt scene", "", "LookAt "},
    {"an OBJ mesh", "", "mtllib "},
    {"an OBJ mesh", "", "v "},
    {"a POV-Ray scene", "", "#version"},
    {"a POV-Ray scene", "", "#include"},
    {"a POV-Ray scene", "", "camera {"},
    {"a POV-Ray scene", "", "camera{"},
    {"an HTML page", "<!DOCTYPE html", ""},
    {"an HTML page", "<html", ""},
};

std::string_view without_space(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

bool has_line(std::string_view text, std::string_view beginning) {
  while (!text.empty()) {
    if (without_space(text.substr(0, text.find('\n'))).starts_with(beginning)) return true;
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  return false;
}

}  // namespace

std::string foreign_format(std::string_view text) {
  const std::string_view head = without_space(text.substr(0, kLooked));
  const auto found = std::ranges::find_if(kFormats, [&](const Format& format) {
    return head.starts_with(format.beginning) &&
           (format.beginning.empty() ? has_line(head, format.further)
                                     : head.find(format.further) != head.npos);
  });
  if (found == std::end(kFormats) || (found->beginning.empty() && head.starts_with('<'))) return "";
  return fmt::format(
      "is {}; Lobelia reads scenes in its own XML (lobelia scene-format) and, with "
      "lobelia scene --from mitsuba, those of Mitsuba",
      found->name);
}

}  // namespace lobelia
