// Names that come from records, as parts of a link.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace lobelia::gallery {

/// A relative link to the file at these plain names: percent-encoded, joined with '/', so that a
/// name such as "a:b" or "50%#1" is neither a scheme nor a fragment.
std::string link_to(std::initializer_list<std::string_view> parts);

}  // namespace lobelia::gallery
