// Limits for the process that decodes an untrusted picture.
#pragma once

#include <cstdint>
#include <string>

#include "base/pictures/image_io_module.hpp"

namespace lobelia {

/// Bytes of memory for opening a picture, on top of what the process had at first.
inline constexpr std::uint64_t kMemoryToOpen = std::uint64_t{256} << 20;

/// Why a file of that size is refused for what its header claims; empty if it is read.
std::string claim_problem(const PictureClaim& claim, std::uint64_t file_bytes,
                          const PictureLimit& limit);

/// Bytes of address space for decoding once the header is known, on top of what the process had at first.
std::uint64_t memory_to_read(const PictureClaim& claim, std::uint64_t file_bytes);

/// Processor time for all threads together; `claim` is empty before the header is known.
std::uint64_t seconds_to_read(const PictureClaim& claim, std::uint64_t file_bytes);

/// Wall time for OpenImageIO to be loaded, which takes half a second of processor time.
constexpr unsigned kSecondsToLoad = 30;

/// Wall time after which the process is killed: far more than a busy machine needs.
std::uint64_t seconds_to_wait(std::uint64_t file_bytes, const PictureLimit& limit);

/// Set soft limits of this process, which can be raised again. Under sanitizers memory has no limit, because they reserve
/// terabytes of address space.
void limit_memory(std::uint64_t address_space_bytes);
void limit_processor_time(std::uint64_t seconds);

/// Takes from this process, for good, what decoding does not need: it cannot open, create or change files, start programs
/// or processes, use the network or send signals. Such calls fail with EPERM, and it goes on. With `may_open_files`, for
/// libraries that open a file by its name, it may open files for reading, and Landlock leaves only copies in memory to
/// open. Returns whether the kernel installed the filter of system calls.
bool lock_down(bool may_open_files);

}  // namespace lobelia
