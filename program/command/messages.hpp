// Messages on stderr: warnings, and how far long work has come.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "base/system/standard_streams.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cli {

void warn(std::string_view text);

/// --color auto, always or never for stdout. Auto colours on a terminal, unless $NO_COLOR is set (no-color.org).
void choose_colours(const std::string& choice);
bool stdout_has_colours();
/// With verdicts and counts of them ("2 failed") in colour, if stdout has colours: red, yellow or green.
std::string with_colours(const std::string& text);

/// Warns of each highlight and remark of a scene that is allowed and yet unusual, once.
void warn_of(const Scene& scene);
void warn_of(const Highlight& highlight);

class ProgressLine {
 public:
  /// Draws nothing with --quiet; where stderr is not a terminal, a plain line every 5 seconds.
  ProgressLine();
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
