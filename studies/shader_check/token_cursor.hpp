// A place among a shader's tokens, from which a parser of declarations reads on.
#pragma once

#include <algorithm>

#include "studies/shader_check/declarations.hpp"

namespace lobelia {

/// A text may end anywhere, so a place may lie behind the last token.
class TokenCursor {
 protected:
  TokenCursor(const TokenList& list, std::string_view plain) : list_(list), plain_(plain) {}

  /// Calls one() until the text ends, and moves on where it did not.
  template <class One>
  void read_all(const One& one) {
    while (at_ < list_.size()) {
      const std::size_t before = at_;
      one();
      if (at_ <= before) at_ = before + 1;
    }
  }

  std::string_view word(std::size_t i) const {
    return i < list_.size() ? list_.tokens[i].text : std::string_view();
  }
  bool is(std::size_t i, std::string_view text) const { return list_.is(i, text); }
  /// Behind the bracket that opens at `i`.
  std::size_t behind(std::size_t i) const {
    return i < list_.size() ? std::min(list_.partner[i] + 1, list_.size()) : list_.size();
  }
  std::string text_of(std::size_t begin, std::size_t end) const {
    end = std::min(end, list_.size());
    if (begin >= end) return "";
    const std::size_t from = list_.tokens[begin].at;
    return std::string(plain_.substr(from, list_.tokens[end - 1].end() - from));
  }
  void replace(std::size_t begin, std::size_t end, std::string text = {}) {
    end = std::min(end, list_.size());
    if (begin < end)
      found_.edits.push_back(
          {list_.tokens[begin].at, list_.tokens[end - 1].end(), std::move(text)});
  }

  const TokenList& list_;
  std::string_view plain_;
  std::size_t at_ = 0;
  Declarations found_;
};

}  // namespace lobelia
