// All mistakes that have a name: docs/shader_mistakes.md.
#pragma once

#include <string>

namespace lobelia::shader_check {

std::string mistakes_document();  ///< Markdown

}  // namespace lobelia::shader_check
