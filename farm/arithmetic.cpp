#include "farm/arithmetic.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/sha256.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia {
namespace {

constexpr int kArguments = 1000;  // two variants of a function differ at about one in a hundred

/// SplitMix64: the same arguments everywhere, without a function of the library.
class Arguments {
 public:
  /// From 0 to 1.
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  /// Half of them evenly between two limits, half close to the first one.
  double between(double first, double last) {
    const double u = next();
    even_ = !even_;
    return first + (last - first) * (even_ ? u : u * u * u * u * u * u);
  }

 private:
  std::uint64_t state_ = 1;
  bool even_ = false;
};

class Fingerprint {
 public:
  template <class T>
  void of(T (*function)(T), double first, double last) {
    Arguments arguments;
    for (int i = 0; i < kArguments; ++i) add(function(T(arguments.between(first, last))));
  }
  template <class T>
  void of(T (*function)(T, T), double first, double last, double second_first, double second_last) {
    Arguments arguments;
    for (int i = 0; i < kArguments; ++i) {
      const T a = T(arguments.between(first, last));
      add(function(a, T(arguments.between(second_first, second_last))));
    }
  }
  std::string text() const { return hex(sha256(bytes_)); }

 private:
  void add(float value) { append(&value, sizeof value); }
  void add(double value) { append(&value, sizeof value); }
  void add(long double value) {
    // Without the bytes that only fill it up.
    const double high = double(value), low = double(value - static_cast<long double>(high));
    add(high);
    add(low);
  }
  void append(const void* value, std::size_t size) {
    bytes_.append(static_cast<const char*>(value), size);
  }
  std::string bytes_;
};

/// All that our program takes from libm and that does not round correctly by definition.
template <class T>
void add_all(Fingerprint& results) {
  using One = T (*)(T);
  using Two = T (*)(T, T);
  const auto of = [&](One function, double first, double last) {
    results.of(function, first, last);
  };
  for (const One function : {One(std::sin), One(std::cos), One(std::tan)}) {
    of(function, 0, 7);
    of(function, 0, 1e5);
  }
  for (const One function : {One(std::asin), One(std::acos)}) of(function, 1, -1);
  of(std::atan, 0, 100);
  for (const One function : {One(std::exp), One(std::exp2), One(std::expm1)}) of(function, 0, -80);
  for (const One function : {One(std::sinh), One(std::cosh), One(std::tanh), One(std::asinh)})
    of(function, 0, 20);
  for (const One function : {One(std::log), One(std::log2), One(std::log10)}) {
    of(function, 0, 1);
    of(function, 1, 1e6);
  }
  of(std::log1p, 0, 2);
  results.of(Two(std::pow), 1, 0, 1, 1e6);  // a lobe: cos^n
  results.of(Two(std::pow), 0, 10, 0.1, 3);
  results.of(Two(std::atan2), -1, 1, -1, 1);
  results.of(Two(std::hypot), 0, 10, 0, 10);
}

std::string processor() {
  std::string names;
#if defined(__x86_64__)
  const auto add = [&](bool has, const char* name) {
    if (has) names += (names.empty() ? "" : " ") + std::string(name);
  };
  // The steps at which libraries have another variant: glibc, Embree, OpenImageDenoise, Cycles, POV-Ray.
  add(__builtin_cpu_supports("sse4.1"), "sse4.1");
  add(__builtin_cpu_supports("sse4.2"), "sse4.2");
  add(__builtin_cpu_supports("avx"), "avx");
  add(__builtin_cpu_supports("fma"), "fma");
  add(__builtin_cpu_supports("fma4"), "fma4");
  add(__builtin_cpu_supports("avx2"), "avx2");
  add(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"),
      "avx512");
#endif
  return names;
}

Arithmetic find_arithmetic() {
  Fingerprint results;
  add_all<float>(results);
  add_all<double>(results);
  add_all<long double>(results);
  return {results.text(), kernels().instruction_set, processor()};
}

}  // namespace

const Arithmetic& arithmetic() {
  static const Arithmetic found = find_arithmetic();
  return found;
}

}  // namespace lobelia
