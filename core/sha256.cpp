#include "core/sha256.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nettle/sha2.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "core/descriptor.hpp"
#include "core/error.hpp"
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
  const auto fail = [&](int error) {
    throw failure_of(path.string() + ": cannot read", error, ExitCode::kInput);
  };
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0) fail(errno);
  if (!S_ISREG(status.st_mode))
    throw Error(ExitCode::kInput, fmt::format("{}: not a regular file", path.string()));
  Hasher one;
  std::vector<char> piece(std::min(kPieceBytes, std::size_t(status.st_size) + 1));
  while (true) {
    const ssize_t n = retried([&] { return ::read(file.get(), piece.data(), piece.size()); });
    if (n < 0) fail(errno);
    if (n == 0) return one.finish();
    one.take(piece.data(), std::size_t(n));
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
