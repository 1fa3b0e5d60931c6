// One line on stderr that shows how far long work has come.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace lobelia::cli {

class ProgressLine {
 public:
  /// Draws nothing unless `enabled`; where stderr is not a terminal, a plain line every 10 seconds.
  explicit ProgressLine(bool enabled);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// May be called from any thread and as often as one likes.
  void show(double fraction, std::string_view what);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  bool enabled_, terminal_, drawn_ = false;
  Clock::time_point started_ = Clock::now(), last_drawn_ = started_;
};

/// "3 s", "2 min 10 s", "1 h 5 min"
std::string duration_text(double seconds);

}  // namespace lobelia::cli
