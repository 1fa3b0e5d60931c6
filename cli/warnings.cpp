#include "cli/warnings.hpp"

#include <fmt/format.h>

#include <set>

#include "core/standard_streams.hpp"
#include "core/text.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cli {

void warn(std::string_view text) { say("lobelia: warning: {}\n", printable(text, 2000)); }

void warn_of(const Scene& scene) {
  std::set<std::string> lines;
  for (const Material& material : scene.materials) lines.insert(warning(material.highlight));
  lines.erase("");
  for (const std::string& line : lines) warn(line);
  for (const std::string& line : remarks(scene)) warn(line);
}

void warn_of(const Highlight& highlight) {
  if (const std::string line = warning(highlight); !line.empty()) warn(line);
}

}  // namespace lobelia::cli
