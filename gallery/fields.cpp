#include "gallery/fields.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/error.hpp"
#include "core/numbers.hpp"
#include "core/text.hpp"
#include "gallery/names.hpp"

namespace lobelia::gallery {
namespace {

std::optional<double> as_number(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (!value.is_string()) return std::nullopt;
  const auto& name = value.get_ref<const std::string&>();
  if (name == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (name == "inf") return std::numeric_limits<double>::infinity();
  if (name == "-inf") return -std::numeric_limits<double>::infinity();
  return std::nullopt;
}

std::string describe(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return count_text(value.get<double>());
  if (value.is_number()) return number_text(value.get<double>(), 6);
  std::string words;
  // One level is enough for every record that we write; what lies deeper is left out.
  for (const auto& [key, member] : value.items()) {
    if (member.is_structured()) continue;
    if (!words.empty()) words += ", ";
    if (value.is_object()) words += key + " ";
    words += describe(member);
  }
  return words;
}

std::optional<std::vector<double>> all_numbers(const Json& value) {
  if (!value.is_array()) return std::nullopt;
  std::vector<double> result;
  result.reserve(value.size());
  for (const Json& item : value) {
    const auto number = as_number(item);
    if (!number) return std::nullopt;
    result.push_back(*number);
  }
  return result;
}

}  // namespace

Fields::Fields(const Json& json, std::string file, std::string path)
    : json_(&json), file_(std::move(file)), path_(std::move(path)) {
  if (!json.is_object()) {
    throw Error(ExitCode::kInput, fmt::format("{}: {} must be an object", file_,
                                              path_.empty() ? "the record" : "'" + path_ + "'"));
  }
}

const Json* Fields::find(const std::string& key) const {
  const auto at = json_->find(key);
  return at == json_->end() || at->is_null() ? nullptr : &*at;
}

std::string Fields::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

void Fields::fail(const std::string& key, const std::string& problem) const {
  throw Error(ExitCode::kInput, fmt::format("{}: '{}' {}", file_, path_of(key), problem));
}

std::string Fields::text(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return "";
  if (!value->is_string()) fail(key, "must be a string");
  return value->get<std::string>();
}

std::optional<double> Fields::number(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  const auto result = as_number(*value);
  if (!result) fail(key, "must be a number");
  return result;
}

bool Fields::flag(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return false;
  if (!value->is_boolean()) fail(key, "must be true or false");
  return value->get<bool>();
}

std::string Fields::plain_name(const std::string& key) const {
  std::string name = text(key);
  if (!name.empty() && !is_plain_name(name)) {
    fail(key, "must be a plain file name, not '" + printable(name) + "'");
  }
  return name;
}

std::vector<std::string> Fields::texts(const std::string& key) const {
  const Json* value = find(key);
  std::vector<std::string> result;
  if (!value) return result;
  if (!value->is_array()) fail(key, "must be an array of strings");
  for (const Json& item : *value) {
    if (!item.is_string()) fail(key, "must be an array of strings");
    result.push_back(item.get<std::string>());
  }
  return result;
}

std::vector<double> Fields::numbers(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return {};
  auto result = all_numbers(*value);
  if (!result) fail(key, "must be an array of numbers");
  return *std::move(result);
}

std::vector<std::vector<double>> Fields::rows(const std::string& key) const {
  const Json* value = find(key);
  std::vector<std::vector<double>> result;
  if (!value) return result;
  if (!value->is_array()) fail(key, "must be an array of arrays of numbers");
  for (const Json& row : *value) {
    auto numbers = all_numbers(row);
    if (!numbers) fail(key, "must be an array of arrays of numbers");
    result.push_back(*std::move(numbers));
  }
  return result;
}

std::optional<Fields> Fields::object(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  return Fields(*value, file_, path_of(key));
}

std::vector<Fields> Fields::objects(const std::string& key) const {
  const Json* value = find(key);
  std::vector<Fields> result;
  if (!value) return result;
  if (!value->is_array()) fail(key, "must be an array of objects");
  for (std::size_t i = 0; i < value->size(); ++i) {
    result.emplace_back((*value)[i], file_, fmt::format("{}[{}]", path_of(key), i));
  }
  return result;
}

std::vector<std::pair<std::string, Fields>> Fields::object_members() const {
  std::vector<std::pair<std::string, Fields>> result;
  for (const auto& [key, value] : json_->items()) {
    if (value.is_object()) result.emplace_back(key, Fields(value, file_, path_of(key)));
  }
  return result;
}

std::vector<std::pair<std::string, std::vector<double>>> Fields::number_arrays() const {
  std::vector<std::pair<std::string, std::vector<double>>> result;
  for (const auto& [key, value] : json_->items()) {
    if (value.is_array()) result.emplace_back(key, numbers(key));
  }
  return result;
}

NamedNumbers Fields::number_members() const {
  NamedNumbers result;
  for (const auto& [key, value] : json_->items()) {
    if (const auto number = as_number(value)) result.emplace_back(key, *number);
  }
  return result;
}

NamedTexts Fields::described_members() const {
  NamedTexts result;
  for (const auto& [key, value] : json_->items()) {
    if (!value.is_null()) result.emplace_back(key, describe(value));
  }
  return result;
}

std::string Fields::described(const std::string& key) const {
  const Json* value = find(key);
  return value ? describe(*value) : "";
}

}  // namespace lobelia::gallery
