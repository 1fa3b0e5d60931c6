// Parts of a record as text, for pages that print them without knowing their keys.
#pragma once

#include <string>

#include "base/records/struct_type.hpp"

namespace lobelia::records {

namespace detail {
Named<std::string> words_of(const Struct& type, const void* part);
std::string in_words(const Struct& type, const void* part);
Named<double> numbers_of(const Struct& type, const void* part);
}  // namespace detail

/// Every key that is present with its value as text, in the table's order.
template <class T>
Named<std::string> words_of(const T& part) {
  return detail::words_of(struct_type<T>(), &part);
}

/// "camera 4, shadow 0", without deeper levels.
template <class T>
std::string in_words(const T& part) {
  return detail::in_words(struct_type<T>(), &part);
}

/// Every key that is present and a number.
template <class T>
Named<double> numbers_of(const T& part) {
  return detail::numbers_of(struct_type<T>(), &part);
}

}  // namespace lobelia::records
