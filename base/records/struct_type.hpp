// The table of a struct: key, member, meaning, unit and bounds.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <typeinfo>
#include <vector>

#include "base/records/members.hpp"
#include "base/records/type.hpp"

namespace lobelia::records {

/// When a key is written.
enum class Presence : std::uint8_t {
  kAlways,
  kIfAny,   ///< missing if the member (an optional, a list, a text) is empty
  kOrNull,  ///< null if the member is empty
};

/// A key of a struct's table.
struct Field {
  std::string_view key;  ///< empty: all keys that the others do not name
  const Type* type = nullptr;
  std::size_t offset = 0;  ///< of the member within the struct
  Presence presence = Presence::kAlways;
  std::string_view meaning = {};  ///< for the reference page; empty if the key is clear
  std::string_view unit = {};     ///< "seconds", "bytes"; empty for none
  Bounds bounds = {};

  bool is_rest() const { return key.empty(); }
  bool is_required() const { return presence != Presence::kIfAny && !is_rest(); }
  std::string description() const;  ///< "width; pixels"
  void* member_of(void* record) const;
};

/// Sets attributes of one key or of several.
class Keys {
 public:
  void add(Field& field) { fields_.push_back(&field); }

  Keys& meaning(std::string_view sentence) { return set(&Field::meaning, sentence); }
  Keys& unit(std::string_view name) { return set(&Field::unit, name); }
  Keys& at_least(double least) { return set(&Bounds::least, least); }
  Keys& at_most(double most) { return set(&Bounds::most, most); }
  Keys& within(double least, double most) { return at_least(least).at_most(most); }
  /// Without `least` and `most` themselves.
  Keys& between(double least, double most) {
    return set(&Bounds::without_ends, true).within(least, most);
  }
  /// Allows numbers that are not finite, as the texts "nan", "inf" and "-inf".
  Keys& may_be_nonfinite() { return set(&Bounds::nonfinite, true); }
  Keys& one_of(std::span<const std::string_view> texts) { return set(&Bounds::one_of, texts); }
  /// A file beside the record; see is_plain_name().
  Keys& plain_name() { return set(&Bounds::plain_name, true); }
  Keys& not_empty() { return set(&Bounds::least_text, 1); }
  Keys& most_text(std::size_t bytes) { return set(&Bounds::most_text, bytes); }
  Keys& items(std::size_t least, std::size_t most = kMaxItems) {
    return set(&Bounds::least_items, least).set(&Bounds::most_items, most);
  }
  /// Missing if it is empty; the default of optionals.
  Keys& if_any() { return set(&Field::presence, Presence::kIfAny); }
  /// Null if it is empty.
  Keys& or_null() { return set(&Field::presence, Presence::kOrNull); }
  Keys& always() { return set(&Field::presence, Presence::kAlways); }
  /// A key that differs from the member's name.
  Keys& renamed(std::string_view key) { return set(&Field::key, key); }

 private:
  template <class V>
  Keys& set(V Field::*member, std::type_identity_t<V> value) {
    for (Field* field : fields_) field->*member = value;
    return *this;
  }
  template <class V>
  Keys& set(V Bounds::*member, std::type_identity_t<V> value) {
    for (Field* field : fields_) field->bounds.*member = value;
    return *this;
  }

  std::vector<Field*> fields_;
};

enum class Seal : bool { kNo, kYes };

/// A struct with its table.
class Struct final : public Type {
 public:
  /// `name` names the TypeScript interface and the schema's definition.
  Struct(std::string_view name, std::string_view meaning) : name_(name), meaning_(meaning) {}

  void add_key(std::string_view key, const Type& type, std::size_t offset, Presence presence);

  std::string_view name() const { return name_; }
  std::string_view meaning() const { return meaning_; }
  std::string_view kind() const { return kind_; }  ///< empty for a part of records
  bool is_sealed() const { return is_sealed_; }
  bool is_by_hand() const { return is_by_hand_; }
  const std::vector<Field>& fields() const { return fields_; }

  Json write(const void* value) const override;
  void read(const Json& json, const Bounds& bounds, const Place& place, void* value) const override;
  Json schema(const Bounds& bounds) const override;
  std::string typescript(const Bounds& bounds) const override;
  void define(Definitions& definitions) const override { definitions.add(*this); }

  /// The definition that schema() refers to, and the interface that typescript() names.
  Json definition() const;
  std::string interface() const;

