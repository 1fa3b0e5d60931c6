#include "farm/group_flush.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <set>

#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostWaiting = 256;
/// Fewer files are flushed one by one: a flush of the file system also waits for what other programs write.
constexpr std::size_t kFewFiles = 8;

/// Before Linux 5.8 syncfs() was silent about failed writes.
bool syncfs_tells_failures() {
  utsname system{};
  int major = 0, minor = 0;
  return ::uname(&system) == 0 && std::sscanf(system.release, "%d.%d", &major, &minor) == 2 &&
         (major > 5 || (major == 5 && minor >= 8));
}

/// Network file systems may keep data in the server's memory, others look at their own files only.
bool syncfs_is_enough(int directory) {
  struct statfs status {};
  constexpr long kXfs = 0x58465342;
  return ::fstatfs(directory, &status) == 0 &&
         (status.f_type == EXT4_SUPER_MAGIC || status.f_type == kXfs);
}

}  // namespace

GroupFlush::GroupFlush(const std::vector<fs::path>& directories,
                       std::function<void(std::exception_ptr)> on_failure)
    : on_failure_(std::move(on_failure)) {
  std::set<dev_t> devices;
  for (const fs::path& path : directories) {
    // Opened before anything is written: syncfs() tells of failures since then.
    Descriptor directory(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    struct stat status {};
    if (!directory || ::fstat(directory.get(), &status) != 0 || !syncfs_tells_failures() ||
        !syncfs_is_enough(directory.get())) {
      file_systems_.clear();
      return;
    }
    if (devices.insert(status.st_dev).second) file_systems_.push_back(std::move(directory));
  }
  thread_ = std::thread([this] { run(); });
}

GroupFlush::~GroupFlush() { finish(); }

std::optional<FlushLater> GroupFlush::later() const {
  return file_systems_.empty() ? std::nullopt : std::optional<FlushLater>(std::in_place);
}

void GroupFlush::add(std::vector<fs::path> files, std::function<void()> then) {
  if (!thread_.joinable()) return then();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.size() < kMostWaiting; });
  waiting_.push_back({std::move(files), std::move(then)});
  changed_.notify_all();
}

void GroupFlush::finish() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void GroupFlush::run() {
  while (true) {
    std::vector<Added> group;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return !waiting_.empty() || ends_; });
      if (waiting_.empty()) return;
      group.swap(waiting_);
    }
    changed_.notify_all();
    try {
      flush(group);
    } catch (...) {
      on_failure_(std::current_exception());
      continue;
    }
    for (Added& one : group) {
      try {
        one.then();
      } catch (...) {
        on_failure_(std::current_exception());
      }
      one = {};
    }
  }
}

void GroupFlush::flush(const std::vector<Added>& group) const {
  std::size_t files = 0;
  for (const Added& one : group) files += one.files.size();
  bool is_done = files >= kFewFiles;
  for (const Descriptor& file_system : file_systems_)
    is_done = is_done && ::syncfs(file_system.get()) == 0;
  if (is_done) return;
  // After a failure of syncfs(), which may be another program's, each file tells of its own.
  for (const Added& one : group)
    for (const fs::path& path : one.files) {
      const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
      // One that was removed meanwhile is missed by its `then`.
      if (file ? ::fsync(file.get()) != 0 : errno != ENOENT) cannot_write(path, errno);
    }
}

}  // namespace lobelia
