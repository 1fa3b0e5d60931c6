#include "core/html.hpp"

#include <algorithm>
#include <array>

#include "core/text.hpp"

namespace lobelia {
namespace {

// Elements that are part of a line; all others end one, so that the source of a page can be read.
constexpr std::array<std::string_view, 11> kInline = {
    "a", "abbr", "b", "code", "em", "small", "span", "strong", "sub", "sup", "pre"};

bool is_inline(std::string_view tag) { return std::ranges::count(kInline, tag) > 0; }

void write_start(std::string& out, std::string_view tag, const Attributes& attributes) {
  out += '<';
  out += tag;
  for (const Attribute& attribute : attributes) {
    out += ' ';
    out += attribute.name;
    out += "=\"";
    out += escape_markup(attribute.value);
    out += '"';
  }
}

}  // namespace

void Html::text(std::string_view text) { out_ += escape_markup(text); }

void Html::open(std::string_view tag, const Attributes& attributes) {
  write_start(out_, tag, attributes);
  out_ += '>';
}

void Html::close(std::string_view tag) {
  out_ += "</";
  out_ += tag;
  out_ += '>';
  if (!is_inline(tag)) out_ += '\n';
}

void Html::empty(std::string_view tag, const Attributes& attributes) {
  write_start(out_, tag, attributes);
  out_ += " />";
}

void Html::element(std::string_view tag, const Attributes& attributes, std::string_view content) {
  open(tag, attributes);
  text(content);
  close(tag);
}

}  // namespace lobelia
