// Who is at work on what, told to other processes, also on other machines that share the file system.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace lobelia {

/// Locks on single bytes of one empty file, held by the kernel for this object: whoever dies lets go of his at once,
/// and nothing is left to clean up. Objects of one process exclude each other as those of two do. Where the file
/// cannot be made, or its file system knows no locks, every claim is granted: results are then made twice
/// at worst.
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

  explicit ByteLocks(const std::filesystem::path& file);
  ~ByteLocks();
  ByteLocks(const ByteLocks&) = delete;
  ByteLocks& operator=(const ByteLocks&) = delete;

  /// For the place that `number` names; none while another object holds it, unless both are `shared`.
  std::optional<Claim> try_claim(std::uint64_t number, bool shared = false) const;
  /// Whether locks mean anything here.
  bool works() const { return works_; }

 private:
  int fd_ = -1;
  bool works_ = false;
};

}  // namespace lobelia
