// The types of a record's keys: how a value is written, read again and described.
//
// A record is a plain struct. Its table (struct_type.hpp) has each member's key, meaning and bounds. The writer, the strict
// reader, the JSON Schema, the TypeScript types and the reference pages come from it. docs/decisions/0010 says why.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lobelia::records {

/// Keeps the order of keys, so that people can read a record from the top.
using Json = nlohmann::ordered_json;

/// A JSON object with keys that are data, such as engines, metrics and axes, in order.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

/// The path of a value inside a record, for error messages: "images[2].sha256".
class Place {
 public:
  Place() = default;
  Place(const Place& above, std::string_view key) : above_(&above), key_(key) {}
  Place(const Place& above, std::size_t index) : above_(&above), index_(index) {}
  std::string text() const;
  /// Throws Error(kInput): "images[2].sha256: not a string".
  [[noreturn]] void fail(std::string_view what) const;

 private:
  const Place* above_ = nullptr;
  std::string_view key_ = {};
  std::size_t index_ = 0;
};

/// The value with that name; null if there is none.
template <class T>
const T* find(const Named<T>& values, std::string_view name) {
  for (const auto& [key, value] : values)
    if (key == name) return &value;
  return nullptr;
}

inline constexpr double kNoBound = std::numeric_limits<double>::infinity();
/// Longest text and list, unless the table says otherwise.
inline constexpr std::size_t kMaxText = 1u << 20, kMaxItems = 10'000'000;

/// Limits that a table adds to the C++ type. They apply to the numbers and texts inside lists and objects, but `least_items`
/// and `most_items` to the outermost list or object.
struct Bounds {
  double least = -kNoBound, most = kNoBound;
  bool without_ends = false;                         ///< least and most are not allowed themselves
  bool nonfinite = false;                            ///< "nan", "inf" and "-inf" are allowed
  std::span<const std::string_view> one_of{};        ///< the allowed texts; empty: any
  bool plain_name = false;                           ///< a text must be an is_plain_name()
  std::size_t least_text = 0, most_text = kMaxText;  ///< bytes
  std::size_t least_items = 0, most_items = kMaxItems;
  Bounds of_items() const;  ///< the bounds of each item of a list
};

class Struct;

/// Structs that a schema or a TypeScript file has to define, each after its members' structs.
class Definitions {
 public:
  void add(const Struct& type);
  const std::vector<const Struct*>& all() const { return all_; }

 private:
  std::vector<const Struct*> all_;
};

/// A C++ type. `value` points to a value of it.
class Type {
 public:
  virtual ~Type() = default;
  virtual Json write(const void* value) const = 0;
  /// Throws Error(kInput), naming the place.
  virtual void read(const Json& json, const Bounds& bounds, const Place& place,
                    void* value) const = 0;
  /// Whether it is an optional without a value, or an empty list or text.
  virtual bool is_empty(const void*) const { return false; }
  /// Whether an empty item of a list is written as null.
  virtual bool may_be_null() const { return false; }
  virtual Json schema(const Bounds& bounds) const = 0;
  virtual std::string typescript(const Bounds& bounds) const = 0;
  virtual void define(Definitions&) const {}
};

/// The type of T: bool, integers, double, std::string, std::array, std::vector, Named, std::optional and structs that have a
/// table.
template <class T>
const Type& type_of();
template <class T>
const Struct& struct_type();

namespace detail {

const Type& bool_type();
const Type& string_type();
const Type& double_type();
/// An integer of `size` bytes.
const Type& integer_type(std::size_t size, bool is_signed);

/// A type that contains another one.
class TypeOfItems : public Type {
 public:
  void define(Definitions& definitions) const final { item().define(definitions); }

 protected:
  virtual const Type& item() const = 0;
};

/// Lists and Named objects, independent of the C++ type of their items.
class ListType : public TypeOfItems {
 public:
  Json write(const void* value) const final;
  void read(const Json& json, const Bounds& bounds, const Place& place, void* value) const final;
  bool is_empty(const void* value) const final { return size(value) == 0; }
  Json schema(const Bounds& bounds) const final;
  std::string typescript(const Bounds& bounds) const final;

 protected:
  struct Item {
    const std::string* name;  ///< null in a list
    const void* value;
  };
  virtual bool is_named() const = 0;
  virtual std::size_t fixed_size() const = 0;  ///< 0: any
  virtual std::size_t size(const void* list) const = 0;
  virtual Item at(const void* list, std::size_t index) const = 0;
  virtual void reset(void* list, std::size_t size) const = 0;
};

class OptionalType : public TypeOfItems {
 public:
  Json write(const void* value) const final;
  void read(const Json& json, const Bounds& bounds, const Place& place, void* value) const final;
  bool is_empty(const void* value) const final { return !get(value); }
  bool may_be_null() const final { return true; }
  Json schema(const Bounds& bounds) const final;
  std::string typescript(const Bounds& bounds) const final { return item().typescript(bounds); }

 protected:
  virtual const void* get(const void* optional) const = 0;
  virtual void* emplace(void* optional) const = 0;
};

template <class>
inline constexpr bool kIsNamed = false;
template <class T>
inline constexpr bool kIsNamed<Named<T>> = true;

/// A std::vector, a std::array or a Named.
template <class List>
class ListTypeOf final : public ListType {
  static constexpr bool kHasFixedSize = !requires(List list) { list.clear(); };
  const Type& item() const override {
    if constexpr (kIsNamed<List>)
      return type_of<typename List::value_type::second_type>();
    else
      return type_of<typename List::value_type>();
  }
  bool is_named() const override { return kIsNamed<List>; }
  std::size_t fixed_size() const override { return kHasFixedSize ? List().size() : 0; }
  std::size_t size(const void* list) const override {
    return static_cast<const List*>(list)->size();
  }
  Item at(const void* list, std::size_t index) const override {
    const auto& one = (*static_cast<const List*>(list))[index];
    if constexpr (kIsNamed<List>)
      return {&one.first, &one.second};
    else
      return {nullptr, &one};
  }
  void reset([[maybe_unused]] void* list, [[maybe_unused]] std::size_t size) const override {
    if constexpr (!kHasFixedSize) *static_cast<List*>(list) = List(size);
  }
};

template <class Optional>
class OptionalTypeOf final : public OptionalType {
  const Type& item() const override { return type_of<typename Optional::value_type>(); }
  const void* get(const void* optional) const override {
    const auto& held = *static_cast<const Optional*>(optional);
    return held ? &*held : nullptr;
  }
  void* emplace(void* optional) const override {
    return &static_cast<Optional*>(optional)->emplace();
  }
};

template <class>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <class Made>
const Type& only_one() {
  static const Made made;
  return made;
}

}  // namespace detail

template <class T>
const Type& type_of() {
  if constexpr (std::is_same_v<T, bool>)
    return detail::bool_type();
  else if constexpr (std::is_same_v<T, double>)
    return detail::double_type();
  else if constexpr (std::is_same_v<T, std::string>)
    return detail::string_type();
  else if constexpr (std::is_integral_v<T>)
    return detail::integer_type(sizeof(T), std::is_signed_v<T>);
  else if constexpr (detail::kIsOptional<T>)
    return detail::only_one<detail::OptionalTypeOf<T>>();
  else if constexpr (requires { typename T::value_type; })
    return detail::only_one<detail::ListTypeOf<T>>();
  else
    return struct_type<T>();
}

}  // namespace lobelia::records
