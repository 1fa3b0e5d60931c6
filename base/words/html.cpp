#include "base/words/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"

namespace lobelia {
namespace {

// Other elements end a line, so that the source of a page is readable.
constexpr std::string_view kInline[] = {"a",    "abbr",   "b",   "code", "em", "small",
                                        "span", "strong", "sub", "sup",  "pre"};

std::string start_of(std::string_view tag, const Attributes& attributes) {
  std::string text = fmt::format("<{}", tag);
  for (const Attribute& attribute : attributes)
    text += fmt::format(" {}=\"{}\"", attribute.name, escape_markup(attribute.value));
  return text;
}

}  // namespace

void Html::text(std::string_view text) { out_ += escape_markup(text); }

void Html::open(std::string_view tag, const Attributes& attributes) {
  out_ += start_of(tag, attributes) + ">";
}

void Html::close(std::string_view tag) {
  out_ += fmt::format("</{}>{}", tag, std::ranges::count(kInline, tag) > 0 ? "" : "\n");
}

void Html::empty(std::string_view tag, const Attributes& attributes) {
  out_ += start_of(tag, attributes) + " />";
}

void Html::element(std::string_view tag, const Attributes& attributes, std::string_view content) {
  open(tag, attributes);
  text(content);
  close(tag);
}

}  // namespace lobelia
