#include <numbers>

#include "cli/compare_pictures.hpp"
#include "cli/options.hpp"

namespace lobelia::cli {
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
    // What is free comes from the reference, once it is read.
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
    throw Error(
        ExitCode::kUsage,
        fmt::format("--exposures {}: expected START,STOP or START,STOP,COUNT, where START and "
                    "STOP are stops or auto; for example -6,2 or auto,4 or auto",
                    printable(text)));
  return range;
}

}  // namespace

void ViewingFlags::add_to(CLI::App& command, Viewing& viewing) {
  OptionGroup look(command, "Viewing");
  exposure_option_ =
      look.add(
              "--exposure", exposure_, "STOPS|auto",
              "Exposure at which the perceptual metrics look at the pictures, HDR-FLIP excepted; with "
              "auto it is 0 for what a display can show, and otherwise two that show the peak of the "
              "highlight and its tail, of which the worse counts")
          ->capture_default_str();
  auto* exposures = look.add(
      "--exposures", exposures_, "START,STOP[,COUNT]|auto",
      "Measure HDR-FLIP over COUNT exposures from START to STOP, in stops; one for each stop if there "
      "is no COUNT. Auto in place of START, STOP or both: what the reference alone suggests");
  look.add_choice("--tone-curve", tone_curve_,
                  {std::begin(kToneCurveNames) + 1, std::end(kToneCurveNames)},
                  "The curve that these exposures are shown through")
      ->needs(exposures);
  auto* degrees = look.add_number(
      "--pixels-per-degree", viewing.pixels_per_degree, kMinPixelsPerDegree, kMaxPixelsPerDegree,
      "How many pixels of the display a degree of the viewer's eye sees, for FLIP");
  degrees->type_name("NUMBER");
  const auto add = [&](const char* name, double& value, double most, const char* help) {
    look.add_number(name, value, 1e-3, most, help)->type_name("NUMBER")->excludes(degrees);
  };
  add("--display-distance", distance_, 1e3,
      "Metres from the viewer to the display: this and the next two in place of --pixels-per-degree");
  add("--display-width", width_, 1e3, "Metres that the display is wide");
  add("--display-pixels", pixels_, 1e6, "Pixels that the display is wide");
}

void ViewingFlags::suggest_exposure(const std::string& exposure) {
  if (!exposure.empty() && exposure_option_->count() == 0) exposure_ = exposure;
}

void ViewingFlags::apply(Viewing& viewing) const {
  viewing.automatic = exposure_ == kAuto;
  if (!viewing.automatic && !parse_number(exposure_, viewing.exposure_stops))
    throw Error(ExitCode::kUsage,
                fmt::format("--exposure {}: expected stops, for example -2, or auto",
                            printable(exposure_)));
  if (!exposures_.empty()) {
    viewing.hdr_exposures = parse_exposures(exposures_);
    viewing.hdr_exposures->curve = *find_id<ToneCurve>(kToneCurveNames, tone_curve_);
  }
  const ViewingFlags usual;
  if (distance_ != usual.distance_ || width_ != usual.width_ || pixels_ != usual.pixels_)
    viewing.pixels_per_degree = distance_ * (pixels_ / width_) * std::numbers::pi / 180;
}

}  // namespace lobelia::cli
