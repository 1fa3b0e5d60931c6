// Messages on stderr: warnings, and how far long work has come.
#pragma once

#include <chrono>
#include <mutex>
#include <string_view>

#include "core/standard_streams.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cli {

void warn(std::string_view text);

/// Warns of each highlight and remark of a scene that is allowed and yet unusual, once.
void warn_of(const Scene& scene);
void warn_of(const Highlight& highlight);

class ProgressLine {
 public:
  /// Draws nothing unless `enabled`; where stderr is not a terminal, a plain line every 10 seconds.
  explicit ProgressLine(bool enabled);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// May be called often and from any thread.
  void show(double fraction, std::string_view what);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  bool enabled_, terminal_, drawn_ = false;
  Clock::time_point started_ = Clock::now(), last_drawn_ = started_;
};

}  // namespace lobelia::cli
