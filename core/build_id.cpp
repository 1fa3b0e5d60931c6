#include "core/build_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstring>

#include "core/error.hpp"
#include "core/sha256.hpp"

namespace lobelia {
namespace {

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

/// Reads the build ID of the first object, which is the program itself.
int take_build_id(dl_phdr_info* object, std::size_t, void* result) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& part = object->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    const char* at = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    const char* const end = at + part.p_memsz;
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof note);
      const char* name = at + sizeof note;
      const char* text = name + padded(note.n_namesz);
      if (text + note.n_descsz > end) break;
      if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 &&
          std::memcmp(name, "GNU", 4) == 0) {
        auto& id = *static_cast<std::string*>(result);
        for (std::size_t k = 0; k < note.n_descsz; ++k)
          id += fmt::format("{:02x}", static_cast<unsigned char>(text[k]));
        return 1;
      }
      at = text + padded(note.n_descsz);
    }
  }
  return 1;
}

std::string find_build_id() {
  std::string id;
  ::dl_iterate_phdr(take_build_id, &id);
  if (!id.empty()) return id;
  try {
    return hex(sha256_of_file("/proc/self/exe"));
  } catch (const Error& error) {
    throw Error(ExitCode::kInternal,
                fmt::format("the program cannot tell which build it is: {}", error.what()));
  }
}

}  // namespace

const std::string& build_id() {
  static const std::string id = find_build_id();
  return id;
}

}  // namespace lobelia
