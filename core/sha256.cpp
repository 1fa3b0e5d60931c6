#include "core/sha256.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>

#include <charconv>
#include <memory>
#include <vector>

#include "core/descriptor.hpp"
#include "core/error.hpp"
#include "core/no_resources.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kPieceBytes = 1 << 17;

/// One for each thread, because OpenSSL looks up an algorithm by its name, which takes longer than hashing a short text.
class Hasher {
 public:
  Hasher() : context_(::EVP_MD_CTX_new(), ::EVP_MD_CTX_free) {
    check(context_ != nullptr && ::EVP_DigestInit_ex(context_.get(), ::EVP_sha256(), nullptr) == 1);
  }
  void start() { check(::EVP_DigestInit_ex(context_.get(), nullptr, nullptr) == 1); }
  void take(const void* bytes, std::size_t count) {
    check(::EVP_DigestUpdate(context_.get(), bytes, count) == 1);
  }
  Sha256Digest finish() {
    Sha256Digest digest{};
    check(::EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1);
    return digest;
  }

 private:
  static void check(bool good) {
    if (!good) throw Error(ExitCode::kInternal, "OpenSSL has no SHA-256");
  }
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

Hasher& hasher() {
  thread_local Hasher one;
  one.start();
  return one;
}

}  // namespace

Sha256Digest sha256(std::string_view bytes) {
  Hasher& one = hasher();
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
  Hasher& one = hasher();
  std::vector<char> piece(kPieceBytes);
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
