#include "compare/set/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"

namespace lobelia {

std::vector<std::vector<std::string>> csv_records(const std::string& file,
                                                  const std::string& text) {
  std::vector<std::vector<std::string>> records;
  std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  while (at < text.size()) {
    std::vector<std::string>& record = records.emplace_back();
    for (bool more = true; more;) {
      std::string field;
      if (at < text.size() && text[at] == '"') {
        for (++at;; ++at) {
          if (at >= text.size())
            throw Error(ExitCode::kInput, "{}: record {}: a quotation mark is not closed", file,
                        records.size());
          if (text[at] == '"' && (++at >= text.size() || text[at] != '"')) break;
          field += text[at];
        }
      } else {
        const std::size_t end = std::min(text.find_first_of(",\r\n", at), text.size());
        field = text.substr(at, end - at);
        at = end;
      }
      record.push_back(field);
      more = at < text.size() && text[at] == ',';
      if (more) ++at;
    }
    if (at < text.size() && text[at] != '\r' && text[at] != '\n')
      throw Error(ExitCode::kInput, "{}: record {}: text after a quotation mark", file,
                  records.size());
    if (at < text.size() && text[at] == '\r') ++at;
    if (at < text.size() && text[at] == '\n') ++at;
    if (record.size() == 1 && record.front().empty()) records.pop_back();
  }
  return records;
}

}  // namespace lobelia
