#include "base/records/type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/records/struct_type.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia::records {
namespace {

/// The names of numbers that are not finite but within the bounds.
Json nonfinite_names(const Bounds& bounds) {
  Json names = {"nan"};
  if (bounds.most == kNoBound) names.push_back("inf");
  if (bounds.least == -kNoBound) names.push_back("-inf");
  return names;
}

std::string allowed_text(const Bounds& bounds) {
  if (bounds.without_ends)
    return fmt::format("over {:g} and below {:g}", bounds.least, bounds.most);
  if (bounds.most == kNoBound) return fmt::format("at least {:g}", bounds.least);
  if (bounds.least == -kNoBound) return fmt::format("at most {:g}", bounds.most);
  return fmt::format("{:g} to {:g}", bounds.least, bounds.most);
}

void require_within(double value, const Bounds& bounds, const Place& place) {
  const bool is_end = bounds.without_ends && (value == bounds.least || value == bounds.most);
  if (!std::isnan(value) && (value < bounds.least || value > bounds.most || is_end))
    place.fail(fmt::format("{:g}; allowed: {}", value, allowed_text(bounds)));
}

void add_bounds(const Bounds& bounds, Json& schema) {
  if (bounds.least != -kNoBound)
    schema[bounds.without_ends ? "exclusiveMinimum" : "minimum"] = bounds.least;
  if (bounds.most != kNoBound)
    schema[bounds.without_ends ? "exclusiveMaximum" : "maximum"] = bounds.most;
}

class BoolType final : public Type {
  Json write(const void* value) const override { return *static_cast<const bool*>(value); }
  void read(const Json& json, const Bounds&, const Place& place, void* value) const override {
    if (!json.is_boolean()) place.fail("not true or false");
    *static_cast<bool*>(value) = json.get<bool>();
  }
  Json schema(const Bounds&) const override { return {{"type", "boolean"}}; }
  std::string typescript(const Bounds&) const override { return "boolean"; }
};

class StringType final : public Type {
  Json write(const void* value) const override {
    return escape_invalid_utf8(*static_cast<const std::string*>(value));
  }
  void read(const Json& json, const Bounds& bounds, const Place& place,
            void* value) const override {
    if (!json.is_string()) place.fail("not a text");
    const auto& text = json.get_ref<const std::string&>();
    if (text.size() < bounds.least_text) place.fail("empty");
    if (text.size() > bounds.most_text)
      place.fail(fmt::format("{} bytes; allowed: at most {}", text.size(), bounds.most_text));
    if (!bounds.one_of.empty() && std::ranges::find(bounds.one_of, text) == bounds.one_of.end())
      place.fail(fmt::format("'{}'; allowed: {}", printable(text), join(bounds.one_of)));
    if (bounds.plain_name && !is_plain_name(text))
      place.fail(fmt::format("'{}' is no plain name of a file", printable(text)));
    *static_cast<std::string*>(value) = text;
  }
  bool is_empty(const void* value) const override {
    return static_cast<const std::string*>(value)->empty();
  }
  Json schema(const Bounds& bounds) const override {
    if (!bounds.one_of.empty()) return {{"enum", bounds.one_of}};
    Json schema{{"type", "string"}};
    if (bounds.plain_name) schema["pattern"] = "^[^./][^/]*$";
    if (bounds.least_text > 0) schema["minLength"] = bounds.least_text;
    if (bounds.most_text != kMaxText) schema["maxLength"] = bounds.most_text;
    return schema;
  }
  std::string typescript(const Bounds& bounds) const override {
    if (bounds.one_of.empty()) return "string";
    std::string text;
    for (const std::string_view one : bounds.one_of)
      text += fmt::format("{}\"{}\"", text.empty() ? "" : " | ", one);
    return text;
  }
};

class DoubleType final : public Type {
  Json write(const void* value) const override {
    const double number = *static_cast<const double*>(value);
    if (std::isfinite(number)) return number;
    return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
  }
  void read(const Json& json, const Bounds& bounds, const Place& place,
            void* value) const override {
    auto& number = *static_cast<double*>(value);
    if (json.is_number()) {
      number = json.get<double>();
      if (!std::isfinite(number)) place.fail("too large for a number");
    } else if (bounds.nonfinite && json == "nan") {
      number = std::numeric_limits<double>::quiet_NaN();
    } else if (bounds.nonfinite && (json == "inf" || json == "-inf")) {
      number = json == "inf" ? kNoBound : -kNoBound;
    } else {
      place.fail(bounds.nonfinite ? R"(not a number, "nan", "inf" or "-inf")" : "not a number");
    }
    require_within(number, bounds, place);
  }
  Json schema(const Bounds& bounds) const override {
    Json number{{"type", "number"}};
    add_bounds(bounds, number);
    if (!bounds.nonfinite) return number;
    return {{"anyOf", Json::array({std::move(number), Json{{"enum", nonfinite_names(bounds)}}})}};
  }
  std::string typescript(const Bounds& bounds) const override {
    return bounds.nonfinite ? "number | \"nan\" | \"inf\" | \"-inf\"" : "number";
  }
};

template <class T>
class IntegerType final : public Type {
  Json write(const void* value) const override { return *static_cast<const T*>(value); }
  void read(const Json& json, const Bounds& bounds, const Place& place,
            void* value) const override {
    // Programs without integers write 3.0.
    const double number = json.is_number() ? json.get<double>() : std::nan("");
    if (!json.is_number() || number != std::floor(number)) place.fail("not an integer");
    const bool fits = json.is_number_unsigned()  ? std::in_range<T>(json.get<std::uint64_t>())
                      : json.is_number_integer() ? std::in_range<T>(json.get<std::int64_t>())
                                                 : number >= double(kLeast) && number < kBeyond;
    if (!fits) place.fail(fmt::format("{:g} is out of range", number));
    require_within(number, bounds, place);
    *static_cast<T*>(value) = json.is_number_unsigned()  ? T(json.get<std::uint64_t>())
                              : json.is_number_integer() ? T(json.get<std::int64_t>())
                                                         : T(number);
  }
  Json schema(const Bounds& bounds) const override {
    Json schema{{"type", "integer"}};
    Bounds own = bounds;
    if (!std::is_signed_v<T>) own.least = std::max(own.least, 0.0);
    add_bounds(own, schema);
    return schema;
  }
  std::string typescript(const Bounds&) const override { return "number"; }

