#include "base/system/byte_locks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <set>

#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/words/text.hpp"

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

/// Locks belong to the open file, not to the process. Plain POSIX locks would end when the process closes any descriptor
/// of the file, and would not keep two objects of one process apart.
int lock(int fd, short type, std::int64_t byte) {
  struct flock range = range_of(type, byte);
  return ::fcntl(fd, F_OFD_SETLK, &range);
}

/// No number has this byte, nor those beyond it, which sharing() tries.
constexpr std::int64_t kUnusedByte = std::int64_t{1} << 62;

/// The end of a lock must be a positive offset too.
std::int64_t byte_of(std::uint64_t number) { return std::int64_t(number >> 2); }

struct Mount {
  std::string place, type;
  std::set<std::string, std::less<>> options;  ///< of the mount and of its file system
};

/// A space is written "\040".
std::string without_escapes(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto digits = text.substr(i, 4);
    if (digits.size() == 4 && digits[0] == '\\' &&
        std::ranges::all_of(digits.substr(1), [](char c) { return c >= '0' && c <= '7'; })) {
      plain += char((digits[1] - '0') * 64 + (digits[2] - '0') * 8 + (digits[3] - '0'));
      i += 3;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

/// Reads "36 35 98:0 /mnt1 /mnt2 rw,noatime master:1 - ext3 /dev/root rw,errors=continue". False for other devices than
/// `device`, if that is not empty.
bool parse(const std::string& line, std::string_view device, Mount& mount) {
  const std::vector<std::string> fields = split(line, " ");
  const auto dash = std::ranges::find(fields, "-");
  if (fields.size() < 6 || (!device.empty() && fields[2] != device) || fields.end() - dash < 4)
    return false;
  mount.place = without_escapes(fields[4]);
  mount.type = dash[1];
  mount.options.clear();
  for (const std::string& list : {fields[5], dash[3]})
    for (std::string& option : split(list, ",")) mount.options.insert(std::move(option));
  return true;
}

LockSharing judge(const Mount& mount) {
  const std::string& type = mount.type;
  const auto is = [&](std::initializer_list<std::string_view> types) {
    return std::ranges::find(types, type) != types.end();
  };
  const auto has = [&](std::initializer_list<const char*> options) -> std::string {
    for (const char* option : options)
      if (mount.options.contains(option)) return option;
    return "";
  };
  const auto shared_unless = [&](std::initializer_list<const char*> options) -> LockSharing {
    if (const std::string option = has(options); !option.empty())
      return {false, fmt::format("{} with {}: its locks are this machine's", type, option)};
    return {true, fmt::format("{}, whose machines see each other's locks", type)};
  };
  if (is({"nfs", "nfs4"})) return shared_unless({"nolock", "local_lock=all", "local_lock=posix"});
  if (type == "lustre" && has({"localflock", "noflock", "flock"}).empty())
    return {false, "lustre without flock: it has no locks"};
  if (type == "lustre") return shared_unless({"localflock", "noflock"});
  if (is({"cifs", "smb3"})) return shared_unless({"nobrl"});
  if (is({"gfs2", "ocfs2"})) return shared_unless({"localflocks"});
  if (is({"ceph", "gpfs"})) return shared_unless({});
  if (type == "fuse" || type.starts_with("fuse.") ||
      is({"9p", "virtiofs", "afs", "beegfs", "orangefs", "pvfs2", "coda", "vboxsf", "prl_fs"}))
    return {false, fmt::format("{}: whether other machines see its locks is not told", type)};
  return {true, fmt::format("{}, a file system of this machine", type)};
}

}  // namespace

ByteLocks::Claim::Claim(Claim&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), byte_(other.byte_) {}

ByteLocks::Claim::~Claim() {
  if (fd_ >= 0) lock(fd_, F_UNLCK, byte_);
}

ByteLocks::ByteLocks(const HeldDirectory& directory, const std::string& name, Opening opening)
    : path_(directory.path() / name) {
  const int flags = O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
  file_ = Descriptor(::openat(directory.fd(), name.c_str(),
                              opening == Opening::kMake ? flags | O_CREAT : flags, 0666));
  struct stat status {};
  if (file_ && (::fstat(file_.get(), &status) != 0 || !S_ISREG(status.st_mode))) {
    file_.close();
    errno = EINVAL;
  }
  if (!file_) {
    why_not_ = fmt::format("{} cannot be opened: {}", name, std::strerror(errno));
    return;
  }
  inode_ = status.st_ino;
  works_ = lock(file_.get(), F_RDLCK, kUnusedByte) == 0 || errno == EAGAIN || errno == EACCES;
  if (!works_) why_not_ = fmt::format("its file system has no locks: {}", std::strerror(errno));
}

std::optional<ByteLocks::Claim> ByteLocks::try_claim(std::uint64_t number, bool shared) const {
  if (!works_) return Claim(-1, 0);
  const std::int64_t byte = byte_of(number);
  if (lock(file_.get(), shared ? F_RDLCK : F_WRLCK, byte) == 0) return Claim(file_.get(), byte);
  if (errno == EAGAIN || errno == EACCES) return std::nullopt;
  return Claim(-1, 0);
}

bool ByteLocks::is_claimed(std::uint64_t number) const {
  if (!works_) return false;
  struct flock range = range_of(F_WRLCK, byte_of(number));
  return ::fcntl(file_.get(), F_OFD_GETLK, &range) == 0 && range.l_type != F_UNLCK;
}

void ByteLocks::write_holder() const {
  const std::string text = fmt::format("{} {}", host_name(), ::getpid());
  // A full disk does not matter: the lock is held.
  if (::ftruncate(file_.get(), 0) != 0 || ::pwrite(file_.get(), text.data(), text.size(), 0) < 0)
    errno = 0;
}

std::string ByteLocks::holder() const {
  std::array<char, 256> text{};
  return printable({text.data(), read_at(file_.get(), text.data(), text.size())});
}

LockSharing ByteLocks::sharing() const {
  if (!works_) return {false, why_not_};
  // Opened again, as another process would.
  const Descriptor other(::open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  struct stat held {
  }, there{};
  if (!other || ::fstat(file_.get(), &held) != 0 || ::fstat(other.get(), &there) != 0 ||
      held.st_dev != there.st_dev || held.st_ino != there.st_ino)
    return {false, "the file of locks is not the one in the cache any more"};
  const std::int64_t byte = kUnusedByte + 1 + std::random_device()();
  const bool refused =
      lock(file_.get(), F_WRLCK, byte) == 0 && lock(other.get(), F_WRLCK, byte) != 0;
  lock(file_.get(), F_UNLCK, byte);
  if (!refused) return {false, "a lock that is held was given away again"};
  std::ifstream file("/proc/self/mountinfo");
  const std::string mounts((std::istreambuf_iterator<char>(file)), {});
  std::error_code ignored;
  return lock_sharing_of(mounts, fmt::format("{}:{}", major(held.st_dev), minor(held.st_dev)),
                         std::filesystem::canonical(path_, ignored).native());
}

LockSharing lock_sharing_of(std::string_view mountinfo, std::string_view device,
                            std::string_view path) {
  Mount best, mount;
  const std::vector<std::string> lines = split(mountinfo, "\n");
  // On some file systems (btrfs) the device of a file is not that of its mount.
  for (const std::string_view wanted : {device, std::string_view()}) {
    for (const std::string& line : lines) {
      if (!parse(line, wanted, mount) || (wanted.empty() && !is_below(path, mount.place))) continue;
      // The last of several mounts at one place hides the others.
      const bool is_above = is_below(path, mount.place), best_is = is_below(path, best.place);
      if (best.type.empty() || (is_above && (!best_is || mount.place.size() >= best.place.size())))
        best = mount;
    }
    if (!best.type.empty()) break;
  }
  if (best.type.empty()) return {false, "its file system is not among the mounts"};
  return judge(best);
}

}  // namespace lobelia
