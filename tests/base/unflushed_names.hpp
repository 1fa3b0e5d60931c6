// Stands between a test program and the C library: notes each file that gets its name before its content is flushed to the
// disk. Only one source of a program may include this, as it defines the C library's functions.
#pragma once

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <ctime>
#include <mutex>

#include "tests/test.hpp"

namespace lobelia::unflushed {

inline std::mutex mutex;
/// Without a watch nothing is locked, so that a fork at any time is safe.
inline std::atomic<bool> is_watching = false;
inline std::set<ino_t> flushed;
inline timespec all_flushed{};  ///< what was written before this is on the disk
inline std::vector<std::string> names;
inline int flushes = 0;

inline bool is_flushed(const struct stat& status) {
  const timespec written = status.st_mtim;
  return flushed.contains(status.st_ino) || written.tv_sec < all_flushed.tv_sec ||
         (written.tv_sec == all_flushed.tv_sec && written.tv_nsec <= all_flushed.tv_nsec);
}

/// Notes `path`, or what is in the directory `path`, if it is a file that is not flushed.
inline void note(const std::filesystem::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return;
  if (S_ISREG(status.st_mode) && !is_flushed(status)) names.push_back(path.filename());
  if (!S_ISDIR(status.st_mode)) return;
  for (const auto& entry : std::filesystem::directory_iterator(path)) note(entry.path());
}

inline void note_at(int directory, const char* path) {
  if (!is_watching) return;
  const std::scoped_lock lock(mutex);
  if (path[0] == '/' || directory == AT_FDCWD) return note(path);
  note(std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(directory)) / path);
}

/// As long as it lives, names are watched.
class Watch {
 public:
  Watch() {
    const std::scoped_lock lock(mutex);
    is_watching = true;
    flushed.clear();
    names.clear();
    flushes = 0;
    all_flushed = {};
  }
  ~Watch() { is_watching = false; }
};

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace lobelia::unflushed

extern "C" {
int fsync(int file) {
  namespace here = lobelia::unflushed;
  static const auto call = here::real<int(int)>("fsync");
  struct stat status {};
  if (here::is_watching && ::fstat(file, &status) == 0) {
    const std::scoped_lock lock(here::mutex);
    here::flushed.insert(status.st_ino);
    ++here::flushes;
  }
  return call(file);
}
int syncfs(int file) noexcept {
  namespace here = lobelia::unflushed;
  static const auto call = here::real<int(int)>("syncfs");
  if (here::is_watching) {
    const std::scoped_lock lock(here::mutex);
    ::clock_gettime(CLOCK_REALTIME, &here::all_flushed);
    ++here::flushes;
  }
  return call(file);
}
int rename(const char* from, const char* to) noexcept {
  static const auto call = lobelia::unflushed::real<int(const char*, const char*)>("rename");
  lobelia::unflushed::note_at(AT_FDCWD, from);
  return call(from, to);
}
int renameat(int there, const char* from, int here, const char* to) noexcept {
  static const auto call =
      lobelia::unflushed::real<int(int, const char*, int, const char*)>("renameat");
  lobelia::unflushed::note_at(there, from);
  return call(there, from, here, to);
}
}
