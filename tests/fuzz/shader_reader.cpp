#include <algorithm>

#include "studies/shader_check/reach.hpp"
#include "studies/shader_check/textures.hpp"
#include "tests/fuzz/checks.hpp"

namespace lobelia::fuzz {

void check_shader_reader(std::string_view text) {
  constexpr std::size_t kFunctions = 10;
  for (const ShaderText language : {ShaderText::kGlsl, ShaderText::kHlsl, ShaderText::kWgsl}) {
    const TokenList tokens = tokens_of(text, language);
    const Declarations declared = declarations_of(tokens, text, language);
    const TextureEdits textures = texture_edits(tokens, declared, language);
    std::vector<TextEdit> edits = declared.edits;
    edits.insert(edits.end(), textures.edits.begin(), textures.edits.end());
    for (const TextEdit& edit : edits)
      if (edit.begin > edit.end || edit.end > text.size())
        throw std::logic_error("an edit beyond the text");
    if (std::ranges::count(edited(text, std::move(edits)), '\n') != std::ranges::count(text, '\n'))
      throw std::logic_error("a text with other lines");
    uncalled_functions(tokens, declared);
    for (std::size_t i = 0; i < std::min(declared.functions.size(), kFunctions); ++i)
      reach_of(declared.functions[i].name, tokens, declared, textures.edits);
  }
}

}  // namespace lobelia::fuzz
