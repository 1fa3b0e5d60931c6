// The limits of a process that reads an untrusted picture.
#pragma once

#include <cstdint>
#include <string>

#include "core/image_io_module.hpp"

namespace lobelia {

/// Pixels that are read of a picture, by the size of its file. A file of few bytes can unpack to very many pixels:
/// whoever knows how large his pictures are says so, and the header is held to it before anything is unpacked.
struct PictureLimit {
  std::uint64_t pixels_of_any_file = std::uint64_t{1} << 24;
  std::uint64_t pixels_per_byte = 4096;  ///< so many more for each byte of the file
};

/// Memory to open a picture with, besides what the process had when it began.
inline constexpr std::uint64_t kMemoryToOpen = std::uint64_t{256} << 20;

/// Why a picture of that claim is not read of a file of that size; empty if it is.
std::string claim_problem(const PictureClaim& claim, std::uint64_t file_bytes,
                          const PictureLimit& limit);

/// Bytes of address space that a process may have, besides what it began with, once the header is known.
std::uint64_t memory_to_read(const PictureClaim& claim, std::uint64_t file_bytes);

/// Processor time, all threads together; `claim` is empty before the header is known.
std::uint64_t seconds_to_read(const PictureClaim& claim, std::uint64_t file_bytes);

/// Time by the clock after which a process is ended that does nothing: far beyond what a busy machine needs.
std::uint64_t seconds_to_wait(std::uint64_t file_bytes, const PictureLimit& limit);

/// Limits this process: soft limits, so that they can be raised. The sanitizers reserve terabytes of address space, so
/// with them memory has no limit.
void limit_memory(std::uint64_t address_space_bytes);
void limit_processor_time(std::uint64_t seconds);

/// Takes from this process, for good, what decoding does not need: it opens, makes and changes no file, starts no
/// program and no other process, has no network and signals nobody. What it asks of that is refused (EPERM), and it
/// goes on. With `may_open_files`, for libraries that open a file by its name, it may open files for reading, and
/// Landlock leaves none to it but copies in memory. Returns whether the kernel took the system calls away.
bool lock_down(bool may_open_files);

}  // namespace lobelia
