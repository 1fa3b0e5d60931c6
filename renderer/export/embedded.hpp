// Texts of a folder, embedded in the program by lobelia_embed_folder (tools/cmake/lobelia_embed.cmake).
#pragma once

#include <span>
#include <string_view>

namespace lobelia {

struct EmbeddedText {
  std::string_view name;         ///< the file's, without its ending
  const std::string_view& text;  ///< a reference, because the text may be initialised later
};

}  // namespace lobelia
