// Locks between processes, on one machine or on several that share a file system.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/system/removal.hpp"

namespace lobelia {

/// Whether every machine that shares a file system sees the locks on a file.
struct LockSharing {
  bool shared = false;
  std::string why;  ///< "ext4, a file system of this machine", "nfs4 with local_lock=all"
};

/// Finds the mount of `device` ("0:52", "8:1") in the text of /proc/self/mountinfo; of several, the one nearest above
/// `path`.
LockSharing lock_sharing_of(std::string_view mountinfo, std::string_view device,
                            std::string_view path);

/// Locks on single bytes of one file (fcntl F_OFD_SETLK). The kernel frees the locks of a process that dies. Two objects
/// exclude each other in one process as in two. If the file cannot be opened or its file system has no locks, every
/// claim is granted.
class ByteLocks {
 public:
  /// A lock on a byte, until its end. It must not outlive its ByteLocks.
  class Claim {
   public:
    Claim(Claim&& other) noexcept;
    Claim& operator=(Claim&&) = delete;
    ~Claim();

   private:
    friend class ByteLocks;
    Claim(int fd, std::int64_t byte) : fd_(fd), byte_(byte) {}
    int fd_;
    std::int64_t byte_;
  };

  enum class Opening { kMake, kLook };  ///< kLook does not create the file
  /// Opens the file `name` in a directory, if it is a regular file.
  ByteLocks(const HeldDirectory& directory, const std::string& name,
            Opening opening = Opening::kMake);

  /// Claims `number`; none while another object holds it, unless both are `shared`.
  std::optional<Claim> try_claim(std::uint64_t number, bool shared = false) const;
  /// Whether another object holds it, shared or not. Takes no lock.
  bool is_claimed(std::uint64_t number) const;
  bool is_open() const { return bool(file_); }
  /// Whether locks have an effect here.
  bool works() const { return works_; }
  const std::string& why_not() const { return why_not_; }
  /// Writes "HOST PID" of this process into the file, for messages of processes that find it locked.
  void write_holder() const;
  std::string holder() const;
  /// The inode of the open file; 0 if there is none.
  std::uint64_t inode() const { return inode_; }
  /// Whether locks keep out processes of other machines too, as far as this machine can tell: it tries a lock, and looks
  /// whether the file is still the one in the directory and how it is mounted.
  LockSharing sharing() const;

 private:
  Descriptor file_;
  bool works_ = false;
  std::uint64_t inode_ = 0;
  std::filesystem::path path_;
  std::string why_not_;  ///< why `works_` is false
};

}  // namespace lobelia
