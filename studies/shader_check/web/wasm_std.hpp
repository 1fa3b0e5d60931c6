// For the WebAssembly build alone, before every file: parts of the standard library that libc++ 14 lacks. Its page has one
// thread.
#pragma once

#define _LIBCPP_FILESYSTEM  // the guard of <filesystem>, which libc++ has for no WebAssembly

// No vector registers, and nothing that brings in streams, locales or numbers of 128 bits, which are most of a library.
#define HWY_COMPILE_ONLY_SCALAR
#define FMT_HEADER_ONLY
#define FMT_STATIC_THOUSANDS_SEPARATOR ','
#define BOOST_MATH_PROMOTE_DOUBLE_POLICY false
#define BOOST_MATH_NO_LONG_DOUBLE_MATH_FUNCTIONS
#define BOOST_MATH_DOMAIN_ERROR_POLICY ignore_error
#define BOOST_MATH_POLE_ERROR_POLICY ignore_error
#define BOOST_MATH_OVERFLOW_ERROR_POLICY ignore_error
#define BOOST_MATH_EVALUATION_ERROR_POLICY ignore_error
#define BOOST_MATH_ROUNDING_ERROR_POLICY ignore_error
#define BOOST_MATH_INDETERMINATE_RESULT_ERROR_POLICY ignore_error

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace std {

struct mutex {
  void lock() {}
  void unlock() {}
};
template <class Mutex>
struct lock_guard {
  explicit lock_guard(Mutex&) {}
};
template <class Mutex>
lock_guard(Mutex&) -> lock_guard<Mutex>;

/// Of decimal digits alone, as the callers have checked.
inline from_chars_result from_chars(const char* begin, const char* end, double& value) {
  const string text(begin, end);
  char* read = nullptr;
  const double number = strtod(text.c_str(), &read);
  if (read == text.c_str()) return {begin, errc::invalid_argument};
  value = number;
  return {begin + (read - text.c_str()), errc()};
}

namespace filesystem {
/// For declarations alone.
struct path : string {
  using string::string;
};
}  // namespace filesystem

namespace views {
struct take {
  explicit take(auto most) : count(size_t(most)) {}
  size_t count;
};
template <class Range>
auto operator|(const Range& range, take taken) {
  return vector(range.begin(), range.begin() + min(taken.count, range.size()));
}
}  // namespace views

namespace ranges {

// A test of elements by their projection, and an order.
#define LOBELIA_BY_TEST(name)                                                              \
  template <class Range, class Test, class Projection = identity>                          \
  auto name(Range&& range, Test test, Projection projection = {}) {                        \
    return std::name(ranges::begin(range), ranges::end(range), [&](auto&& value) -> bool { \
      return std::invoke(test, std::invoke(projection, value));                            \
    });                                                                                    \
  }
LOBELIA_BY_TEST(all_of)
LOBELIA_BY_TEST(any_of)
LOBELIA_BY_TEST(none_of)
LOBELIA_BY_TEST(find_if)
LOBELIA_BY_TEST(count_if)
LOBELIA_BY_TEST(partition)
LOBELIA_BY_TEST(stable_partition)
#undef LOBELIA_BY_TEST

#define LOBELIA_BY_ORDER(name)                                                                   \
  template <class Range, class Order = less<>, class Projection = identity>                      \
  auto name(Range&& range, Order order = {}, Projection projection = {}) {                       \
    return std::name(ranges::begin(range), ranges::end(range), [&](auto&& a, auto&& b) -> bool { \
      return std::invoke(order, std::invoke(projection, a), std::invoke(projection, b));         \
    });                                                                                          \
  }
LOBELIA_BY_ORDER(min_element)
LOBELIA_BY_ORDER(max_element)
LOBELIA_BY_ORDER(minmax_element)
LOBELIA_BY_ORDER(sort)
LOBELIA_BY_ORDER(stable_sort)
LOBELIA_BY_ORDER(is_sorted)
#undef LOBELIA_BY_ORDER

template <class Range, class Value, class Projection = identity>
auto find(Range&& range, const Value& value, Projection projection = {}) {
  return ranges::find_if(
      range, [&](auto&& one) { return one == value; }, projection);
}
template <class Range, class Value, class Projection = identity>
auto count(Range&& range, const Value& value, Projection projection = {}) {
  return ranges::count_if(
      range, [&](auto&& one) { return one == value; }, projection);
}
template <class Range, class Value, class Projection = identity>
bool contains(Range&& range, const Value& value, Projection projection = {}) {
  return ranges::find(range, value, projection) != ranges::end(range);
}
template <class Range, class Old, class New>
void replace(Range&& range, const Old& old, const New& made) {
  for (auto& one : range)
    if (one == old) one = made;
}
template <class Range, class Value>
void fill(Range&& range, const Value& value) {
  std::fill(ranges::begin(range), ranges::end(range), value);
}
template <class Range>
void reverse(Range&& range) {
  std::reverse(ranges::begin(range), ranges::end(range));
}
template <class Range, class To>
auto copy(Range&& range, To to) {
  return std::copy(ranges::begin(range), ranges::end(range), to);
}
template <class Range, class To, class Test>
auto copy_if(Range&& range, To to, Test test) {
  return std::copy_if(ranges::begin(range), ranges::end(range), to, test);
}
template <class Range, class To, class Change>
auto transform(Range&& range, To to, Change change) {
  return std::transform(ranges::begin(range), ranges::end(range), to, change);
}
template <class A, class B>
bool equal(A&& a, B&& b) {
  return std::equal(ranges::begin(a), ranges::end(a), ranges::begin(b), ranges::end(b));
}
template <class Range, class At>
void nth_element(Range&& range, At at) {
  std::nth_element(ranges::begin(range), at, ranges::end(range));
}
template <class Range, class Value, class Order = less<>, class Projection = identity>
auto lower_bound(Range&& range, const Value& value, Order order = {}, Projection projection = {}) {
  return std::lower_bound(ranges::begin(range), ranges::end(range), value,
                          [&](auto&& one, auto&& sought) -> bool {
                            return std::invoke(order, std::invoke(projection, one), sought);
                          });
}
template <class Range, class Value, class Order = less<>, class Projection = identity>
auto upper_bound(Range&& range, const Value& value, Order order = {}, Projection projection = {}) {
  return std::upper_bound(ranges::begin(range), ranges::end(range), value,
                          [&](auto&& sought, auto&& one) -> bool {
                            return std::invoke(order, sought, std::invoke(projection, one));
                          });
}
template <class Range, class Order = less<>, class Projection = identity>
auto max(Range&& range, Order order = {}, Projection projection = {}) {
  return *ranges::max_element(range, order, projection);
}
template <class Range, class Order = less<>, class Projection = identity>
auto min(Range&& range, Order order = {}, Projection projection = {}) {
  return *ranges::min_element(range, order, projection);
}

}  // namespace ranges
}  // namespace std
