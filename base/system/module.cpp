#include "base/system/module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/system/no_resources.hpp"

namespace lobelia {
namespace fs = std::filesystem;

fs::path find_companion(std::string_view name) {
  // Looked up once, because the library's name may be relative to the directory that the program began in.
  static const std::vector<fs::path> places = [] {
    const fs::path file = own_file(), here = file.parent_path(), above = here.parent_path();
    if (file == program_file()) return std::vector{here, above / "lib/lobelia"};
    // Debian has libraries in lib/ARCHITECTURE.
    return std::vector{here, here / "lobelia", above / "lobelia"};
  }();
  for (const fs::path& place : places)
    if (file_type_at(place / name) == fs::file_type::regular) return place / name;
  return {};
}

fs::path companion_file(const char* name) {
  if (fs::path found = find_companion(name); !found.empty()) return found;
  // Nothing is known of the file that it should read.
  throw Error(ExitCode::kInput, "{} is neither beside {} nor in ../lib/lobelia", name,
              own_file().string())
      .set_fault(true);
}

void* Module::find(const char* name) {
  std::call_once(once_, [this] {
    if (require_room_) require_room_();
    handle_ = ::dlopen(companion_file(file_).c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!handle_) throw failure_of(title_, std::runtime_error(::dlerror()), ExitCode::kInput);
  });
  void* const found = ::dlsym(handle_, name);
  if (!found) throw Error(ExitCode::kInternal, "{}: {}", title_, ::dlerror());
  return found;
}

}  // namespace lobelia
