// The members of a plain struct: keys, types and offsets. Before C++26 has reflection, a structured binding takes the struct
// apart, and the compiler's text for a pointer to a member has its name.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace lobelia::records::detail {

/// Converts to any member's type; never called.
struct AnyMember {
  template <class T>
  operator T() const;
};

template <class T, class... Members>
consteval std::size_t count_members() {
  if constexpr (requires { T{Members{}..., AnyMember{}}; })
    return count_members<T, Members..., AnyMember>();
  else
    return sizeof...(Members);
}

/// Storage of a T that is never constructed, so that its members have addresses.
template <class T>
union Unmade {
  constexpr Unmade() : none() {}
  constexpr ~Unmade() {}
  char none;
  T value;
};
template <class T>
inline constexpr Unmade<T> kUnmade;

/// A tuple of pointers; compiles faster than std::tuple.
template <std::size_t I, class Member>
struct Slot {
  const Member* pointer;
};
template <class, class...>
struct Slots;
template <std::size_t... I, class... Members>
struct Slots<std::index_sequence<I...>, Members...> : Slot<I, Members>... {};
template <std::size_t I, class Member>
consteval const Member* get(const Slot<I, Member>& slot) {
  return slot.pointer;
}

template <class... Members>
consteval auto pointers_to(const Members&... members) {
  return Slots<std::index_sequence_for<Members...>, Members...>{{&members}...};
}

template <class T>
consteval auto member_pointers() {
  static_assert(count_members<T>() <= 27, "a struct of more members needs more lines here");
#define LOBELIA_MEMBERS(count, ...)               \
  if constexpr (count_members<T>() == count) {    \
    const auto& [__VA_ARGS__] = kUnmade<T>.value; \
    return pointers_to(__VA_ARGS__);              \
  }
  LOBELIA_MEMBERS(1, a)
  LOBELIA_MEMBERS(2, a, b)
  LOBELIA_MEMBERS(3, a, b, c)
  LOBELIA_MEMBERS(4, a, b, c, d)
  LOBELIA_MEMBERS(5, a, b, c, d, e)
  LOBELIA_MEMBERS(6, a, b, c, d, e, f)
  LOBELIA_MEMBERS(7, a, b, c, d, e, f, g)
  LOBELIA_MEMBERS(8, a, b, c, d, e, f, g, h)
  LOBELIA_MEMBERS(9, a, b, c, d, e, f, g, h, i)
  LOBELIA_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
  LOBELIA_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
  LOBELIA_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
  LOBELIA_MEMBERS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
  LOBELIA_MEMBERS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
  LOBELIA_MEMBERS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
  LOBELIA_MEMBERS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
  LOBELIA_MEMBERS(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
  LOBELIA_MEMBERS(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
  LOBELIA_MEMBERS(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
  LOBELIA_MEMBERS(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
  LOBELIA_MEMBERS(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
  LOBELIA_MEMBERS(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
  LOBELIA_MEMBERS(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
  LOBELIA_MEMBERS(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
  LOBELIA_MEMBERS(25, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y)
  LOBELIA_MEMBERS(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z)
  LOBELIA_MEMBERS(27, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                  aa)
#undef LOBELIA_MEMBERS
}

template <class T>
inline constexpr auto kMembers = member_pointers<T>();
template <class T>
using MemberIndices = std::make_index_sequence<count_members<T>()>;

/// Clang 14 accepts a pointer as a template argument only inside a class.
template <class Pointer>
struct Pointed {
  Pointer pointer;
};
template <class Pointer>
Pointed(Pointer) -> Pointed<Pointer>;

/// "whiteAt": the key of a member `white_at`.
struct KeyName {
  std::array<char, 32> text{};
  std::size_t size = 0;
  constexpr operator std::string_view() const { return {text.data(), size}; }
};

template <Pointed kMember>
consteval KeyName key_name() {
  // "... {(& kUnmade<T>.T::white_at)}]" or "... {&kUnmade.value.white_at}]"
  const std::string_view text = __PRETTY_FUNCTION__;
  std::size_t end = text.size();
  while (text[end - 1] == ']' || text[end - 1] == '}' || text[end - 1] == ')') --end;
  std::size_t begin = end;
  while (text[begin - 1] != ':' && text[begin - 1] != '.') --begin;
  KeyName key;
  bool is_upper = false;
  for (std::size_t i = begin; i < end; ++i) {
    if (text[i] != '_') key.text[key.size++] = is_upper ? char(text[i] - 'a' + 'A') : text[i];
    is_upper = text[i] == '_';
  }
  return key;
}

/// "Window".
template <class T>
consteval std::string_view type_name() {
  std::string_view text = __PRETTY_FUNCTION__;  // "... [with T = lobelia::records::Window; ...]"
  text = text.substr(text.find("T = "));
  text = text.substr(0, text.find_first_of(";]"));
  return text.substr(text.rfind(':') + 1);
}

/// The keys of T's members.
template <class T>
inline constexpr auto kKeys = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array{key_name<Pointed{get<I>(kMembers<T>)}>()...};
}
(MemberIndices<T>());

}  // namespace lobelia::records::detail
