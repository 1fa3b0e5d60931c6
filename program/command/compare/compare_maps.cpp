#include <map>
#include <mutex>

#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "base/system/standard_streams.hpp"
#include "compare/highlight_region.hpp"
#include "compare/maps/difference_map.hpp"
#include "program/command/compare/compare_pictures.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// A map's values in three equal channels.
Image grey_picture(std::span<const float> values, int width, int height) {
  Image image(width, height);
  for (std::size_t i = 0; i < values.size(); ++i)
    std::fill_n(image.values().begin() + std::ptrdiff_t(3 * i), 3, values[i]);
  return image;
}

/// The map; |A - B| for kChannels, which has the scale of its channels.
const DifferenceMap& map_of(const std::string& id) {
  return *find_difference_map(id == kChannels ? "abs" : id);
}

/// At the exposures of the pair, also if no metric asked for them.
PixelValues values_of(const std::string& id, const Image& a, const Image& b,
                      const Viewing& viewing) {
  return measure_difference_map(
      map_of(id), a, b, is_finite(a) && is_finite(b) ? with_exposures(viewing, a, b) : viewing);
}

void write_channels(const fs::path& path, const Image& a, const Image& b, double scale) {
  // A difference that is not finite is magenta.
  write_png(path, difference_picture(a, b, scale),
            {{"Description", fmt::format("|A - B| of R, G and B (radiance), 0 to {:.6g}", scale)},
             {"lobelia:difference", std::string(kChannels)},
             {"lobelia:unit", "radiance"},
             {"lobelia:scaleFrom", "0"},
             {"lobelia:scaleTo", fmt::format("{}", scale)},
             {"lobelia:notFinite", "#ff00ff"}});
  say("{}: white is a difference of {:.6g}\n", printable_path(path.string()), scale);
}

/// Says that there is no HDR-FLIP of this pair, if there is none.
bool lacks_exposures(const DifferenceMap& map, const Viewing& viewing, const fs::path& file) {
  const auto& range = viewing.hdr_exposures;
  if (!map.needs_exposures || (range && range->problem.empty())) return false;
  say("{}: not written: {}\n", printable_path(file.string()), range ? range->problem : "");
  return true;
}

ColourScale colour_scale(const DifferenceMap& map, const Viewing& viewing, double scale) {
  const auto& range = viewing.hdr_exposures;
  if (map.scale != MapScale::kExposures || !range) return scale;
  // If both ends are equal, every pixel has the first colour.
  return {range->start_stops, std::max(range->stop_stops, range->start_stops + 1e-3)};
}

}  // namespace

void DifferencePicture::add_to(CLI::App& command) {
  OptionGroup output(command, "Output");
  std::vector<std::string> maps{std::string(kChannels)};
  for (const std::string_view id : difference_map_names()) maps.emplace_back(id);
  auto* picture = output.add(
      "--diff-image", path, "FILE|DIR",
      "Write where the two differ, in colours (.png, with the scale in its metadata) or as values "
      "(.exr); of folders, a folder of .png");
  output
      .add_choice(
          "--diff-of", of, maps,
          "What it shows: channels is |A - B| of each in its own colour, the others are one "
          "value a pixel")
      ->needs(picture);
  output
      .add_choice(
          "--diff-colours", colour_map, {colour_map_names().begin(), colour_map_names().end()},
          fmt::format("Its colour map; default {}, of signed values {}, of exposures viridis",
                      kDefaultColourMap, kSignedColourMap))
      ->needs(picture);
  output
      .add("--diff-scale", scale, "NUMBER",
           "The difference that has the map's last colour; default: 1 for FLIP, else the largest "
           "of the pair, of folders of all pairs")
      ->check(CLI::PositiveNumber)
      ->needs(picture);
  output.add_flag("--diff-only-failed", only_failed, "Write none for a pair that passes")
      ->needs(picture);
}

void DifferencePicture::check(bool folders, bool has_exposures) const {
  if (path.empty()) return;
  if (map_of(of).needs_exposures && !has_exposures)
    throw Error(ExitCode::kUsage, "--diff-of {} needs --exposures", of);
  if (of == kChannels && !colour_map.empty())
    throw Error(ExitCode::kUsage,
                "--diff-colours is for one value a pixel; choose it with --diff-of");
  if (folders) return;
  const std::string ending = path.extension().string();
  if (ending != ".png" && !(ending == ".exr" && of != kChannels))
    throw Error(ExitCode::kUsage, "--diff-image {} must end in .png{}", path.string(),
                of == kChannels ? "" : " (colours) or .exr (values)");
}

bool DifferencePicture::has_own_scale() const {
  return scale > 0 || map_of(of).scale != MapScale::kLargest;
}

