#include "base/system/host.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostProcesses = 1000;  // of a tree that may grow without end

/// The number after `name` in a file of "NAME: NUMBER" or "NAME NUMBER" lines.
std::optional<std::uint64_t> number_in(const std::string& file, std::string_view name) {
  std::ifstream lines(file);
  for (std::string word; lines >> word;)
    if (std::uint64_t number = 0; word == name && lines >> number) return number;
  return std::nullopt;
}

std::uint64_t kibibytes(const std::string& file, std::string_view name) {
  return number_in(file, name).value_or(0) * 1024;
}

std::uint64_t resident(pid_t process) {
  std::ifstream pages(fmt::format("/proc/{}/statm", process));
  std::uint64_t all = 0, resident = 0;
  pages >> all >> resident;
  return resident * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

/// The program or library with this code. The program has no name.
const link_map& own_object() {
  Dl_info unused;
  void* object = nullptr;
  ::dladdr1(reinterpret_cast<const void*>(&own_object), &unused, &object, RTLD_DL_LINKMAP);
  return *static_cast<const link_map*>(object);
}

/// Reads the build ID of the object with this code.
int take_build_id(dl_phdr_info* object, std::size_t, void* result) {
  if (object->dlpi_addr != own_object().l_addr) return 0;
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
        const auto* id = reinterpret_cast<const unsigned char*>(text);
        *static_cast<std::string*>(result) =
            fmt::format("{:02x}", fmt::join(id, id + note.n_descsz, ""));
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
    return hex(sha256_of_file(own_file()));
  } catch (const Error& error) {
    throw Error(error.code(), "the program cannot tell which build it is: {}", error.what());
  }
}

}  // namespace

fs::path program_file() {
  constexpr char kLink[] = "/proc/self/exe";
  std::error_code error;
  fs::path file = fs::read_symlink(kLink, error);
  if (!error) return file;
  if (const auto* const started = reinterpret_cast<const char*>(::getauxval(AT_EXECFN)))
    file = fs::canonical(started, error);
  if (error)
    throw failure_of(fmt::format("{}: the program's own file cannot be found", kLink),
                     error.value(), ExitCode::kInput);
  return file;
}

fs::path own_file() {
  static const fs::path file = [] {
    const std::string library = own_object().l_name;
    if (library.empty()) return program_file();
    std::error_code error;
    fs::path found = fs::canonical(library, error);
    if (error) throw failure_of(library + ": cannot read", error.value(), ExitCode::kInput);
    return found;
  }();
  return file;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != line.npos) return line.substr(colon + 2);
  return "unknown";
}

std::string host_name() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

bool proc_has_our_numbers() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self", ignored) == std::to_string(::getpid());
}

ProcessStat stat_of_process(const std::string& process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  const std::string text(std::istreambuf_iterator<char>(file), {});  // "123 (name) S 1 ..."
  const std::size_t name_end = text.rfind(')');
  if (name_end == text.npos) return {};
  constexpr std::size_t kStart = 19;  // counted from the state
  const std::vector<std::string> fields = split(text.substr(name_end + 1), " ");
  long long start = 0;
  if (fields.size() <= kStart || !parse_integer(fields[kStart], start)) return {};
  return {fields[0][0], std::uint64_t(start)};
}

std::uint64_t peak_memory_of(pid_t process) {
  return kibibytes(fmt::format("/proc/{}/status", process), "VmHWM:");
}

std::uint64_t memory_of_tree(pid_t process, bool exactly) {
  if (!proc_has_our_numbers()) return 0;
  std::uint64_t sum = 0;
  std::vector<pid_t> tree{process};
  for (std::size_t i = 0; i < tree.size() && i < kMostProcesses; ++i) {
    sum += exactly ? kibibytes(fmt::format("/proc/{}/smaps_rollup", tree[i]), "Pss:")
                   : resident(tree[i]);
    // Each thread has its own children.
    std::error_code gone;
    for (fs::directory_iterator thread(fmt::format("/proc/{}/task", tree[i]), gone), end;
         !gone && thread != end; thread.increment(gone)) {
      std::ifstream children(thread->path() / "children");
      for (pid_t child = 0; children >> child;) tree.push_back(child);
    }
  }
  return sum;
}

std::optional<std::uint64_t> count_of_oom_kills() { return number_in("/proc/vmstat", "oom_kill"); }

std::uint64_t memory_of_machine() {
  return std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

const std::string& build_id() {
  static const std::string id = find_build_id();
  return id;
}

}  // namespace lobelia
