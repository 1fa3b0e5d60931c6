// What must hold of the scene reader for any bytes whatever.
#pragma once

#include <string_view>

namespace lobelia::fuzz {

/// Reads the text as a scene. It either is one, whose text as we write it reads back to the same scene
/// and the same text, or is refused with Error(kInput). Throws std::logic_error where neither is so, and lets every other
/// exception through: each is a find.
void check_scene_reader(std::string_view text);

}  // namespace lobelia::fuzz
