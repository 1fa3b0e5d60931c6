#pragma once

#include "core/error.hpp"

namespace lobelia::gallery {

/// What `make` returns. Nothing where the input is no good: a broken picture leaves a gap, and no more.
template <class Make>
auto unless_input(const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return {};
  }
}

}  // namespace lobelia::gallery
