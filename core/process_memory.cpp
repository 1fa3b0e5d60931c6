#include "core/process_memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/host.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostProcesses = 1000;  // of a tree that never stops growing

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

}  // namespace

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
    // Any thread may have started some.
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

}  // namespace lobelia
