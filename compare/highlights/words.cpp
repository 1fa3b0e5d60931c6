#include "compare/highlights/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lobelia {
namespace {

constexpr std::size_t kMostInRecord = 32, kMostSaid = 8;

/// Two digits, or of 10 and more a whole number.
std::string short_number(double value) {
  return value < 10 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

/// "4 pixels", "1 pixel"
std::string pixels_text(double distance) {
  const std::string number = short_number(std::abs(distance));
  return number + (number == "1" ? " pixel" : " pixels");
}

/// A narrow highlight may lie on a broad one, and both have one brightest pixel.
bool has_narrower_on_it(const records::LocalHighlight& one,
                        std::span<const records::LocalHighlight> all) {
  return std::ranges::any_of(all, [&](const records::LocalHighlight& other) {
    return other.x == one.x && other.y == one.y && other.pixels < one.pixels;
  });
}

std::string sentence_on(const records::LocalHighlight& one,
                        std::span<const records::LocalHighlight> all) {
  if (one.only_in_a) return fmt::format("a has a highlight at ({}, {}) that b lacks", one.x, one.y);
  const std::string text = has_narrower_on_it(one, all)
                               ? fmt::format("the broader highlight around ({}, {})", one.x, one.y)
                               : name_of_highlight(one.x, one.y);
  if (one.gone) return text + " is gone";
  std::vector<std::string> parts;
  const auto per_cent = [](double share) { return short_number(100 * std::abs(share)); };
  // Smaller errors are said to be none.
  constexpr double kLeastShare = 0.001, kLeastShift = 0.05;
  if (std::abs(one.energy) >= kLeastShare)
    parts.push_back(fmt::format("has {} % {} {}{}light", per_cent(one.energy),
                                one.energy > 0 ? "more" : "less", one.channel,
                                one.channel.empty() ? "" : " "));
  if (std::abs(one.width) >= kLeastShare)
    parts.push_back(
        fmt::format("is {} % {}", per_cent(one.width), one.width > 0 ? "wider" : "narrower"));
  if (std::abs(one.shift_x) >= kLeastShift)
    parts.push_back(fmt::format("lies {} to the {}", pixels_text(one.shift_x),
                                one.shift_x > 0 ? "right" : "left"));
  if (std::abs(one.shift_y) >= kLeastShift)
    parts.push_back(
        fmt::format("lies {} {}", pixels_text(one.shift_y), one.shift_y > 0 ? "down" : "up"));
  return fmt::format("{} {}", text, fmt::join(parts, ", "));
}

}  // namespace

std::vector<records::LocalHighlight> highlights_record(std::span<const JudgedHighlight> judged) {
  std::vector<records::LocalHighlight> records;
  for (const auto& [highlight, errors] : judged.first(std::min(judged.size(), kMostInRecord)))
    records.push_back({highlight->x, highlight->y, highlight->peak, highlight->base,
                       std::int64_t(highlight->count), errors.gone, highlight->only_in_a,
                       errors.energy, errors.width, errors.shift_x, errors.shift_y,
                       errors.badness(), errors.energy_beyond, errors.width_beyond,
                       errors.shift_beyond,
                       std::string(errors.channel ? records::kChannels[*errors.channel] : "")});
  return records;
}

std::string name_of_highlight(int x, int y) {
  return fmt::format("the highlight at ({}, {})", x, y);
}

std::vector<std::string> sentences_on_highlights(
    std::span<const records::LocalHighlight> highlights) {
  std::vector<std::string> sentences;
  std::size_t more = 0;
  for (const records::LocalHighlight& one : highlights) {
    if (!(one.excess > 1)) continue;
    if (sentences.size() < kMostSaid)
      sentences.push_back(sentence_on(one, highlights));
    else
      ++more;
  }
  if (more > 0) sentences.push_back(fmt::format("{} more highlights differ", more));
  return sentences;
}

}  // namespace lobelia
