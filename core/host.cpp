#include "core/host.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

namespace lobelia {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != line.npos) return line.substr(colon + 2);
  return "unknown";
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

Json host_record() {
  utsname system{};
  ::uname(&system);
  return {{"processor", processor_name()},
          {"threads", std::thread::hardware_concurrency()},
          {"system", std::string(system.sysname) + " " + system.release + " " + system.machine}};
}

bool proc_has_our_numbers() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self", ignored) == std::to_string(::getpid());
}

}  // namespace lobelia
