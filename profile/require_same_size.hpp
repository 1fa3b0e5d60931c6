// The first check of every comparison of two pictures.
#pragma once

#include <fmt/format.h>

#include <string_view>

#include "base/pictures/image.hpp"
#include "base/system/error.hpp"

namespace lobelia {

/// Throws Error(kInput) unless the two have the same size, and pixels. The message names the files, if given.
inline void require_same_size(const Image& a, const Image& b, std::string_view file_a = {},
                              std::string_view file_b = {}) {
  if (a.width() != b.width() || a.height() != b.height())
    throw Error(ExitCode::kInput, "the sizes differ: {} x {} against {} x {}{}", a.width(),
                a.height(), b.width(), b.height(),
                file_a.empty() ? "" : fmt::format(" ({} against {})", file_a, file_b));
  if (a.pixel_count() == 0) throw Error(ExitCode::kInput, "the pictures have no pixels");
}

}  // namespace lobelia
