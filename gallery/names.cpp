#include "gallery/names.hpp"

#include <fmt/format.h>

namespace lobelia::gallery {
namespace {

bool is_unreserved(unsigned char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.' || c == '~';
}

}  // namespace

bool is_plain_name(std::string_view name) {
  if (name.empty() || name.size() > 200 || name.front() == '.') return false;
  for (const char c : name) {
    // Browsers read a backslash as a slash.
    if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return false;
  }
  return true;
}

std::string link_to(std::initializer_list<std::string_view> parts) {
  std::string link;
  for (const std::string_view part : parts) {
    if (!link.empty()) link += '/';
    for (const char c : part) {
      const auto byte = static_cast<unsigned char>(c);
      if (is_unreserved(byte)) {
        link += c;
      } else {
        link += fmt::format("%{:02X}", byte);
      }
    }
  }
  return link;
}

}  // namespace lobelia::gallery