bool DifferencePicture::is_wanted(Verdict verdict) const {
  return !path.empty() && !(only_failed && is_pass(verdict));
}

double DifferencePicture::largest(const Image& a, const Image& b,
                                  const Comparison& comparison) const {
  return largest_magnitude(values_of(of, a, b, comparison.viewing));
}

void DifferencePicture::write(const fs::path& file, const Image& a, const Image& b,
                              const Comparison& comparison, std::optional<double> of_set) const {
  const DifferenceMap& map = map_of(of);
  if (lacks_exposures(map, comparison.viewing, file)) return;
  const PixelValues values = values_of(of, a, b, comparison.viewing);
  const double largest = largest_magnitude(values);
  double last = scale > 0 ? scale : map.scale == MapScale::kOne ? 1 : of_set.value_or(largest);
  if (!(last > 0)) last = 1;
  if (of == kChannels) {
    write_channels(file, a, b, last);
    return;
  }
  const std::string_view colours = !colour_map.empty()    ? std::string_view(colour_map)
                                   : !map.colours.empty() ? map.colours
                                   : map.is_signed        ? kSignedColourMap
                                                          : kDefaultColourMap;
  const ColourScale colour = colour_scale(map, comparison.viewing, last);
  if (file.extension() == ".exr")
    write_exr(file, grey_picture(values, a.width(), a.height()),
              {{"Description", fmt::format("{} ({})", map.meaning, map.unit)},
               {"lobelia:difference", std::string(map.id)},
               {"lobelia:unit", std::string(map.unit)}});
  else
    write_png(file, colour_picture(values, a.width(), a.height(), colour, colours),
              colour_metadata(map, colour, colours));
  say("{}: {} up to {:.6g}, the largest is {:.6g}\n", printable_path(file.string()), map.id,
      colour.to, largest);
}

SetReport compare_and_show(const CompareJob& job, const DifferencePicture& wanted,
                           const Pairing& pairing, const std::function<void(std::size_t)>& done) {
  if (wanted.path.empty()) return compare_pairs(job, pairing, done);
  const bool one = is_one_pair(pairing);
  const auto write = [&](const PairReport& pair, const Image& a, const Image& b,
                         std::optional<double> of_set) {
    const fs::path file = one ? wanted.path : difference_file(wanted.path, pair.name);
    if (!one) make_directories(file.parent_path());
    wanted.write(file, a, b, *pair.comparison, of_set);
  };
  const bool at_once = one || wanted.has_own_scale();
  // One scale for the set. If that is the largest difference, all pairs come first.
  std::mutex mutex;
  std::map<std::pair<std::size_t, std::size_t>, double> largest;  // by row and set
  SetReport report = compare_pairs(job, pairing, done,
                                   [&](const PairReport& pair, const Image& a, const Image& b) {
                                     if (!wanted.is_wanted(pair.verdict())) return;
                                     if (at_once) return write(pair, a, b, std::nullopt);
                                     const double own = wanted.largest(a, b, *pair.comparison);
                                     const std::lock_guard lock(mutex);
                                     largest[{pair.row, pair.set}] = own;
                                   });
  if (largest.empty()) return report;
  double of_set = -1;
  for (const auto& [place, own] : largest) of_set = std::max(of_set, own);
  for_each_pair(report.pairs.size(), [&](std::size_t i) {
    const PairReport& pair = report.pairs[i];
    const auto own_largest = largest.find({pair.row, pair.set});
    if (own_largest == largest.end() || !(own_largest->second >= 0)) return;
    const CompareJob own = job_of(job, pair.name);
    ComparisonOptions unused = own.comparison;
    PicturePair pictures = read_compared(pair, own, unused);
    if (allows_equal_nonfinite(own.comparison, pictures.b.source))
      clear_equal_nonfinite(pictures.a.image, pictures.b.image);
    write(pair, pictures.a.image, pictures.b.image, of_set);
  });
  return report;
}

std::string plain_id(const std::string& name) {
  constexpr std::size_t kLongest = 80;
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  std::string id = name.substr(0, kLongest);
  for (char& c : id)
    if (kPlain.find(c) == std::string_view::npos) c = '-';
  if (id == name && is_plain_name(id)) return id;
  constexpr std::size_t kDigits = 10;
  return "p" + id + "-" + hex(sha256(name)).substr(0, kDigits);
}

fs::path difference_file(const fs::path& path, const std::string& name) {
  constexpr std::size_t kLongest = 255;
  const fs::path own = name + ".png";
  // A table may name a pair anything.
  const bool is_inside = own.is_relative() && own == own.lexically_normal() &&
                         *own.begin() != ".." && own.filename().string().size() <= kLongest;
  return path / (is_inside ? own : fs::path(plain_id(name) + ".png"));
}

}  // namespace lobelia::cli
