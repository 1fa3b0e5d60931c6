// Locks between processes, also of other machines that share the file system.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/lock_sharing.hpp"
#include "core/removal.hpp"

namespace lobelia {

/// Locks on single bytes of one file (fcntl F_OFD_SETLK). The kernel frees the locks of a process that dies. Objects of
/// one process exclude each other as those of two do. Where the file cannot be made, or its file system knows no locks,
/// every claim is granted.
class ByteLocks {
 public:
  /// Lets go of its byte at the end.
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

  enum class Opening { kMake, kLook };  ///< with kLook a file that is not there stays so
  /// Of the file `name` in a directory; what is no regular file is not opened.
  ByteLocks(const HeldDirectory& directory, const std::string& name,
            Opening opening = Opening::kMake);
  ~ByteLocks();
  ByteLocks(const ByteLocks&) = delete;
  ByteLocks& operator=(const ByteLocks&) = delete;

  /// For the place that `number` names; none while another object holds it, unless both are `shared`.
  std::optional<Claim> try_claim(std::uint64_t number, bool shared = false) const;
  /// Whether another object holds it, shared or not; asking keeps nobody from it.
  bool is_claimed(std::uint64_t number) const;
  bool is_open() const { return fd_ >= 0; }
  /// Whether locks mean anything here.
  bool works() const { return works_; }
  const std::string& why_not() const { return why_not_; }
  /// Puts "HOST PID" of this process into the file, for a message to whoever finds it locked.
  void write_holder() const;
  std::string holder() const;
  /// The number of the open file in its file system; 0: there is none.
  std::uint64_t inode() const { return inode_; }
  /// Whether processes of other machines are kept out too, as far as this one can tell: locks are tried, the file has
  /// to be the one in the directory still, and its mount must not say otherwise.
  LockSharing sharing() const;

 private:
  int fd_ = -1;
  bool works_ = false;
  std::uint64_t inode_ = 0;
  std::filesystem::path path_;
  std::string why_not_;  ///< it does not work
};

}  // namespace lobelia
