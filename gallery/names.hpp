// Names that come from records, before they become part of a path or a link.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace lobelia::gallery {

/// True for the name of one file or directory: not empty, not hidden ('.' in front), no separator,
/// no control character, at most 200 bytes. Everything else could lead out of the farm's directory.
bool is_plain_name(std::string_view name);

/// A relative link to the file at these plain names: percent-encoded, joined with '/', so that a
/// name such as "a:b" or "50%#1" is neither a scheme nor a fragment.
std::string link_to(std::initializer_list<std::string_view> parts);

}  // namespace lobelia::gallery
