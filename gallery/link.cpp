#include "gallery/link.hpp"

#include <fmt/format.h>

namespace lobelia::gallery {
namespace {

bool is_unreserved(unsigned char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.' || c == '~';
}

}  // namespace

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
