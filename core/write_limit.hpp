// Keeping another program from writing where it has no business, without any rights of our own.
#pragma once

#include <filesystem>

namespace lobelia {

/// What core/spawn.hpp holds a program and all that it starts to: they create, change and remove files
/// below `directory` only, /dev/null aside; reading stays free.
class WriteLimit {
 public:
  /// Throws Error(kEngine or kNoResources) where the kernel has limits and does not give this one.
  explicit WriteLimit(const std::filesystem::path& directory);
  ~WriteLimit();
  WriteLimit(const WriteLimit&) = delete;
  WriteLimit& operator=(const WriteLimit&) = delete;
  /// Of Landlock, ours; -1 where the kernel has none (Linux 5.13 and later, unless it was left out or is
  /// forbidden by a container).
  int ruleset() const { return ruleset_; }

 private:
  int ruleset_ = -1;
};

}  // namespace lobelia
