// Reading a record that anybody may have written: every key is checked for its type before use.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/record.hpp"

namespace lobelia::gallery {

using NamedNumbers = std::vector<std::pair<std::string, double>>;
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// One object of a record. A key that is not there gives an empty result; one of another type, or a
/// file name that is not a plain name, throws Error(kInput) that names file and key.
/// The Json must outlive this object.
class Fields {
 public:
  Fields(const Json& json, std::string file, std::string path = "");

  std::string text(const std::string& key) const;
  std::optional<double> number(const std::string& key) const;  ///< "nan", "inf" and "-inf" too
  bool flag(const std::string& key) const;
  std::string plain_name(const std::string& key) const;
  std::vector<std::string> texts(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;
  std::vector<std::vector<double>> rows(
      const std::string& key) const;  ///< an array of arrays of numbers
  std::optional<Fields> object(const std::string& key) const;
  std::vector<Fields> objects(const std::string& key) const;

  /// All members that are objects, with their names.
  std::vector<std::pair<std::string, Fields>> object_members() const;
  /// The array of numbers of every member that is one, with its name.
  std::vector<std::pair<std::string, std::vector<double>>> number_arrays() const;
  /// All members that are numbers.
  NamedNumbers number_members() const;
  /// All members in words, whatever their type: for facts that are printed and not understood.
  NamedTexts described_members() const;
  /// One member in words, empty if it is not there.
  std::string described(const std::string& key) const;

  const std::string& file() const { return file_; }
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

 private:
  const Json* find(const std::string& key) const;
  std::string path_of(const std::string& key) const;

  const Json* json_;
  std::string file_;  ///< relative to the farm's directory
  std::string path_;  ///< of this object inside the file: "images[0]"
};

}  // namespace lobelia::gallery
