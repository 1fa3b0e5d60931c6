// A set of comparisons as Markdown, for a pull request or a job's summary.
#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"
#include "compare/set/report.hpp"

namespace lobelia {
namespace {

/// Text that Markdown and the HTML in it leave as it is, in a cell of a table. An @ calls nobody.
std::string plain(std::string_view text) {
  constexpr std::string_view kSpecial = "\\`*_[]<>&#|~", kNothing = "\u200b";
  std::string safe;
  for (const char c : printable_path(text)) {
    if (kSpecial.find(c) != std::string_view::npos) safe += '\\';
    safe += c;
    if (c == '@') safe += kNothing;
  }
  return safe;
}

}  // namespace

std::string set_markdown(const SetReport& report) {
  // A comment on GitHub holds 65 536 characters.
  constexpr std::size_t kMostRows = 100, kMostBytes = 40'000;
  std::string text = fmt::format("### {} against {}\n\n{}\n", plain(report.a), plain(report.b),
                                 counts_text(report));
  const std::vector<Problem> all = problems(report);
  if (all.empty()) return text;
  text += "\n| | picture | why | highlight |\n|---|---|---|---|\n";
  std::size_t rows = 0;
  for (; rows < std::min(all.size(), kMostRows) && text.size() < kMostBytes; ++rows) {
    const Problem& one = all[rows];
    text += fmt::format("| {} | {} | {} | {} |\n", one.what, plain(one.name), plain(one.why),
                        one.pair ? plain(highlight_sentence(*one.pair->comparison)) : "");
  }
  if (rows < all.size()) text += fmt::format("\n... and {} more\n", all.size() - rows);
  return text;
}

}  // namespace lobelia
