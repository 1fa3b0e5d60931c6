#include "farm/slurm/lock_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "core/host.hpp"
#include "core/text.hpp"

namespace lobelia {

LockFile::LockFile(const std::filesystem::path& path) {
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (fd_ < 0)
    throw Error(ExitCode::kOutput, fmt::format("{}: {}", path.string(), std::strerror(errno)));
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  if (::fcntl(fd_, F_OFD_SETLK, &lock) == 0) {
    state_ = State::kHeld;
    const std::string text = fmt::format("{} {}\n", host_name(), ::getpid());
    // Only for messages: a disk that is full keeps nobody from holding the lock.
    if (::ftruncate(fd_, 0) != 0 || ::pwrite(fd_, text.data(), text.size(), 0) < 0) errno = 0;
  } else {
    state_ = errno == EAGAIN || errno == EACCES ? State::kTaken : State::kUnsupported;
    std::array<char, 256> text{};
    const ssize_t size = ::pread(fd_, text.data(), text.size(), 0);
    if (size > 1) holder_ = printable({text.data(), std::size_t(size) - 1});
  }
}

LockFile::~LockFile() { ::close(fd_); }

}  // namespace lobelia
