#include "core/sha256.hpp"

#include <fmt/format.h>
#include <nettle/sha2.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/no_resources.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kPieceBytes = 1 << 17;

class Hasher {
 public:
  Hasher() { sha256_init(&context_); }
  void take(const void* bytes, std::size_t count) {
    sha256_update(&context_, count, static_cast<const std::uint8_t*>(bytes));
  }
  Sha256Digest finish() {
    Sha256Digest digest{};
    sha256_digest(&context_, digest.size(), digest.data());
    return digest;
  }

 private:
  sha256_ctx context_;
};

}  // namespace

Sha256Digest sha256(std::string_view bytes) {
  Hasher one;
  one.take(bytes.data(), bytes.size());
  return one.finish();
}

Sha256Digest sha256_of_file(const std::filesystem::path& path) {
  return sha256_of_file(InputFile(path));
}

Sha256Digest sha256_of_file(const InputFile& file) {
  const std::string path = file.path().string();
  const auto require_bound = [&](std::uint64_t bytes) {
    if (bytes > kMostHashedBytes)
      throw Error(ExitCode::kInput,
                  fmt::format("{}: {} bytes; at most {} are read", path, bytes, kMostHashedBytes));
  };
  require_bound(file.size());
  Hasher one;
  std::vector<char> piece(std::min(kPieceBytes, std::size_t(file.size()) + 1));
  std::uint64_t done = 0, next_look = kBytesBetweenLooks;
  while (true) {
    const ssize_t n = retried(
        [&] { return ::pread(file.descriptor(), piece.data(), piece.size(), off_t(done)); });
    if (n < 0) throw failure_of(path + ": cannot read", errno, ExitCode::kInput);
    if (n == 0) return one.finish();
    one.take(piece.data(), std::size_t(n));
    done += std::uint64_t(n);
    require_bound(done);  // it may grow meanwhile
    if (done < next_look) continue;
    throw_if_interrupted();
    next_look = done + kBytesBetweenLooks;
  }
}

std::string hex(const Sha256Digest& digest) { return fmt::format("{:02x}", fmt::join(digest, "")); }

bool from_hex(std::string_view text, Sha256Digest& digest) {
  if (text.size() != 2 * digest.size()) return false;
  for (std::size_t i = 0; i < digest.size(); ++i)
    std::from_chars(&text[2 * i], &text[2 * i] + 2, digest[i], 16);
  return hex(digest) == text;
}

}  // namespace lobelia
