// What a person is told on stderr. It is never an error that a message cannot be written: whoever closed stderr, or
// filled the disk behind it, wants the work done without.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace lobelia {

/// Opens what is closed of the descriptors 0, 1 and 2, before any other file is: else the first picture that is opened
/// would get the number of stderr, and the messages. Writing to a stdout opened here fails as it did before.
void hold_standard_descriptors() noexcept;

/// Writes to stderr, past a reader that is slow, until interrupted(). What cannot be written is dropped.
void write_message(std::string_view text) noexcept;
/// The same, but drops what there is no room for at once: for progress. May be called in a signal handler.
void write_message_if_room(std::string_view text) noexcept;

/// write_message() of a text with arguments, as fmt::format has them. Throws nothing, not even for want of memory.
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) noexcept {
  try {
    write_message(fmt::format(format, std::forward<Arguments>(arguments)...));
  } catch (const std::exception&) {
    write_message("lobelia: a message is lost, for want of memory\n");
  }
}

}  // namespace lobelia
