// What any measure of two pictures asks for first.
#pragma once

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/image.hpp"

namespace lobelia {

/// Throws Error(kInput) unless the two have the same size, and pixels.
inline void require_same_size(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height())
    throw Error(ExitCode::kInput, fmt::format("the sizes differ: {} x {} against {} x {}",
                                              a.width(), a.height(), b.width(), b.height()));
  if (a.pixel_count() == 0) throw Error(ExitCode::kInput, "the pictures have no pixels");
}

}  // namespace lobelia
