// Flushes the files of many threads to the disk together: a disk takes about as long for hundreds as for three.
#pragma once

#include <condition_variable>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/system/files.hpp"

namespace lobelia {

class GroupFlush {
 public:
  /// For files below these directories. `on_failure` gets each failure to flush, and what a `then` throws in this object's
  /// thread.
  GroupFlush(const std::vector<std::filesystem::path>& directories,
             std::function<void(std::exception_ptr)> on_failure);
  /// As finish().
  ~GroupFlush();

  /// To be held while files are written that are then added; empty if they are flushed one by one, as they are written.
  std::optional<FlushLater> later() const;
  /// Calls `then` once these files are on the disk, from this object's thread, or now if they were flushed already. After a
  /// failure to flush it is not called. Waits while many others wait.
  void add(std::vector<std::filesystem::path> files, std::function<void()> then);
  /// Waits for all that was added.
  void finish();

 private:
  struct Added {
    std::vector<std::filesystem::path> files;
    std::function<void()> then;
  };
  void run();
  void flush(const std::vector<Added>& group) const;

  const std::function<void(std::exception_ptr)> on_failure_;
  std::vector<Descriptor> file_systems_;  ///< none: files are flushed one by one
  std::mutex mutex_;                      // of the following
  std::condition_variable changed_;
  std::vector<Added> waiting_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace lobelia
