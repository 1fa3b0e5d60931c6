// An XML file with the positions of its contents, and the errors found so far.
#pragma once

#include <pugixml.hpp>
#include <span>
#include <string>
#include <vector>

namespace lobelia {

class XmlSource {
 public:
  /// Parses the text. Throws Error(kInput) for a syntax error, an oversized file, or a DOCTYPE: no entities, nothing
  /// external.
  XmlSource(std::string text, std::string file_name, std::size_t max_bytes);
  XmlSource(const XmlSource&) = delete;
  XmlSource& operator=(const XmlSource&) = delete;

  pugi::xml_node root() const { return document_.document_element(); }

  /// Notes "file:line:column: message".
  void error(pugi::xml_node where, const std::string& message);
  void error(pugi::xml_attribute where, pugi::xml_node of, const std::string& message);
  /// Whether further errors are only counted, so that a search for suggestions is not worth while.
  bool full() const;
  /// Counts an error without a message.
  void count_error() { ++error_count_; }
  bool has_errors() const { return !errors_.empty(); }
  std::size_t error_count() const { return error_count_; }
  /// The errors, one a line in the file's order.
  std::vector<std::string> error_lines() const;
  /// Throws Error(kInput) with error_lines(), if there are any.
  void throw_if_errors() const;

  /// Notes an error for each attribute of `node` that is not one of `allowed`. The root may name its schema.
  void check_attributes(pugi::xml_node node, std::initializer_list<std::string_view> allowed);
  void check_attributes(pugi::xml_node node, std::span<const std::string_view> allowed);
  /// The attribute's value. Notes an error and returns "" if it is missing.
  std::string required(pugi::xml_node node, const char* attribute);

 private:
  std::string place(std::ptrdiff_t offset) const;
  void note(std::ptrdiff_t offset, const std::string& message);

  std::string original_, parsed_;  ///< the parser overwrites parsed_ but keeps its offsets
  std::string file_name_;
  pugi::xml_document document_;
  std::vector<std::pair<std::ptrdiff_t, std::string>> errors_;  ///< with their places
  std::size_t error_count_ = 0;
};

}  // namespace lobelia
