// A list of types, such as every catalogue.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace lobelia {

template <class... Types>
struct TypeList {
  static constexpr std::size_t kSize = sizeof...(Types);
};

/// { f<Type>() for each Type of the list }, an array in the list's order.
template <class Result, class... Types, class F>
constexpr std::array<Result, sizeof...(Types)> map_types(TypeList<Types...>, F f) {
  return {f.template operator()<Types>()...};
}

/// The position of Type in the list.
template <class Type, class... Types>
constexpr std::size_t index_of(TypeList<Types...>) {
  static_assert((std::is_same_v<Type, Types> || ...), "not in the list");
  std::size_t index = 0;
  (void)((std::is_same_v<Type, Types> || (++index, false)) || ...);
  return index;
}

}  // namespace lobelia
