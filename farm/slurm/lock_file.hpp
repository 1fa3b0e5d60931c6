// A lock that is gone with its holder, over a network file system too.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lobelia {

/// A byte-range lock of the open file description (fcntl F_OFD_SETLK, Linux): a killed process gives it up, and
/// NFS carries it from host to host where lockd runs.
class LockFile {
 public:
  enum class State { kHeld, kTaken, kUnsupported };
  /// Tries once. The file is made, holds "HOST PID" of its last holder, and stays. Throws Error(kOutput).
  explicit LockFile(const std::filesystem::path& path);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  State state() const { return state_; }
  /// "host 1234" of whoever has it, for a message.
  const std::string& holder() const { return holder_; }

 private:
  int fd_ = -1;
  State state_ = State::kUnsupported;
  std::string holder_;
};

}  // namespace lobelia
