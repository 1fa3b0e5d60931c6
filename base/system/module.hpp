// Parts of the program that are loaded when they are needed, because their libraries would cost every start time
// (docs/decisions/0009).
//
// A module with code of ours offers a table. One without code only brings a library of C, whose functions are called
// through ModuleFunction.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <string_view>

namespace lobelia {

class Module {
 public:
  /// `title` begins the messages of failures. `require_room` may throw before it is loaded.
  constexpr Module(const char* file, const char* title, void (*require_room)() = nullptr)
      : file_(file), title_(title), require_room_(require_room) {}
  const char* file() const { return file_; }

  /// The symbol of this name in the module or in a library that it brings. The first call loads the module. Throws
  /// Error(kInternal) if there is no such module or name, Error(kInput) if the module or one of its libraries cannot be
  /// read, Error(kNoResources) if there is no room.
  void* find(const char* name);

 private:
  const char *file_, *title_;
  void (*require_room_)();
  std::once_flag once_;
  void* handle_ = nullptr;
};

// All but the image module, which is in base/pictures/image_io_module.hpp.
inline constinit Module colour_module{"lobelia_colour.so", "colour module"};
inline constinit Module embree_module{"lobelia_embree.so", "Embree's module"};
inline constinit Module glpk_module{"lobelia_glpk.so", "GLPK's module"};
inline constinit Module png_module{"lobelia_png.so", "PNG module"};

class ModuleAddress {
 public:
  constexpr ModuleAddress(Module& module, const char* name) : module_(module), name_(name) {}
  void* find() {
    void* found = found_.load(std::memory_order_acquire);
    if (!found) found_.store(found = module_.find(name_), std::memory_order_release);
    return found;
  }

 private:
  Module& module_;
  const char* name_;
  std::atomic<void*> found_{nullptr};
};

/// A function of a library that a module brings: ModuleFunction<decltype(::rtcNewDevice)>.
template <class Function>
class ModuleFunction;
template <class Result, class... Arguments>
class ModuleFunction<Result(Arguments...)> : ModuleAddress {
 public:
  using ModuleAddress::ModuleAddress;
  Result operator()(Arguments... arguments) {
    return reinterpret_cast<Result (*)(Arguments...)>(find())(arguments...);
  }
};
/// Defines `function`, which hides that of the library.
#define LOBELIA_MODULE_FUNCTION(module, function) \
  constinit ModuleFunction<decltype(::function)> function { module, #function }

/// The path of a file that is installed with the program: beside it in a build tree, else in ../lib/lobelia; for the
/// shared library beside that, or in lobelia/ or ../lobelia. Throws Error(kInput) if it is in none, or if the system
/// cannot tell.
std::filesystem::path companion_file(const char* name);
/// The same, but empty if it is in none.
std::filesystem::path find_companion(std::string_view name);

}  // namespace lobelia
