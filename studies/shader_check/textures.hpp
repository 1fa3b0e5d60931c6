// Textures in somebody's shader: each becomes a structure with one value, which every reading of it gives.
#pragma once

#include "studies/shader_check/declarations.hpp"

namespace lobelia {

inline constexpr char kTextureType[] = "LobeliaTexture";

struct TextureEdits {
  std::vector<TextEdit> edits;  ///< empty: the text has no textures
  std::string prelude;          ///< the structure's declaration
};

TextureEdits texture_edits(const TokenList& list, const Declarations& declared,
                           ShaderText language);

}  // namespace lobelia
