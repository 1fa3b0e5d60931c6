#include "base/system/standard_streams.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>

#include "base/system/interrupt.hpp"

namespace lobelia {
namespace {

constexpr int kWaitMilliseconds = 100;  // between looks for Ctrl-C

enum class Room {
  kYes,
  kNotYet,
  kNever,
  kUnknown  ///< the system cannot tell: a write may wait
};

Room wait_for_room(int milliseconds) {
  pollfd stream{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
  const int ready = ::poll(&stream, 1, milliseconds);
  if (ready < 0) return errno == EINTR ? Room::kNotYet : Room::kUnknown;
  if (ready == 0) return Room::kNotYet;
  return (stream.revents & POLLOUT) != 0 ? Room::kYes : Room::kNever;
}

/// Writes the beginning of `text` and removes it from `text`; false if stderr cannot be written. Does not wait: a pipe
/// with room takes PIPE_BUF bytes.
bool write_piece(std::string_view& text) {
  const ssize_t written =
      ::write(STDERR_FILENO, text.data(), std::min<std::size_t>(text.size(), PIPE_BUF));
  if (written < 0) return errno == EINTR || errno == EAGAIN;
  text.remove_prefix(std::size_t(written));
  return written > 0;
}

}  // namespace

void hold_standard_descriptors() noexcept {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(fd, F_GETFD) >= 0) continue;
    // open() gives the lowest free number, which is `fd`. Stdout is opened for reading, so that writing to it fails.
    const int held = ::open("/dev/null", fd == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    if (held < 0 && ::open("/", O_PATH) < 0) return;
  }
}

void write_message(std::string_view text) noexcept {
  while (!text.empty()) {
    const Room room = wait_for_room(interrupted() ? 0 : kWaitMilliseconds);
    if (room == Room::kNever || (room != Room::kYes && interrupted())) return;
    if (room != Room::kNotYet && !write_piece(text)) return;
  }
}

void write_message_if_room(std::string_view text) noexcept {
  const int error = errno;  // of the code that a signal handler interrupts
  std::size_t left = text.size() + 1;
  while (!text.empty() && text.size() < left && wait_for_room(0) == Room::kYes) {
    left = text.size();
    if (!write_piece(text)) break;
  }
  errno = error;
}

}  // namespace lobelia
