#include "core/byte_locks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <utility>

#include "core/host.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

struct flock range_of(short type, std::int64_t byte) {
  struct flock range {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = byte;
  range.l_len = 1;
  return range;
}

/// Locks of the open file, not of the process: POSIX's own would end with any descriptor of the file that the
/// process closes, and would not tell two objects of one process apart.
int lock(int fd, short type, std::int64_t byte) {
  struct flock range = range_of(type, byte);
  return ::fcntl(fd, F_OFD_SETLK, &range);
}

/// Beyond all numbers' bytes, and room for those that sharing() tries.
constexpr std::int64_t kNobodysByte = std::int64_t{1} << 62;

/// Offsets are positive, and a lock's end must be one too.
std::int64_t byte_of(std::uint64_t number) { return std::int64_t(number >> 2); }

}  // namespace

ByteLocks::Claim::Claim(Claim&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), byte_(other.byte_) {}

ByteLocks::Claim::~Claim() {
  if (fd_ >= 0) lock(fd_, F_UNLCK, byte_);
}

ByteLocks::ByteLocks(const HeldDirectory& directory, const std::string& name, Opening opening)
    : path_(directory.path() / name) {
  const int flags = O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
  fd_ = ::openat(directory.fd(), name.c_str(), opening == Opening::kMake ? flags | O_CREAT : flags,
                 0666);
  struct stat status {};
  if (fd_ >= 0 && (::fstat(fd_, &status) != 0 || !S_ISREG(status.st_mode))) {
    ::close(std::exchange(fd_, -1));
    errno = EINVAL;
  }
  if (fd_ < 0) {
    why_not_ = fmt::format("{} cannot be opened: {}", name, std::strerror(errno));
    return;
  }
  inode_ = status.st_ino;
  works_ = lock(fd_, F_RDLCK, kNobodysByte) == 0 || errno == EAGAIN || errno == EACCES;
  if (!works_) why_not_ = fmt::format("its file system has no locks: {}", std::strerror(errno));
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

bool ByteLocks::is_claimed(std::uint64_t number) const {
  if (!works_) return false;
  struct flock range = range_of(F_WRLCK, byte_of(number));
  return ::fcntl(fd_, F_OFD_GETLK, &range) == 0 && range.l_type != F_UNLCK;
}

void ByteLocks::write_holder() const {
  const std::string text = fmt::format("{} {}", host_name(), ::getpid());
  // On a full disk the lock is held all the same.
  if (::ftruncate(fd_, 0) != 0 || ::pwrite(fd_, text.data(), text.size(), 0) < 0) errno = 0;
}

std::string ByteLocks::holder() const {
  std::array<char, 256> text{};
  const ssize_t size = ::pread(fd_, text.data(), text.size(), 0);
  return size > 0 ? printable({text.data(), std::size_t(size)}) : "";
}

LockSharing ByteLocks::sharing() const {
  if (!works_) return {false, why_not_};
  // Opened again, as another process would.
  const int other = ::open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  struct stat held {
  }, there{};
  LockSharing found;
  if (other < 0 || ::fstat(fd_, &held) != 0 || ::fstat(other, &there) != 0 ||
      held.st_dev != there.st_dev || held.st_ino != there.st_ino) {
    found.why = "the file of locks is not the one in the cache any more";
  } else {
    const std::int64_t byte = kNobodysByte + 1 + std::random_device()();
    const bool refused = lock(fd_, F_WRLCK, byte) == 0 && lock(other, F_WRLCK, byte) != 0;
    lock(fd_, F_UNLCK, byte);
    std::ifstream file("/proc/self/mountinfo");
    const std::string mounts((std::istreambuf_iterator<char>(file)), {});
    std::error_code ignored;
    if (refused)
      found = lock_sharing_of(mounts, fmt::format("{}:{}", major(held.st_dev), minor(held.st_dev)),
                              std::filesystem::canonical(path_, ignored).native());
    else
      found.why = "a lock that is held was given away again";
  }
  if (other >= 0) ::close(other);
  return found;
}

}  // namespace lobelia
