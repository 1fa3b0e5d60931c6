// The table of a record's struct: key, member, meaning, unit, bounds.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "records/type.hpp"

namespace lobelia::records {

/// When a key is there.
enum class Presence : std::uint8_t {
  kAlways,
  kIfAny,   ///< missing where the member is empty: an optional, a list, a text
  kOrNull,  ///< null where the member is empty
};

/// A key of a struct's table.
struct Field {
  std::string_view key;  ///< empty: of all keys that the others do not name
  std::string_view
      meaning;  ///< one sentence for the reference page; empty where the key says it all
  const Type* type = nullptr;
  void* (*member)(void* record) = nullptr;
  std::string_view unit_name = {};  ///< "seconds", "bytes"; empty for none
  Presence presence = Presence::kAlways;
  Bounds bounds = {};

  bool is_rest() const { return key.empty(); }
  bool is_required() const { return presence != Presence::kIfAny && !is_rest(); }

  Field& unit(std::string_view name) { return unit_name = name, *this; }
  Field& at_least(double least) { return bounds.least = least, *this; }
  Field& at_most(double most) { return bounds.most = most, *this; }
  Field& within(double least, double most) { return at_least(least).at_most(most); }
  /// Neither `least` nor `most` itself.
  Field& between(double least, double most) {
    return bounds.without_ends = true, within(least, most);
  }
  /// A number that is not finite is allowed, and is the text "nan", "inf" or "-inf".
  Field& may_be_nonfinite() { return bounds.nonfinite = true, *this; }
  Field& one_of(std::span<const std::string_view> texts) { return bounds.one_of = texts, *this; }
  /// A file beside the record: see is_plain_name().
  Field& plain_name() { return bounds.plain_name = true, *this; }
  Field& not_empty() { return bounds.least_text = 1, *this; }
  Field& most_text(std::size_t bytes) { return bounds.most_text = bytes, *this; }
  Field& items(std::size_t least, std::size_t most = kMaxItems) {
    bounds.least_items = least, bounds.most_items = most;
    return *this;
  }
  /// Missing where it is empty, as an optional is without more words.
  Field& if_any() { return presence = Presence::kIfAny, *this; }
  /// null where it is empty.
  Field& or_null() { return presence = Presence::kOrNull, *this; }
};

enum class Seal : bool { kNo, kYes };

/// A struct's table: what define() fills.
class Struct final : public Type {
 public:
  /// `name` is that of the TypeScript interface and of the schema's definition.
  Struct(std::string_view name, std::string_view meaning, void (*fill)(Struct&))
      : name_(name), meaning_(meaning) {
    fill(*this);
  }

  template <auto kMember>
  Field& key(std::string_view key, std::string_view meaning = "") {
    using Of = OfMember<decltype(kMember)>;
    fields_.push_back({key, meaning, &type_of<typename Of::Value>(), [](void* record) -> void* {
                         return &(static_cast<typename Of::Record*>(record)->*kMember);
                       }});
    return detail::kIsOptional<typename Of::Value> ? fields_.back().if_any() : fields_.back();
  }
  /// A Named member for all keys that the table does not have, which are data; follows the others.
  template <auto kMember>
  Field& rest(std::string_view meaning = "") {
    return key<kMember>("", meaning);
  }
  /// It is a record by itself, with kind and version in front, and a `seal` at the end if it has one.
  void kind(std::string_view kind, Seal seal = Seal::kNo) {
    kind_ = kind;
    is_sealed_ = seal == Seal::kYes;
  }
  /// All keys of one of these lists are there, whatever else is.
  void needs(std::vector<std::vector<std::string_view>> lists) { needs_ = std::move(lists); }
  /// Finds what contradicts itself where every key is right by itself: a sentence; empty if nothing does.
  template <auto kCheck>
  void check() {
    contradiction_ = [](const void* record) {
      return kCheck(*static_cast<const typename OfCheck<decltype(kCheck)>::type*>(record));
    };
  }

  std::string_view name() const { return name_; }
  std::string_view meaning() const { return meaning_; }
  std::string_view kind() const { return kind_; }  ///< empty of a part of records
  bool is_sealed() const { return is_sealed_; }
  const std::vector<Field>& fields() const { return fields_; }

  Json write(const void* value) const override;
  void read(const Json& json, const Bounds& bounds, const Place& place, void* value) const override;
  bool is_empty(const void*) const override { return false; }
  Json schema(const Bounds& bounds) const override;
  std::string typescript(const Bounds& bounds) const override;
  void define(Definitions& definitions) const override { definitions.add(*this); }

  /// The definition that schema() refers to, and the interface that typescript() names.
  Json definition() const;
  std::string interface() const;

 private:
  template <class>
  struct OfMember;
  template <class S, class T>
  struct OfMember<T S::*> {
    using Record = S;
    using Value = T;
  };
  template <class>
  struct OfCheck;
  template <class T>
  struct OfCheck<std::string (*)(const T&)> {
    using type = T;
  };
  /// The keys of `json` that the table does not have.
  Json others(const Json& json) const;

  std::string_view name_, meaning_, kind_;
  bool is_sealed_ = false;
  std::vector<Field> fields_;
  std::vector<std::vector<std::string_view>> needs_;
  std::string (*contradiction_)(const void* record) = nullptr;
};

/// The table of T, built at its first use:
///
///   const Struct& Place::type() {
///     return define<Place>("Place", "Where a pixel is.", [](Struct& t) {
///       t.key<&Place::x>("x", "from the left").unit("pixels").at_least(0);
///       t.key<&Place::y>("y", "from the top").unit("pixels").at_least(0);
///     });
///   }
template <class T>
const Struct& define(std::string_view name, std::string_view meaning, void (*fill)(Struct&)) {
  static const Struct type(name, meaning, fill);
  return type;
}

}  // namespace lobelia::records
