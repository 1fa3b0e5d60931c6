#include "base/records/words.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "base/words/constants.hpp"
#include "base/words/numbers.hpp"

namespace lobelia::records {
namespace {

std::string words(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return count_text(value.get<double>());
  if (value.is_number()) return number_text(value.get<double>(), 6);
  std::string all;
  // No record needs a deeper level.
  for (const auto& [key, member] : value.items())
    if (!member.is_structured()) all += (all.empty() ? "" : ", ") + key + " " + words(member);
  return all;
}

}  // namespace

namespace detail {

Named<std::string> words_of(const Struct& type, const void* part) {
  Named<std::string> result;
  const Json json = type.write(part);
  for (const auto& [key, value] : json.items()) result.emplace_back(key, words(value));
  return result;
}

std::string in_words(const Struct& type, const void* part) { return words(type.write(part)); }

Named<double> numbers_of(const Struct& type, const void* part) {
  Named<double> result;
  const Json json = type.write(part);
  for (const auto& [key, value] : json.items()) {
    if (value.is_number()) result.emplace_back(key, value.get<double>());
    if (value == "nan") result.emplace_back(key, std::numeric_limits<double>::quiet_NaN());
    if (value == "inf" || value == "-inf")
      result.emplace_back(key, value == "inf" ? kInfinity : -kInfinity);
  }
  return result;
}

}  // namespace detail
}  // namespace lobelia::records
