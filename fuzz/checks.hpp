// Laws that our readers keep for every input. Each check throws std::logic_error where it does not, and
// lets every exception through that the reader may not throw: each is a find.
#pragma once

#include <string_view>

namespace lobelia::fuzz {

/// Reads the text as a scene. It either is one, whose text as we write it reads back to the same scene
/// and the same text, or is refused with Error(kInput).
void check_scene_reader(std::string_view text);

/// Reads a bundle's grid.xml, with the scenes that it names. It either is a grid, with cells that have ids of their own
/// and a scene, or is refused with Error(kInput).
void check_grid_reader(std::string_view bundle);

/// Reads a bundle's records as the gallery does (farm.json, and all others as the files of its first cells) and as the
/// farm does (result.json), once as they are and once with seals and hashes that fit. The gallery's farm.json may be
/// refused with Error(kInput); everything else becomes a problem of its cell, or no result.
void check_record_readers(std::string_view bundle);

/// Looks at the bytes as a picture's file before a library does, and takes them apart as an answer of the process that
/// decodes. A message that is accepted survives packing; all others are refused with std::runtime_error.
void check_picture_door(std::string_view bytes);

}  // namespace lobelia::fuzz