 private:
  template <class>
  friend class Table;
  /// Fails at a key of `json` that is not in the table.
  void refuse_others(const Json& json, const Place& place) const;
  /// The keys of `json` that are not in the table.
  Json others(const Json& json) const;

  std::string_view name_, meaning_, kind_;
  bool is_sealed_ = false, is_by_hand_ = false;
  std::vector<Field> fields_;
  std::vector<std::vector<std::string_view>> needs_;
  std::function<std::string(const void* record)> contradiction_;
};

namespace detail {

template <class V>
void add_member(Struct& type, std::string_view key, const V* member, const void* whole) {
  type.add_key(key, type_of<V>(),
               std::size_t(reinterpret_cast<const char*>(member) - static_cast<const char*>(whole)),
               kIsOptional<V> ? Presence::kIfAny : Presence::kAlways);
}

}  // namespace detail

/// Adds what the struct does not say. A key without a member does not compile.
template <class T>
class Table {
 public:
  explicit Table(Struct& type) : type_(type) {}

  struct Key {
    consteval Key(const char* key) : index(index_of(key)) {}
    std::size_t index;
  };

  Keys key(Key key, std::string_view meaning = "") { return keys({key}).meaning(meaning); }
  Keys keys(std::initializer_list<Key> keys) {
    Keys chosen;
    for (const Key key : keys) chosen.add(type_.fields_[key.index]);
    return chosen;
  }
  Keys all() {
    Keys all;
    for (Field& field : type_.fields_) all.add(field);
    return all;
  }
  /// A Named member for all keys that are not in the table. It is the last member.
  Keys rest(Key key, std::string_view meaning = "") { return this->key(key, meaning).renamed(""); }
  /// Makes it a record of its own: kind and version come first, and a `seal` last if it has one.
  void kind(std::string_view kind, Seal seal = Seal::kNo) {
    type_.kind_ = kind;
    type_.is_sealed_ = seal == Seal::kYes;
  }
  /// People write it: a key that is not in the table is an error, and a record of its own needs no kind and version.
  void by_hand() { type_.is_by_hand_ = true; }
  /// Requires all keys of at least one of these lists.
  void needs(std::vector<std::vector<std::string_view>> lists) { type_.needs_ = std::move(lists); }
  /// Checks keys against each other. `contradiction` returns a sentence, or an empty text if all is well.
  void check(std::string (*contradiction)(const T&)) {
    type_.contradiction_ = [contradiction](const void* record) {
      return contradiction(*static_cast<const T*>(record));
    };
  }

 private:
  static consteval std::size_t index_of(std::string_view key) {
    for (std::size_t i = 0; i < detail::kKeys<T>.size(); ++i)
      if (detail::kKeys<T>[i] == key) return i;
    throw "no member has this name";
  }

  Struct& type_;
};

namespace detail {

template <class T>
[[gnu::cold]] Struct make_struct(std::string_view meaning, void (*fill)(Table<T>&)) {
  Struct made(type_name<T>(), meaning);
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (add_member(made, kKeys<T>[I], get<I>(kMembers<T>), &kUnmade<T>), ...);
  }
  (MemberIndices<T>());
  Table<T> table(made);
  if (fill) fill(table);
  return made;
}

const Struct& find_struct(const std::type_info& type);

}  // namespace detail

/// The tables of all structs. Each file of records defines its own; base/records/catalogue.cpp collects them.
class Tables {
 public:
  /// Every member of T is a key: `white_at` is whiteAt. `fill` adds what the struct does not say. It runs at the first use.
  ///
  ///   tables.define<Place>("Where a pixel is.", [](auto& t) {
  ///     t.key("x", "from the left");
  ///     t.key("y", "from the top");
  ///     t.all().unit("pixels").at_least(0);
  ///   });
  template <class T>
  void define(std::string_view meaning, void (*fill)(Table<T>&) = nullptr) {
    tables_[typeid(T)] = [=]() -> const Struct& {
      static const Struct type = detail::make_struct<T>(meaning, fill);
      return type;
    };
  }
  const Struct& operator[](const std::type_info& type) const { return tables_.at(type)(); }

 private:
  std::map<std::type_index, std::function<const Struct&()>> tables_;
};

/// The table of T.
template <class T>
const Struct& struct_type() {
  static const Struct& type = detail::find_struct(typeid(T));
  return type;
}

}  // namespace lobelia::records
