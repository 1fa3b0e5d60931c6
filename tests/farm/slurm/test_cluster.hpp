// A real Slurm cluster of three nodes on this machine, for one test (tests/farm/slurm/cluster).
#pragma once

#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "lobelia_paths.hpp"
#include "tests/test.hpp"

namespace lobelia {

class TestCluster {
 public:
  TestCluster() { ::setenv("SLURM_CONF", (directory_.path() / "slurm.conf").c_str(), 1); }
  ~TestCluster() {
    if (up_) run({"down"});
    ::unsetenv("SLURM_CONF");
  }
  TestCluster(const TestCluster&) = delete;
  TestCluster& operator=(const TestCluster&) = delete;

  /// Why there can be none here; empty if there can.
  static std::string why_not() {
    const ProcessResult result = run_process({script(), "can"}, {});
    return result.exit_code == 0 ? "" : result.output_tail;
  }
  void up() {
    up_ = true;
    run({"up"});
  }
  /// On which elements are killed that use more memory than they asked for.
  void up_with_memory_limits() {
    up_ = true;
    run({"up"}, "memory");
  }
  /// kill -9 of everything on it, as if the power were gone.
  void kill_node(const std::string& node) const { run({"kill-node"}, node); }
  void stop_controller() const { run({"stop-controller"}); }
  void start_controller() const { run({"start-controller"}); }
  void drain(const std::string& nodes) const {
    slurm({"scontrol", "update", "NodeName=" + nodes, "State=DRAIN", "Reason=test"});
  }
  void resume(const std::string& nodes) const {
    slurm({"scontrol", "update", "NodeName=" + nodes, "State=RESUME"});
  }
  std::string slurm(std::vector<std::string> arguments) const {
    arguments.front() = find_program(arguments.front()).string();
    const ProcessResult result = run_process(arguments, {});
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    return result.output_tail;
  }

 private:
  static std::string script() { return LOBELIA_SOURCE_DIR "/tests/farm/slurm/cluster"; }
  void run(std::vector<std::string> arguments, const std::string& more = "") const {
    arguments.insert(arguments.begin(), script());
    arguments.push_back(directory_.path().string());
    if (!more.empty()) arguments.push_back(more);
    ProcessOptions options;
    options.uninterruptible = true;  // what it starts goes on
    const ProcessResult result = run_process(arguments, options);
    ASSERT_EQ(result.exit_code, 0) << result.output_tail;
  }

  TemporaryDirectory directory_;
  bool up_ = false;
};

}  // namespace lobelia
