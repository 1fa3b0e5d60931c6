// --any-format, for the commands that take pictures of others.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/contained_reader.hpp"
#include "core/picture_bytes.hpp"

namespace lobelia::cli {

inline void add_any_format(CLI::App& command) {
  command.add_flag_callback(
      "--any-format", [] { read_any_picture_format(); },
      fmt::format("Read every format that OpenImageIO knows, not only {}", kPictureFormats));
}

}  // namespace lobelia::cli
