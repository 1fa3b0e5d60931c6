#include "farm/own_identity.hpp"

#include <fmt/format.h>
#include <link.h>

#include <cstdlib>

#include "core/error.hpp"
#include "core/host.hpp"
#include "core/image_io_module.hpp"
#include "core/process.hpp"
#include "core/text.hpp"
#include "core/version.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// The loader itself, as the program has it.
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

/// All libraries that the loader would give a file, as ldd tells them: "name => /path (0x...)" or "/path (0x...)". What is
/// preloaded is not asked for: a cluster's own allocator or profiler is no part of us, and what a preloaded library does
/// to the functions of libm shows in the arithmetic.
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
  run_process({loader, "--list", file.string()}, options);
  return libraries;
}

Content find_libraries() {
  FileHashes& hashes = FileHashes::of_user();
  ContentReader reader(hashes);
  const std::string loader = find_loader();
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path module = companion_file(kImageIoModuleFile);
  const fs::path picture_reader = companion_file(kReaderFile);
  for (const fs::path& own : {module, picture_reader})
    reader.add("library", own.filename().native(), own);
  if (!loader.empty())
    for (const fs::path& file : {program, module, picture_reader})
      for (const fs::path& library : libraries_of(loader, file))
        reader.add("library", library.filename().native(), library);
  hashes.save();
  return reader.content();
}

}  // namespace

std::string OwnIdentity::text() const {
  return fmt::format("{}\n{}\n{}\n{}\n{}", program, libraries, arithmetic.libm, arithmetic.kernels,
                     arithmetic.processor);
}

const OwnIdentity& own_identity() {
  static const OwnIdentity identity{std::string(kNameAndVersion) + " " + build_id(),
                                    own_libraries().sha256, arithmetic()};
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
