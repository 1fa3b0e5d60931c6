// Limits where another program may write. Needs no special rights.
#pragma once

#include <filesystem>

#include "base/system/descriptor.hpp"

namespace lobelia {

/// A Landlock ruleset for base/system/spawn.hpp: the program and all that it starts may create, change and remove files
/// below `directory` only, and write to /dev/null. Reading stays free.
class WriteLimit {
 public:
  /// Throws Error(kEngine or kNoResources) if the kernel has Landlock but refuses this limit.
  explicit WriteLimit(const std::filesystem::path& directory);
  /// -1 if the kernel has no Landlock: before Linux 5.13, left out, or forbidden by a container.
  int ruleset() const { return ruleset_.get(); }

 private:
  Descriptor ruleset_;
};

}  // namespace lobelia
