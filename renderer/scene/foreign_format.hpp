// Files of other programs that users take for scenes.
#pragma once

#include <string>
#include <string_view>

namespace lobelia {

/// What the file is and what to do with it: "is a pbrt scene; ..."; empty for XML and for what is not known.
std::string foreign_format(std::string_view text);

}  // namespace lobelia
