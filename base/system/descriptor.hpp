// File descriptors that close themselves, and system calls that go on after a signal.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <utility>

namespace lobelia {

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  /// Keeps errno.
  void close() {
    const int error = errno;
    if (number_ >= 0) ::close(release());
    errno = error;
  }
  /// The caller closes it.
  int release() { return std::exchange(number_, -1); }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

/// Repeats a system call that a signal has interrupted.
template <class Call>
auto retried(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// Reads `size` bytes of a regular file, from `offset` on. Returns how many it read: fewer where the file ends (errno
/// is 0) or cannot be read (errno says why).
inline std::size_t read_at(int file, void* target, std::size_t size, std::size_t offset = 0) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = retried([&] {
      return ::pread(file, static_cast<char*>(target) + done, size - done, off_t(offset + done));
    });
    if (n == 0) errno = 0;
    if (n <= 0) break;
    done += std::size_t(n);
  }
  return done;
}

}  // namespace lobelia
