// A command as a process of its own, with what it took.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/timing.hpp"

namespace lobelia::bench {

/// What a command took; what it prints is not shown.
struct Child {
  double seconds = 0, processor_seconds = 0, peak_mebibytes = 0;
};

inline Child run(const std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (const auto& a : arguments) pointers.push_back(const_cast<char*>(a.c_str()));
  pointers.push_back(nullptr);
  Child result;
  rusage usage{};
  int status = 0;
  result.seconds = seconds_of([&] {
    const pid_t pid = ::fork();
    if (pid == 0) {
      ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
      ::execv(pointers[0], pointers.data());
      ::_exit(127);
    }
    ::wait4(pid, &status, 0, &usage);
  });
  if (status != 0) {
    fmt::print(stderr, "{} failed\n", arguments[0]);
    std::exit(EXIT_FAILURE);
  }
  const auto seconds = [](timeval t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  result.processor_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_mebibytes = double(usage.ru_maxrss) / 1024;
  return result;
}

}  // namespace lobelia::bench
