// A set of comparisons as workflow commands of GitHub Actions, which shows them beside the change.
#include <fmt/format.h>

#include "base/words/text.hpp"
#include "compare/set/report.hpp"

namespace lobelia {
namespace {

/// A command's text, or with `is_property` the value of one of its properties: what ends them is %XX.
std::string escaped(std::string_view text, bool is_property) {
  std::string safe;
  for (const char c : text)
    if (std::string_view(is_property ? "%\r\n:," : "%\r\n").find(c) != std::string_view::npos)
      safe += fmt::format("%{:02X}", int(c));
    else
      safe += c;
  return safe;
}

}  // namespace

std::string set_github(const SetReport& report) {
  std::string text;
  for (const Problem& one : problems(report)) {
    const char* command = one.weight == Problem::Weight::kFails   ? "error"
                          : one.weight == Problem::Weight::kWarns ? "warning"
                                                                  : "notice";
    std::string file;
    if (one.pair) file = "file=" + escaped(printable_path(one.pair->a), true) + ",";
    text += fmt::format("::{} {}title={}::{}\n", command, file,
                        escaped(fmt::format("{}: {}", printable_path(one.name), one.what), true),
                        escaped(printable_path(one.why), false));
  }
  return text;
}

}  // namespace lobelia
