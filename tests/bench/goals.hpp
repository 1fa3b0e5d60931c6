// The goals of `make bench`. Each is measured in rounds, in turn with what it is held to.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lobelia::bench {

/// The two figures of one round, both in the goal's unit.
struct Round {
  double ours = 0, other = 0;
};

struct Goal {
  std::string id, what, unit;
  std::string against;  ///< another program, or a limit
  /// At least: ours is to be so many times faster than the other. At most: ours is to take no more than so many times
  /// the other.
  bool at_least = true;
  double goal = 1;
  int rounds = 5, quick_rounds = 3;  ///< 0: it is left out of a quick run
  std::function<Round()> measure;    ///< throws std::exception where it cannot be
};

struct Tools {
  std::filesystem::path program;  ///< lobelia
  std::filesystem::path scratch;  ///< an empty directory
  bool quick = false;
  std::string program_text() const { return program.string(); }
};

/// Adds goals that can be measured here; of others it says why not.
class Goals {
 public:
  void add(Goal goal) { all.push_back(std::move(goal)); }
  void leave_out(const std::string& id, const std::string& why) { left_out.emplace_back(id, why); }
  std::vector<Goal> all;
  std::vector<std::pair<std::string, std::string>> left_out;
};

// One for each room of goals.
void add_kernel_goals(const Tools& tools, Goals& goals);
void add_thread_goals(const Tools& tools, Goals& goals);
void add_light_goals(const Tools& tools, Goals& goals);
void add_scale_goals(const Tools& tools, Goals& goals);
void add_comparison_goals(const Tools& tools, Goals& goals);
void add_start_goals(const Tools& tools, Goals& goals);
void add_gallery_goals(const Tools& tools, Goals& goals);

}  // namespace lobelia::bench
