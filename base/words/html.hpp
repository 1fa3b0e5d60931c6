// Writes markup that cannot be malformed: tags close themselves, text and attributes are escaped. The result is HTML and
// well-formed XML, so that any XML reader can check it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

struct Attribute {
  std::string_view name;  ///< written as it is: never from a record
  std::string value;      ///< escaped when written
};
using Attributes = std::vector<Attribute>;

class Html {
 public:
  void text(std::string_view text);
  /// Writes markup of another Html object without escaping it.
  void raw(std::string_view markup) { out_ += markup; }
  /// An element without content: <img ... />.
  void empty(std::string_view tag, const Attributes& attributes = {});
  /// An element with nothing but text.
  void element(std::string_view tag, const Attributes& attributes, std::string_view text);
  void element(std::string_view tag, std::string_view text) { element(tag, {}, text); }
  const std::string& str() const { return out_; }

 private:
  friend class Tag;
  void open(std::string_view tag, const Attributes& attributes);
  void close(std::string_view tag);

  std::string out_;
};

/// An element that lasts as long as this object.
class Tag {
 public:
  Tag(Html& html, std::string_view tag, const Attributes& attributes = {})
      : html_(html), tag_(tag) {
    html_.open(tag_, attributes);
  }
  ~Tag() { html_.close(tag_); }
  Tag(const Tag&) = delete;
  Tag& operator=(const Tag&) = delete;

 private:
  Html& html_;
  std::string_view tag_;
};

}  // namespace lobelia
