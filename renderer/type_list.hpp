// A list of types: what a catalogue is.
#pragma once

#include <array>
#include <cstddef>

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

}  // namespace lobelia
