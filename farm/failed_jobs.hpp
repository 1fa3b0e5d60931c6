// The input of failed jobs and the log of their engines, kept to look for the reason.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <string>

namespace lobelia {

/// DIR/failed/CELL/JOB/: at most kMost of them, each of at most kMostBytes. Follows no links. For any thread.
class FailedJobs {
 public:
  static constexpr char kName[] = "failed";
  static constexpr std::size_t kMost = 100;
  static constexpr std::uint64_t kMostBytes = 16 << 20;

  /// `directory` is DIR/failed; empty: nothing is kept.
  explicit FailedJobs(std::filesystem::path directory);

  /// Lets `write` fill the job's directory. Returns "failed/CELL/JOB"; empty over the limits, or if it cannot be written.
  std::string keep(const std::string& cell, const std::string& job,
                   const std::function<void(const std::filesystem::path& directory)>& write);
  /// After a success.
  void forget(const std::string& cell, const std::string& job);
  /// Forgets those for which `is_over` is true.
  void forget_if(
      const std::function<bool(const std::string& cell, const std::string& job)>& is_over);

 private:
  void remove(const std::string& cell, const std::string& job) const;

  const std::filesystem::path directory_;
  std::mutex mutex_;
  std::set<std::string> kept_;  ///< "CELL/JOB"
};

}  // namespace lobelia
