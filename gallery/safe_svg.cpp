#include "gallery/safe_svg.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace lobelia::gallery {
namespace {

constexpr std::array<std::string_view, 12> kElements = {"svg",  "style", "title",    "desc",
                                                        "rect", "line",  "path",     "circle",
                                                        "text", "g",     "clipPath", "tspan"};
constexpr std::array<std::string_view, 34> kAttributes = {"xmlns",
                                                          "class",
                                                          "id",
                                                          "width",
                                                          "height",
                                                          "viewBox",
                                                          "role",
                                                          "x",
                                                          "y",
                                                          "x1",
                                                          "x2",
                                                          "y1",
                                                          "y2",
                                                          "cx",
                                                          "cy",
                                                          "r",
                                                          "d",
                                                          "fill",
                                                          "stroke",
                                                          "transform",
                                                          "text-anchor",
                                                          "clip-path",
                                                          "stroke-width",
                                                          "aria-labelledby",
                                                          "stroke-dasharray",
                                                          "data-key",
                                                          "data-x",
                                                          "data-y",
                                                          "font-size",
                                                          "font-family",
                                                          "fill-opacity",
                                                          "opacity",
                                                          "font-weight",
                                                          "dominant-baseline"};

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == ':'; }

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool tag() {
    take('/');
    const std::string_view element = name();
    if (std::ranges::find(kElements, element) == kElements.end()) return false;
    for (;;) {
      while (!text_.empty() && is_space(text_.front())) text_.remove_prefix(1);
      if (take('>')) return true;
      if (take('/')) return take('>');
      if (!attribute()) return false;
    }
  }
  std::string_view rest() const { return text_; }

 private:
  bool attribute() {
    const std::string_view attribute = name();
    if (std::ranges::find(kAttributes, attribute) == kAttributes.end()) return false;
    if (!take('=') || !take('"')) return false;
    const std::size_t end = text_.find('"');
    if (end == text_.npos) return false;
    const std::string_view value = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    const bool is_address = value.find("url(") != value.npos && !value.starts_with("url(#");
    const bool is_namespace = attribute != "xmlns" || value == "http://www.w3.org/2000/svg";
    return !is_address && is_namespace && value.find('<') == value.npos;
  }
  std::string_view name() {
    const std::size_t length = std::ranges::find_if_not(text_, is_name) - text_.begin();
    const std::string_view name = text_.substr(0, length);
    text_.remove_prefix(length);
    return name;
  }
  bool take(char c) {
    if (text_.empty() || text_.front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }

  std::string_view text_;
};

}  // namespace

bool is_safe_svg(std::string_view file) {
  // A style sheet of a chart has no addresses and no imports.
  for (const std::string_view bad : {"@import", "<!", "expression("})
    if (file.find(bad) != file.npos) return false;
  // Of an apostrophe; others could spell what is looked for here.
  for (std::size_t at = 0; (at = file.find("&#", at)) != file.npos; ++at)
    if (!file.substr(at).starts_with("&#39;")) return false;
  for (std::size_t at = 0; (at = file.find("url(", at)) != file.npos; ++at)
    if (!file.substr(at).starts_with("url(#")) return false;
  if (file.starts_with("<?xml")) file.remove_prefix(std::min(file.find('>'), file.size() - 1) + 1);
  if (file.find("<?") != file.npos) return false;
  bool any = false;
  for (std::size_t at; (at = file.find('<')) != file.npos;) {
    Reader reader(file.substr(at + 1));
    if (!reader.tag()) return false;
    file = reader.rest();
    any = true;
  }
  return any;
}

}  // namespace lobelia::gallery
