// SHA-256 (FIPS 180-4), by Nettle.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace lobelia {

using Sha256Digest = std::array<std::uint8_t, 32>;

Sha256Digest sha256(std::string_view bytes);

class InputFile;

/// Larger files are not hashed: it is the largest that is read as a picture.
inline constexpr std::uint64_t kMostHashedBytes = std::uint64_t{8} << 30;

/// Hashes the whole file. Throws Error(kInput) if it cannot be read or has over kMostHashedBytes, and Error(kInterrupted)
/// as read_in_pieces().
Sha256Digest sha256_of_file(const std::filesystem::path& path);
Sha256Digest sha256_of_file(const InputFile& file);

/// No limit on the time of a hash.
inline constexpr std::chrono::duration<double> kAnyTime{std::numeric_limits<double>::infinity()};
/// Throws Error(kInput) also if that takes longer than `time_limit`, as for a large file on a slow disk.
Sha256Digest sha256_of_file(const InputFile& file, std::chrono::duration<double> time_limit);

/// 64 lower-case hexadecimal digits, and back. from_hex() returns false for any other text.
std::string hex(const Sha256Digest& digest);
bool from_hex(std::string_view text, Sha256Digest& digest);

}  // namespace lobelia
