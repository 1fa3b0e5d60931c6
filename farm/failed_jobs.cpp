#include "farm/failed_jobs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "farm/result_cache.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// The size of all files; a farm puts no directories there.
std::uint64_t bytes_in(const HeldDirectory& directory) {
  std::uint64_t sum = 0;
  for (const auto& name : directory.names())
    if (struct stat status{};
        ::fstatat(directory.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0)
      sum += std::uint64_t(status.st_size);
  return sum;
}

/// Only a farm's subdirectory `failed` may be removed from.
Ownership ownership(const fs::path& failed) {
  return {[](const HeldDirectory& root) {
            struct stat status {};
            return ::fstatat(root.fd(), "farm.json", &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                   S_ISREG(status.st_mode);
          },
          [failed](const fs::path& relative) {
            const auto parts = std::distance(relative.begin(), relative.end());
            if (parts < 2 || parts > 3 || *relative.begin() != failed) return Owned::kNo;
            return parts == 2 ? Owned::kDirectory : Owned::kTree;
          }};
}

}  // namespace

FailedJobs::FailedJobs(fs::path directory) : directory_(std::move(directory)) {
  if (directory_.empty()) return;
  const HeldDirectory root = HeldDirectory(directory_.parent_path()).below(directory_.filename());
  for (const auto& cell : root.names())
    for (const auto& job : root.below(cell).names()) kept_.insert(cell + "/" + job);
}

std::string FailedJobs::keep(const std::string& cell, const std::string& job,
                             const std::function<void(const fs::path&)>& write) {
  if (directory_.empty() || !is_plain_name(cell) || !is_plain_name(job)) return "";
  const std::string name = cell + "/" + job;
  {
    const std::scoped_lock lock(mutex_);
    if (!kept_.contains(name) && kept_.size() >= kMost) return "";
    kept_.insert(name);
  }
  remove(cell, job);
  try {
    const HeldDirectory own = HeldDirectory(directory_.parent_path())
                                  .make_below(directory_.filename())
                                  .make_below(cell)
                                  .make_below(job);
    // The open directory, even if its name leads elsewhere by now.
    write(fmt::format("/proc/self/fd/{}", own.fd()));
    if (bytes_in(own) <= kMostBytes) return directory_.filename().string() + "/" + name;
  } catch (const Error& error) {  // a full disk or a link: the job has its own failure to tell
    if (error.code() == ExitCode::kInterrupted) throw;
  }
  forget(cell, job);
  return "";
}

void FailedJobs::forget(const std::string& cell, const std::string& job) {
  {
    const std::scoped_lock lock(mutex_);
    if (kept_.erase(cell + "/" + job) == 0) return;
  }
  remove(cell, job);
}

void FailedJobs::forget_if(
    const std::function<bool(const std::string& cell, const std::string& job)>& is_over) {
  const std::set<std::string> kept = kept_;
  for (const auto& name : kept) {
    const auto slash = name.find('/');
    const std::string cell = name.substr(0, slash), job = name.substr(slash + 1);
    if (is_over(cell, job)) forget(cell, job);
  }
}

void FailedJobs::remove(const std::string& cell, const std::string& job) const {
  if (file_type_at(directory_ / cell) == fs::file_type::not_found) return;
  const fs::path failed = directory_.filename();
  Removal removal(directory_.parent_path(), ownership(failed));
  removal.remove(failed / cell / job);
  removal.remove(failed / cell);
}

}  // namespace lobelia
