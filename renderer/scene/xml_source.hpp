// An XML file with the place of everything in it, and the errors found so far.
#pragma once

#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

class XmlSource {
 public:
  /// Parses at once; a syntax error, a DOCTYPE (no entities, no external anything) or an oversized
  /// file is Error(kInput).
  XmlSource(std::string text, std::string file_name, std::size_t max_bytes);
  XmlSource(const XmlSource&) = delete;
  XmlSource& operator=(const XmlSource&) = delete;

  pugi::xml_node root() const { return document_.document_element(); }

  /// Notes "file:line:column: message".
  void error(pugi::xml_node where, const std::string& message);
  void error(pugi::xml_attribute where, pugi::xml_node of, const std::string& message);
  /// So many errors that further ones are only counted: not worth a long search for suggestions.
  bool full() const;
  /// Counts an error that is not worth a message, because there are enough.
  void count_error() { ++error_count_; }
  bool has_errors() const { return !errors_.empty(); }
  /// Throws Error(kInput) with the errors noted, one a line in the file's order, if there is any.
  void throw_if_errors() const;

  /// Notes an error for each attribute of `node` that is not one of `allowed`.
  void check_attributes(pugi::xml_node node, std::initializer_list<std::string_view> allowed);
  void check_attributes(pugi::xml_node node, std::span<const std::string_view> allowed);
  /// The attribute's value; notes an error and returns "" if it is missing.
  std::string required(pugi::xml_node node, const char* attribute);

 private:
  std::string place(std::ptrdiff_t offset) const;
  void note(std::ptrdiff_t offset, const std::string& message);

  std::string original_, parsed_;  ///< parsed_ is overwritten by the parser, its offsets stay
  std::string file_name_;
  pugi::xml_document document_;
  std::vector<std::pair<std::ptrdiff_t, std::string>> errors_;  ///< with their places
  std::size_t error_count_ = 0;
};

}  // namespace lobelia
