// Preloaded into the program: the call $FAIL_CALL fails with the errno $FAIL_ERRNO, as on a faulty disk, every time that its
// path ends in $FAIL_PATH. A call without a path fails always.
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

[[maybe_unused]] const int g_only_here = unsetenv("LD_PRELOAD");  // no business of other programs

bool fails(const char* call, const char* path) {
  const char* const wanted = getenv("FAIL_CALL");
  const char* const end = getenv("FAIL_PATH");
  const char* const number = getenv("FAIL_ERRNO");
  if (!wanted || !number || strcmp(wanted, call) != 0) return false;
  const size_t size = end ? strlen(end) : 0, length = strlen(path);
  if (length < size || (size > 0 && strcmp(path + length - size, end) != 0)) return false;
  errno = atoi(number);
  return true;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

#define FAILING(type, name, parameters, arguments, path, failure) \
  type name parameters {                                          \
    static const auto call = real<type parameters>(#name);        \
    if (fails(#name, path)) return failure;                       \
    return call arguments;                                        \
  }

extern "C" {
FAILING(int, stat, (const char* path, struct stat* status), (path, status), path, -1)
FAILING(int, lstat, (const char* path, struct stat* status), (path, status), path, -1)
FAILING(char*, getcwd, (char* buffer, size_t size), (buffer, size), "", nullptr)
FAILING(dirent*, readdir, (DIR * directory), (directory), "", nullptr)
FAILING(ssize_t, sendmsg, (int socket, const msghdr* message, int flags), (socket, message, flags),
        "", -1)
FAILING(int, poll, (pollfd * waits, nfds_t count, int milliseconds), (waits, count, milliseconds),
        "", -1)
}
