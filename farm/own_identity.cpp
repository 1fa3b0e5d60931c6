#include "farm/own_identity.hpp"

#include <fmt/format.h>
#include <link.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "base/pictures/image_io_module.hpp"
#include "base/system/host.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/process.hpp"
#include "base/system/sha256.hpp"
#include "base/system/version.hpp"
#include "base/words/text.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;
using records::Arithmetic;

/// The dynamic loader's path, from the program's own header.
std::string find_loader() {
  std::string loader;
  ::dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void* result) {
        for (int i = 0; i < object->dlpi_phnum; ++i)
          if (object->dlpi_phdr[i].p_type == PT_INTERP)
            *static_cast<std::string*>(result) =
                reinterpret_cast<const char*>(object->dlpi_addr + object->dlpi_phdr[i].p_vaddr);
        return 1;  // the first object is the program
      },
      &loader);
  return loader;
}

/// All libraries that the loader would load for a file, as ldd prints them: "name => /path (0x...)" or "/path (0x...)".
/// Ignores LD_PRELOAD: a cluster's allocator or profiler is no part of us, and a changed libm shows in the arithmetic.
/// Throws Error(kInput) if the list is not whole, because results would get other keys.
std::vector<fs::path> libraries_of(const std::string& loader, const fs::path& file) {
  ProcessOptions options;
  options.only_environment = true;
  if (const char* path = std::getenv("LD_LIBRARY_PATH"))
    options.environment.push_back(fmt::format("LD_LIBRARY_PATH={}", path));
  std::vector<fs::path> libraries;
  options.on_line = [&](std::string_view line) {
    const auto begin = line.find('/'), end = line.rfind(" (0x");
    if (begin != line.npos && end != line.npos && begin < end)
      libraries.emplace_back(line.substr(begin, end - begin));
  };
  const ProcessResult listed = run_process({loader, "--list", file.string()}, options);
  throw_if_interrupted();
  if (listed.exit_code == 0) return libraries;
  const std::vector<std::string> lines = split(listed.output_tail, "\n");
  std::string why = lines.empty() ? fmt::format("exit code {}", listed.exit_code) : lines.back();
  constexpr std::string_view kLoading = "error while loading shared libraries: ";
  if (const std::size_t at = why.find(kLoading); at != why.npos) why.erase(0, at + kLoading.size());
  throw failure_of(file.string() + ": its libraries cannot be listed", std::runtime_error(why),
                   ExitCode::kInput);
}

Content find_libraries() {
  FileHashes& hashes = FileHashes::of_user();
  ContentReader reader(hashes);
  const std::string loader = find_loader();
  std::vector<fs::path> files;
  // The other modules have no part in a result.
  for (const char* own : {image_io_module.file(), colour_module.file(), embree_module.file(),
                          png_module.file(), kReaderFile}) {
    files.push_back(companion_file(own));
    reader.add("library", own, files.back());
  }
  files.push_back(own_file());
  if (!loader.empty())
    for (const fs::path& file : files)
      for (const fs::path& library : libraries_of(loader, file))
        reader.add("library", library.filename().native(), library);
  hashes.save();
  return reader.content();
}

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
  /// Alternates between even spacing and values close to `first`.
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
    // Without its padding bytes.
    const double high = double(value), low = double(value - static_cast<long double>(high));
    add(high);
    add(low);
  }
  void append(const void* value, std::size_t size) {
    bytes_.append(static_cast<const char*>(value), size);
  }
  std::string bytes_;
};

/// Every function of libm that we use, except those that IEEE 754 requires to round correctly.
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
  // Libraries choose variants by these: glibc, Embree, OpenImageDenoise, Cycles, POV-Ray.
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

std::string OwnIdentity::text() const {
  return fmt::format("{}\n{}\n{}\n{}\n{}", program, libraries, arithmetic.libm, arithmetic.kernels,
                     arithmetic.processor);
}

const OwnIdentity& own_identity() {
  static const OwnIdentity identity{std::string(kNameAndVersion) + " " + build_id(),
                                    own_libraries().sha256, find_arithmetic()};
  return identity;
}

const Content& own_libraries() {
  static const Content libraries = find_libraries();
  return libraries;
}

std::vector<std::string> identity_differences(const OwnIdentity& planned, const OwnIdentity& here) {
  std::vector<std::string> differences;
  const auto compare = [&](const std::string& a, const std::string& b, const std::string& what) {
    if (a != b) differences.push_back(what);
  };
  const auto both = [](std::string_view what, const std::string& a, const std::string& b) {
    return fmt::format("{}: {} here, {} in the plan", what, printable(b), printable(a));
  };
  compare(planned.program, here.program, both("program", planned.program, here.program));
  compare(planned.libraries, here.libraries, "libraries: other files");
  const Arithmetic &a = planned.arithmetic, &b = here.arithmetic;
  compare(a.libm, b.libm, "libm: other results");
  compare(a.kernels, b.kernels, both("kernels", a.kernels, b.kernels));
  compare(a.processor, b.processor, both("processor", a.processor, b.processor));
  return differences;
}

}  // namespace lobelia
