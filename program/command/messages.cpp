#include "program/command/messages.hpp"

#include <fmt/color.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>

#include "base/words/text.hpp"
#include "program/command/common_options.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cli {
namespace {

constexpr int kBarWidth = 24;

std::string g_colours = "auto";

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(2, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80u;
}

/// "3 s", "2 min 10 s", "1 h 5 min"
std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

void choose_colours(const std::string& choice) { g_colours = choice; }

bool stdout_has_colours() {
  const char* no = std::getenv("NO_COLOR");
  return g_colours == "always" ||
         (g_colours == "auto" && ::isatty(STDOUT_FILENO) == 1 && !(no && *no));
}

std::string with_colours(const std::string& text) {
  if (!stdout_has_colours()) return text;
  // A verdict stands behind a colon or a count, or begins a line.
  static const std::regex verdicts(
      "(^|\\n|: |\\b[1-9][0-9]* )(pass|confirmed|failed|differs?|damaged|missing|outside|not "
      "reproduced|undecided|not compared)\\b");
  static const std::regex good("pass|confirmed"), open("undecided|not compared");
  std::string painted;
  auto rest = text.cbegin();
  for (std::sregex_iterator it(text.begin(), text.end(), verdicts), end; it != end; ++it) {
    const std::string word = (*it)[2];
    const auto colour = std::regex_match(word, good)   ? fmt::terminal_color::green
                        : std::regex_match(word, open) ? fmt::terminal_color::yellow
                                                       : fmt::terminal_color::red;
    painted.append(rest, (*it)[2].first);
    painted += fmt::format(fmt::fg(colour), "{}", word);
    rest = (*it)[2].second;
  }
  return painted.append(rest, text.cend());
}

void warn(std::string_view text) { say("lobelia: warning: {}\n", printable(text, 2000)); }

void warn_of(const Scene& scene) {
  std::set<std::string> lines;
  for (const Material& material : scene.materials) lines.insert(warning(material.highlight));
  lines.erase("");
  for (const std::string& line : lines) warn(line);
  for (const std::string& line : remarks(scene)) warn(line);
}

void warn_of(const Highlight& highlight) {
  if (const std::string line = warning(highlight); !line.empty()) warn(line);
}

ProgressLine::ProgressLine() : enabled_(!verbosity().quiet), terminal_(::isatty(2) == 1) {}

void ProgressLine::show(double fraction, std::string_view what) {
  if (!enabled_) return;
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  const std::chrono::duration<double> since = now - last_drawn_, elapsed = now - started_;
  if (since.count() < (terminal_ ? 0.1 : 5.0) && !(terminal_ && !drawn_)) return;
  last_drawn_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double left = fraction > 0 ? elapsed.count() * (1 - fraction) / fraction : 0;
  const std::string time = fraction > 0.01 ? duration_text(left) + " left" : "";
  if (!terminal_) {
    write_message_if_room(fmt::format("{:3.0f} %  {}  {}\n", 100 * fraction, what, time));
    return;
  }
  const int filled = int(kBarWidth * fraction);
  std::string line = fmt::format("[{:#<{}}{: <{}}] {:3.0f} %  {}  {}", "", filled, "",
                                 kBarWidth - filled, 100 * fraction, time, what);
  if (const std::size_t width = terminal_width() - 1; line.size() > width) line.resize(width);
  write_message_if_room("\r\x1b[K" + line);
  drawn_ = true;
}

void ProgressLine::clear() {
  const std::scoped_lock lock(mutex_);
  if (drawn_) write_message_if_room("\r\x1b[K");
  drawn_ = false;
}

}  // namespace lobelia::cli
