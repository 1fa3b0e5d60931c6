// The exposures and the viewer as a user writes them.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/pictures/colour.hpp"
#include "base/words/choice.hpp"
#include "compare/set/choice.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kAuto = "auto";

/// A number, or "auto"; whether it is a number.
bool parse_end(const std::string& text, double& stops, bool& good) {
  if (text == kAuto) return false;
  good = good && parse_number(text, stops);
  return true;
}

HdrExposures parse_exposures(const std::string& text) {
  HdrExposures range;
  std::vector<std::string> parts = split(text, ",");
  if (parts.size() == 1 && parts[0] == kAuto) parts.emplace_back(kAuto);
  bool good = parts.size() == 2 || parts.size() == 3;
  if (good) {
    range.given_start = parse_end(parts[0], range.start_stops, good);
    range.given_stop = parse_end(parts[1], range.stop_stops, good);
    // The ends that are not given come from the reference, once it is read.
    range.automatic = !range.given_start || !range.given_stop;
    if (!range.given_start) range.start_stops = range.stop_stops;
    if (!range.given_stop) range.stop_stops = range.start_stops;
    long long count = 2;
    range.given_count = parts.size() == 3;
    if (range.given_count)
      good = good && parse_integer(parts[2], count);
    else
      count = count_of_exposures(range.start_stops, range.stop_stops);
    range.count = int(std::clamp<long long>(count, 0, kMaxHdrExposures + 1));
  }
  if (!good)
    throw Error(ExitCode::kUsage,
                "--exposures {}: expected START,STOP or START,STOP,COUNT, where START and "
                "STOP are stops or auto; for example -6,2 or auto,4 or auto",
                printable(text));
  return range;
}

}  // namespace

CompareChoice plain_choice(double exposure_stops) {
  CompareChoice choice;
  choice.exposure = fmt::format("{}", exposure_stops);
  choice.ocio = kOwnConfig;
  return choice;
}

void choose_viewing(const CompareChoice& choice, Viewing& viewing) {
  const std::string& exposure = choice.exposure;
  viewing.automatic = exposure.empty() || exposure == kAuto;
  if (!viewing.automatic && !parse_number(exposure, viewing.exposure_stops))
    throw Error(ExitCode::kUsage, "--exposure {}: expected stops, for example -2, or auto",
                printable(exposure));
  if (!choice.exposures.empty()) {
    viewing.hdr_exposures = parse_exposures(choice.exposures);
    viewing.hdr_exposures->curve = *find_id<ToneCurve>(kToneCurveNames, choice.tone_curve);
  }
  viewing.pixels_per_degree = choice.pixels_per_degree;
  const double distance = choice.display_distance, width = choice.display_width,
               pixels = choice.display_pixels;
  const CompareChoice usual;
  if (distance != usual.display_distance || width != usual.display_width ||
      pixels != usual.display_pixels)
    viewing.pixels_per_degree = distance * (pixels / width) * std::numbers::pi / 180;
}

}  // namespace lobelia
