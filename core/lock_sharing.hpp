// Whether locks on a file are seen by every machine that shares its file system.
#pragma once

#include <string>
#include <string_view>

namespace lobelia {

struct LockSharing {
  bool shared = false;
  std::string
      why;  ///< a few words: "ext4, a file system of this machine", "nfs4 with local_lock=all"
};

/// By the mount of device `device` ("0:52", "8:1") in the text of /proc/self/mountinfo; of several mounts of it by
/// the one whose root is nearest above `path`. Looks at nothing but its arguments.
LockSharing lock_sharing_of(std::string_view mountinfo, std::string_view device,
                            std::string_view path);

}  // namespace lobelia
