#include "core/open_beneath.hpp"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/syscall.h>

#include "core/descriptor.hpp"

namespace lobelia {

constexpr int kReading = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

int open_beneath(int directory, const std::vector<std::string>& names) {
  std::string path = ".";
  for (const std::string& name : names) path += "/" + name;
  open_how how{};
  how.flags = kReading;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  long file = -1;
  do {  // EAGAIN: something on the way was renamed meanwhile
    file = ::syscall(SYS_openat2, directory, path.c_str(), &how, sizeof how);
  } while (file < 0 && (errno == EAGAIN || errno == EINTR));
  // EPERM: the seccomp filter of a container does not know the call.
  if (file < 0 && (errno == ENOSYS || errno == EPERM))
    return open_beneath_by_steps(directory, names);
  return int(file);
}

int open_beneath_by_steps(int directory, const std::vector<std::string>& names) {
  Descriptor place(::openat(directory, ".", kReading | O_DIRECTORY));
  for (std::size_t i = 0; i < names.size() && place; ++i)
    place = Descriptor(::openat(place.get(), names[i].c_str(),
                                kReading | O_NOFOLLOW | (i + 1 < names.size() ? O_DIRECTORY : 0)));
  return place.release();
}

}  // namespace lobelia
