#include "core/sha256.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

#include "core/error.hpp"
#include "core/no_resources.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kPieceBytes = 1 << 17;

/// OpenSSL looks its algorithms up by name, which takes longer than hashing a short text: once for each thread.
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
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) fail(errno);
  const std::unique_ptr<const int, void (*)(const int*)> closed(&fd,
                                                                [](const int* f) { ::close(*f); });
  struct stat status {};
  if (::fstat(fd, &status) != 0) fail(errno);
  if (!S_ISREG(status.st_mode))
    throw Error(ExitCode::kInput, fmt::format("{}: not a regular file", path.string()));
  Hasher& one = hasher();
  std::vector<char> piece(kPieceBytes);
  while (true) {
    const ssize_t n = ::read(fd, piece.data(), piece.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    if (n == 0) return one.finish();
    one.take(piece.data(), std::size_t(n));
  }
}

std::string hex(const Sha256Digest& digest) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * digest.size());
  for (const std::uint8_t byte : digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

bool from_hex(std::string_view text, Sha256Digest& digest) {
  if (text.size() != 2 * digest.size()) return false;
  const auto value = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const int high = value(text[2 * i]), low = value(text[2 * i + 1]);
    if (high < 0 || low < 0) return false;
    digest[i] = std::uint8_t(high << 4 | low);
  }
  return true;
}

}  // namespace lobelia