  static constexpr T kLeast = std::numeric_limits<T>::min();
  static constexpr double kBeyond = 2.0 * double(std::numeric_limits<T>::max() / 2 + 1);
};

/// An empty item of a list is null. (An empty key may be left out.)
std::string null_text(const Type& item) { return item.may_be_null() ? " | null" : ""; }

void require_items(std::size_t size, std::size_t fixed, const Bounds& bounds, const Place& place) {
  if (fixed > 0 && size != fixed) place.fail(fmt::format("{} items; allowed: {}", size, fixed));
  if (size < bounds.least_items || size > bounds.most_items)
    place.fail(
        fmt::format("{} items; allowed: {} to {}", size, bounds.least_items, bounds.most_items));
}

}  // namespace

std::string Place::text() const {
  if (!above_) return "";
  const std::string above = above_->text();
  if (key_.data() == nullptr) return fmt::format("{}[{}]", above, index_);
  return above + (above.empty() ? "" : ".") + printable(key_);
}

void Place::fail(std::string_view what) const {
  const std::string place = text();
  throw Error(ExitCode::kInput,
              place.empty() ? std::string(what) : place + ": " + std::string(what));
}

Bounds Bounds::of_items() const {
  Bounds inner = *this;
  inner.least_items = 0;
  inner.most_items = kMaxItems;
  return inner;
}

void Definitions::add(const Struct& type) {
  if (std::ranges::find(all_, &type) != all_.end()) return;
  for (const Field& field : type.fields()) field.type->define(*this);
  all_.push_back(&type);
}

namespace detail {

const Type& bool_type() { return only_one<BoolType>(); }
const Type& string_type() { return only_one<StringType>(); }
const Type& double_type() { return only_one<DoubleType>(); }
const Type& integer_type(std::size_t size, bool is_signed) {
  if (size == 1) return only_one<IntegerType<std::uint8_t>>();
  if (size == 4)
    return is_signed ? only_one<IntegerType<std::int32_t>>()
                     : only_one<IntegerType<std::uint32_t>>();
  return is_signed ? only_one<IntegerType<std::int64_t>>() : only_one<IntegerType<std::uint64_t>>();
}

Json ListType::write(const void* value) const {
  Json list = is_named() ? Json::object() : Json::array();
  for (std::size_t i = 0; i < size(value); ++i) {
    const Item one = at(value, i);
    if (one.name)
      list[escape_invalid_utf8(*one.name)] = item().write(one.value);
    else
      list.push_back(item().write(one.value));
  }
  return list;
}

void ListType::read(const Json& json, const Bounds& bounds, const Place& place, void* value) const {
  if (is_named() && !json.is_object()) place.fail("not an object");
  if (!is_named() && !json.is_array()) place.fail("not a list");
  require_items(json.size(), fixed_size(), bounds, place);
  const Bounds inner = bounds.of_items();
  reset(value, json.size());
  std::size_t i = 0;
  for (auto one = json.begin(); one != json.end(); ++one, ++i) {
    // at() returns const pointers, but this list is ours to fill.
    const auto [name, into] = at(value, i);
    if (name) *const_cast<std::string*>(name) = one.key();
    item().read(*one, inner, name ? Place(place, *name) : Place(place, i), const_cast<void*>(into));
  }
}

Json ListType::schema(const Bounds& bounds) const {
  const std::size_t least = std::max(fixed_size(), bounds.least_items);
  const std::size_t most = fixed_size() > 0 ? fixed_size() : bounds.most_items;
  Json schema{{"type", is_named() ? "object" : "array"},
              {is_named() ? "additionalProperties" : "items", item().schema(bounds.of_items())}};
  if (least > 0) schema[is_named() ? "minProperties" : "minItems"] = least;
  if (most != kMaxItems) schema[is_named() ? "maxProperties" : "maxItems"] = most;
  return schema;
}

std::string ListType::typescript(const Bounds& bounds) const {
  const std::string plain = item().typescript(bounds.of_items());
  if (is_named()) return fmt::format("Record<string, {}>", plain);
  const std::string one = plain + null_text(item());
  if (fixed_size() > 0 && fixed_size() < 5) {
    const std::vector<std::string> all(fixed_size(), one);
    return fmt::format("[{}]", fmt::join(all, ", "));
  }
  return one.find(' ') == one.npos ? one + "[]" : fmt::format("({})[]", one);
}

Json OptionalType::write(const void* value) const {
  const void* held = get(value);
  return held ? item().write(held) : Json(nullptr);
}

void OptionalType::read(const Json& json, const Bounds& bounds, const Place& place,
                        void* value) const {
  item().read(json, bounds, place, emplace(value));
}

Json OptionalType::schema(const Bounds& bounds) const { return item().schema(bounds); }

}  // namespace detail
}  // namespace lobelia::records
