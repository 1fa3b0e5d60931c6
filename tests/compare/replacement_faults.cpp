// Stands between the tests of replacements and the C library, and makes calls fail that change files.
#include <dlfcn.h>

#include <cerrno>

#include "tests/compare/replacement_fixture.hpp"

namespace lobelia::faults {
namespace {

/// Whether this call fails.
bool strikes(bool is_rename = false) {
  if (at == 0 || (is_rename && kind == Kind::kMeanwhile)) return false;
  ++calls;
  if (kind == Kind::kFromThenOn ? calls < at : calls != at) return false;
  if (kind == Kind::kMeanwhile) {
    at = 0;
    meanwhile();
    return false;
  }
  while (kind == Kind::kKill) ::kill(::getpid(), SIGKILL);
  errno = EIO;
  return true;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace lobelia::faults

extern "C" {
int renameat(int there, const char* from, int here, const char* to) noexcept {
  static const auto call =
      lobelia::faults::real<int(int, const char*, int, const char*)>("renameat");
  return lobelia::faults::strikes(true) ? -1 : call(there, from, here, to);
}
int linkat(int there, const char* from, int here, const char* to, int flags) noexcept {
  static const auto call =
      lobelia::faults::real<int(int, const char*, int, const char*, int)>("linkat");
  if (lobelia::faults::no_hard_links) errno = EPERM;
  return lobelia::faults::no_hard_links || lobelia::faults::strikes()
             ? -1
             : call(there, from, here, to, flags);
}
int unlinkat(int there, const char* name, int flags) noexcept {
  static const auto call = lobelia::faults::real<int(int, const char*, int)>("unlinkat");
  return lobelia::faults::strikes() ? -1 : call(there, name, flags);
}
int mkdirat(int there, const char* name, mode_t mode) noexcept {
  static const auto call = lobelia::faults::real<int(int, const char*, mode_t)>("mkdirat");
  return lobelia::faults::strikes() ? -1 : call(there, name, mode);
}
int fchmod(int file, mode_t mode) noexcept {
  static const auto call = lobelia::faults::real<int(int, mode_t)>("fchmod");
  return lobelia::faults::strikes() ? -1 : call(file, mode);
}
ssize_t write(int file, const void* bytes, size_t size) {
  static const auto call = lobelia::faults::real<ssize_t(int, const void*, size_t)>("write");
  return lobelia::faults::strikes() ? -1 : call(file, bytes, size);
}
int fsync(int) { return lobelia::faults::strikes() ? -1 : 0; }  // no test cuts the power
}
