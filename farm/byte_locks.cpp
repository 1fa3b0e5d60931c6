#include "farm/byte_locks.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace lobelia {
namespace {

/// Locks of the open file, not of the process: POSIX's own would end with any descriptor of the file that the
/// process closes, and would not tell two objects of one process apart.
int lock(int fd, short type, std::int64_t byte) {
  struct flock range {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = byte;
  range.l_len = 1;
  return ::fcntl(fd, F_OFD_SETLK, &range);
}

/// Offsets are positive, and a lock's end must be one too.
std::int64_t byte_of(std::uint64_t number) { return std::int64_t(number >> 2); }

}  // namespace

ByteLocks::Claim::Claim(Claim&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), byte_(other.byte_) {}

ByteLocks::Claim::~Claim() {
  if (fd_ >= 0) lock(fd_, F_UNLCK, byte_);
}

ByteLocks::ByteLocks(const std::filesystem::path& file)
    : fd_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (fd_ < 0) return;
  constexpr std::int64_t kNobodysByte = std::int64_t{1} << 62;
  works_ = lock(fd_, F_RDLCK, kNobodysByte) == 0;
}

ByteLocks::~ByteLocks() {
  if (fd_ >= 0) ::close(fd_);
}

std::optional<ByteLocks::Claim> ByteLocks::try_claim(std::uint64_t number, bool shared) const {
  if (!works_) return Claim(-1, 0);
  const std::int64_t byte = byte_of(number);
  if (lock(fd_, shared ? F_RDLCK : F_WRLCK, byte) == 0) return Claim(fd_, byte);
  if (errno == EAGAIN || errno == EACCES) return std::nullopt;
  return Claim(-1, 0);
}

}  // namespace lobelia
