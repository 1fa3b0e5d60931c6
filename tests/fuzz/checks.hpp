// Laws of our readers for every input. A check throws std::logic_error if its reader breaks one. Any other exception that
// leaves a check is a find too.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "base/system/error.hpp"

namespace lobelia::fuzz {

/// A reader refuses its input with Error(kInput) and a message.
inline void check_refusal(const Error& error) {
  if (error.code() != ExitCode::kInput)
    throw std::logic_error(std::string("refused as no fault of the input: ") + error.what());
  if (std::string_view(error.what()).empty()) throw std::logic_error("refused without a word");
}

/// Reads the text as a scene. It is refused, or a scene whose written text reads back to the same scene and the same
/// text.
void check_scene_reader(std::string_view text);

/// Reads the text as a scene of Mitsuba. It is refused, or a scene whose written text reads back to the same scene.
void check_mitsuba_reader(std::string_view text);

/// Reads the text as a shader of each language. The text whose variables are private has the same lines.
void check_shader_reader(std::string_view text);

/// Reads a bundle's grid.xml with the scenes that it names. It is refused, or a grid whose cells have unique ids and a
/// scene.
void check_grid_reader(std::string_view bundle);

/// Reads a bundle's records as the gallery does (farm.json, and all others as files of its first cells) and as the farm
/// does (result.json), once as they are and once with valid seals and hashes. The gallery may refuse farm.json; any other
/// fault becomes a problem of its cell, or no result.
void check_record_readers(std::string_view bundle);

/// Checks the bytes as a picture's file, and unpacks them as messages of the process that decodes. A message is refused
/// with std::runtime_error, or survives packing and unpacking.
void check_picture_door(std::string_view bytes);

}  // namespace lobelia::fuzz
