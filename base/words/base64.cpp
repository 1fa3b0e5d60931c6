#include "base/words/base64.hpp"

#include <nettle/base64.h>

namespace lobelia {

std::string base64(std::string_view bytes) {
  std::string text(BASE64_ENCODE_RAW_LENGTH(bytes.size()), '\0');
  base64_encode_raw(text.data(), bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  return text;
}

std::string base64_decoded(std::string_view text) {
  base64_decode_ctx context;
  base64_decode_init(&context);
  std::string bytes(BASE64_DECODE_LENGTH(text.size()), '\0');
  std::size_t size = bytes.size();
  const bool is_base64 = base64_decode_update(
      &context, &size, reinterpret_cast<std::uint8_t*>(bytes.data()), text.size(), text.data());
  bytes.resize(is_base64 ? size : 0);
  return bytes;
}

}  // namespace lobelia
