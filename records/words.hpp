// Parts of a record as people read them, for pages that print them without understanding them.
#pragma once

#include <string>

#include "records/struct_type.hpp"

namespace lobelia::records {

namespace detail {
Named<std::string> words_of(const Struct& type, const void* part);
std::string in_words(const Struct& type, const void* part);
Named<double> numbers_of(const Struct& type, const void* part);
}  // namespace detail

/// Every key that is there with its value in words, in the table's order.
template <class T>
Named<std::string> words_of(const T& part) {
  return detail::words_of(T::type(), &part);
}

/// "camera 4, shadow 0", without what lies deeper.
template <class T>
std::string in_words(const T& part) {
  return detail::in_words(T::type(), &part);
}

/// Every key that is there and a number.
template <class T>
Named<double> numbers_of(const T& part) {
  return detail::numbers_of(T::type(), &part);
}

}  // namespace lobelia::records
