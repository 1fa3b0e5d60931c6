// A shader's text in parts: what several highlights need stands in it once, and two exports can be used
// together.
#pragma once

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace lobelia {

/// `text` with each "%name%" replaced.
std::string fill(std::string_view text,
                 std::initializer_list<std::pair<std::string_view, std::string_view>> values);

class Parts {
 public:
  /// How the language skips what it has read before; "%name%" is the part's name.
  Parts(std::string_view begin, std::string_view end) : begin_(begin), end_(end) {}

  /// Appends the part unless it is there already.
  void add(const std::string& name, std::string_view text);
  const std::string& text() const { return text_; }

 private:
  std::string begin_, end_, text_;
  std::set<std::string> names_;
};

}  // namespace lobelia
