// Preloaded into the program: ends it by SIGKILL at one of the calls with which it changes files, of all that it makes
// the one that $DIE_AT counts; a write is done by half first. $COUNT_CALLS is a file that gets their number.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>

namespace {

std::atomic<long> g_calls{0};

const long g_die_at = [] {
  const char* const text = getenv("DIE_AT");
  unsetenv("LD_PRELOAD");  // no business of the engines
  return text ? atol(text) : 0;
}();

bool is_last() { return ++g_calls == g_die_at; }

[[noreturn]] void die() {
  for (;;) kill(getpid(), SIGKILL);
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

struct TellAtEnd {
  ~TellAtEnd() {
    const char* const file = getenv("COUNT_CALLS");
    if (!file) return;
    if (FILE* out = fopen(file, "w")) {
      fprintf(out, "%ld\n", g_calls.load());
      fclose(out);
    }
  }
} g_tell;

}  // namespace

#define DYING(name, parameters, arguments)                \
  int name parameters {                                   \
    static const auto call = real<int parameters>(#name); \
    if (is_last()) die();                                 \
    return call arguments;                                \
  }

extern "C" {
DYING(rename, (const char* from, const char* to), (from, to))
DYING(renameat, (int there, const char* from, int here, const char* to), (there, from, here, to))
DYING(linkat, (int there, const char* from, int here, const char* to, int flags),
      (there, from, here, to, flags))
DYING(link, (const char* from, const char* to), (from, to))
DYING(mkdir, (const char* path, mode_t mode), (path, mode))
DYING(unlink, (const char* path), (path))
DYING(chmod, (const char* path, mode_t mode), (path, mode))
DYING(fsync, (int fd), (fd))
DYING(syncfs, (int fd), (fd))

ssize_t pwrite64(int fd, const void* bytes, size_t size, off64_t at) {
  static const auto call = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  // Headers are written by the byte: too many moments that are all alike.
  if (size >= 64 && is_last()) {
    call(fd, bytes, size / 2, at);
    die();
  }
  return call(fd, bytes, size, at);
}
ssize_t pwrite(int fd, const void* bytes, size_t size, off_t at) {
  return pwrite64(fd, bytes, size, at);
}
}
