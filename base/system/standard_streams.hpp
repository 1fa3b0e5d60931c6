// Messages on stderr. It is no error if one cannot be written, for example because stderr is closed or its disk is full:
// the work goes on.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace lobelia {

/// Opens those of the descriptors 0, 1 and 2 that are closed, before any other file is opened. Otherwise a picture could
/// get the number of stderr, and the messages. Writing to a stdout opened here fails as before.
void hold_standard_descriptors() noexcept;

/// Writes to stderr, and waits for a slow reader until interrupted(). Drops the rest.
void write_message(std::string_view text) noexcept;
/// The same without waiting, for progress. May be called in a signal handler.
void write_message_if_room(std::string_view text) noexcept;

/// write_message() with fmt::format. Throws nothing, not even without memory.
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) noexcept {
  try {
    write_message(fmt::format(format, std::forward<Arguments>(arguments)...));
  } catch (const std::exception&) {
    write_message("lobelia: a message is lost, for want of memory\n");
  }
}

}  // namespace lobelia
