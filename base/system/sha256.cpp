#include "base/system/sha256.hpp"

#include <fmt/format.h>
#include <nettle/sha2.h>

#include <charconv>

#include "base/system/error.hpp"
#include "base/system/files.hpp"

namespace lobelia {
namespace {

class Hasher {
 public:
  Hasher() { sha256_init(&context_); }
  void take(std::string_view bytes) {
    sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
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
  one.take(bytes);
  return one.finish();
}

Sha256Digest sha256_of_file(const std::filesystem::path& path) {
  return sha256_of_file(InputFile(path));
}

Sha256Digest sha256_of_file(const InputFile& file) { return sha256_of_file(file, kAnyTime); }

Sha256Digest sha256_of_file(const InputFile& file, std::chrono::duration<double> time_limit) {
  using Clock = std::chrono::steady_clock;
  Hasher one;
  read_pieces(file, kMostHashedBytes, [&, begun = Clock::now()](std::string_view piece) {
    if (Clock::now() - begun > time_limit)
      throw Error(ExitCode::kInput, "{}: {} bytes, which were not read within {:g} s",
                  file.path().string(), file.size(), time_limit.count());
    one.take(piece);
  });
  return one.finish();
}

std::string hex(const Sha256Digest& digest) { return fmt::format("{:02x}", fmt::join(digest, "")); }

bool from_hex(std::string_view text, Sha256Digest& digest) {
  if (text.size() != 2 * digest.size()) return false;
  for (std::size_t i = 0; i < digest.size(); ++i)
    std::from_chars(&text[2 * i], &text[2 * i] + 2, digest[i], 16);
  return hex(digest) == text;
}

}  // namespace lobelia
