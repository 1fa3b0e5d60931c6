#include "core/peak_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace lobelia {
namespace {

constexpr std::size_t kMostProcesses = 1000;  // of a family that never stops growing

}  // namespace

std::uint64_t peak_memory_of(pid_t process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string word; status >> word;)
    if (std::uint64_t kibibytes = 0; word == "VmHWM:" && status >> kibibytes)
      return kibibytes * 1024;
  return 0;
}

std::uint64_t peak_memory_of_family(pid_t process) {
  std::uint64_t peak = 0;
  std::vector<pid_t> family{process};
  for (std::size_t i = 0; i < family.size() && i < kMostProcesses; ++i) {
    peak = std::max(peak, peak_memory_of(family[i]));
    // Those that its first thread has started; engines have no others.
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", family[i]));
    for (pid_t child = 0; children >> child;) family.push_back(child);
  }
  return peak;
}

}  // namespace lobelia
