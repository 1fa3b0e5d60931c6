// A set of comparisons as workflow commands of GitHub Actions.
#include <fmt/format.h>

#include "base/words/github.hpp"
#include "compare/set/report.hpp"

namespace lobelia {

std::string set_github(const SetReport& report) {
  std::string text;
  for (const Problem& one : problems(report))
    text += github_line({one.weight == Problem::Weight::kFails   ? "error"
                         : one.weight == Problem::Weight::kWarns ? "warning"
                                                                 : "notice",
                         one.pair ? one.pair->a : "", 0, fmt::format("{}: {}", one.name, one.what),
                         one.why});
  return text;
}

}  // namespace lobelia
