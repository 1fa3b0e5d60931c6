// The texts of a folder that are part of the program; made by lobelia_embed_folder of cmake/lobelia_embed.cmake.
#pragma once

#include <span>
#include <string_view>

namespace lobelia {

struct EmbeddedText {
  std::string_view name;         ///< of the file, without its ending
  const std::string_view& text;  ///< a reference, because it may be initialised later
};

}  // namespace lobelia
