// The parts of lobelia_shader_runner.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/shader_check/runner_protocol.hpp"

namespace lobelia::shader_runner {

/// Ends the program with this exit code (RunnerExit) and message.
struct Failure : std::runtime_error {
  Failure(int exit_code, const std::string& message)
      : std::runtime_error(message), code(exit_code) {}
  int code;
};

/// The size of the work: every program runs once for each point and each output.
struct Work {
  std::size_t points = 0, texels = 0, outputs = 0;
  std::size_t invocations() const { return points * outputs; }
};

/// A driver of a device with the points on it. Functions throw Failure.
class Driver {
 public:
  virtual ~Driver() = default;
  virtual std::string device() const = 0;   ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  virtual std::string version() const = 0;  ///< of the driver
  /// Compiles a program, which then has the next number from 0 on.
  virtual void add(const std::string& program) = 0;
  /// Runs program `k` and waits for its end.
  virtual void run(std::size_t k) = 0;
  /// The output of the last run: four floats for each invocation.
  virtual std::vector<float> results() = 0;
};

std::unique_ptr<Driver> make_egl_driver(const Work& work, std::span<const float> points);
std::unique_ptr<Driver> make_vulkan_driver(const Work& work, std::span<const float> points);

}  // namespace lobelia::shader_runner
