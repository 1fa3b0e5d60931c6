// Bytes as text, for pictures and values in pages.
#pragma once

#include <string>
#include <string_view>

namespace lobelia {

/// RFC 4648, section 4.
std::string base64(std::string_view bytes);
/// Empty if the text is none.
std::string base64_decoded(std::string_view text);

}  // namespace lobelia
