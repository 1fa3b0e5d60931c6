#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/records/record.hpp"
#include "profile/clipping.hpp"
#include "program/command/output_files.hpp"
#include "program/command/profile_report.hpp"

namespace lobelia::cli {
namespace {

std::string falloff_name(const records::Falloff& fit) {
  return fit.family == "gaussian" ? "a Gaussian" : "a GGX tail";
}

/// "1 : 0.82 : 0.41".
std::string colour_text(const records::Colour& colour) {
  if (std::isnan(colour.red)) return "-";
  return fmt::format("{:.3g} : {:.3g} : {:.3g}", colour.red, colour.green, colour.blue);
}

std::string clipped_text(const records::Clipping& clipped) {
  const records::Falloff& flank = clipped.flank;
  const std::string text =
      fmt::format("clipped: {} of its pixels have the picture's largest {}; peak at least {}",
                  clipped.pixels, either_of(clipped.channels), shown(clipped.peak_at_least));
  if (!flank.because.empty())
    return fmt::format("{}; its flank tells no more: {}", text, flank.because);
  return fmt::format("{}; from its flank about {}, if that is {}, but for {} of the peak", text,
                     with_error(flank.peak.value, flank.peak.standard_error), falloff_name(flank),
                     percent(flank.rms_of_peak));
}

/// "it falls off like a Gaussian, but for 0.02 % of its peak (a GGX tail: 4.2 %)".
std::string falloff_text(const std::vector<records::Falloff>& fits) {
  if (fits.empty() || !fits.front().because.empty()) return "";
  const records::Falloff &best = fits.front(), &other = fits.back();
  std::string text = fmt::format("it falls off like {}, but for {} of its peak", falloff_name(best),
                                 percent(best.rms_of_peak));
  if (fits.size() < 2 || !other.because.empty()) return text;
  // Squares of residuals that differ by less are decided by a few pixels.
  constexpr double kAlike = 1.02;
  const bool alike =
      other.rms_of_peak * other.peak.value < kAlike * best.rms_of_peak * best.peak.value;
  return text + (alike ? fmt::format(", or like {}", falloff_name(other))
                       : fmt::format(" ({}: {})", falloff_name(other), percent(other.rms_of_peak)));
}

/// One sentence a line on a picture's highlight.
std::vector<std::string> sentences_on(const records::BlobFigures& blob) {
  if (!blob.because.empty()) return {blob.because};
  std::vector<std::string> sentences;
  if (blob.clipped)
    sentences.push_back(clipped_text(*blob.clipped));
  else if (!std::isnan(blob.gaussian_sigma_pixels.major))
    sentences.push_back(fmt::format("as wide as a Gaussian of {} x {} pixels standard deviation",
                                    three_digits(blob.gaussian_sigma_pixels.major),
                                    three_digits(blob.gaussian_sigma_pixels.minor)));
  if (const std::string text = falloff_text(blob.falloff); !text.empty()) sentences.push_back(text);
  if (blob.clipped) return sentences;
  if (!blob.remark.empty())
    sentences.push_back(blob.remark);
  else if (const std::string remark = peak_remark(blob.peak); !remark.empty())
    sentences.push_back(remark);
  return sentences;
}

std::string picture_text(const std::string& name, const records::BlobPicture& picture,
                         double least_share) {
  std::string text = fmt::format(
      "{}: standard errors from {}\n", name,
      picture.standard_errors_from == "given" ? "the given noise" : "the scatter of its pixels");
  constexpr std::size_t kMostSpecks = 4;
  const std::span specks(picture.specks);
  text += specks_text(name, specks.first(std::min(kMostSpecks, specks.size())));
  if (const std::size_t more = specks.size() + picture.more_specks; more > kMostSpecks)
    text += fmt::format("{}: {} more such specks\n", name, more - kMostSpecks);
  if (picture.more_highlights > 0)
    text += fmt::format("{}: {} more highlights of at least {} of the brightest are not measured\n",
                        name, picture.more_highlights, percent(least_share));
  if (picture.may_have_more)
    text +=
        fmt::format("{}: too many peaks to look at each, so there may be more highlights\n", name);
  return text;
}

}  // namespace

std::string blobs_text(const records::Blobs& blobs) {
  std::vector<std::vector<std::string>> peaks = {
      {"highlight", "", "peak over background", "background", "at x", "y", "colour R : G : B"}};
  std::vector<std::vector<std::string>> widths = {{"half-width, pixels", "", "long axis",
                                                   "short axis", "along x", "y", "centroid x", "y",
                                                   "energy", "pixels"}};
  const bool nothing = std::ranges::all_of(
      blobs.highlights.front().images, [](const auto& one) { return !one.second.because.empty(); });
  std::string remarks, differences;
  for (const records::Blob& blob : blobs.highlights) {
    for (const auto& [name, b] : blob.images) {
      const std::string id = std::to_string(blob.id.value_or(1));
      if (b.because.empty()) {
        const records::BlobErrors& e = *b.standard_errors;
        peaks.push_back({id, name, with_error(b.peak.radiance, e.peak),
                         with_error(b.background, e.background), with_error(b.peak.x, e.place.x),
                         with_error(b.peak.y, e.place.y), colour_text(*b.colour)});
        widths.push_back(
            {id, name, with_error(b.half_width_pixels.major, e.half_width_pixels.major),
             with_error(b.half_width_pixels.minor, e.half_width_pixels.minor),
             three_digits(b.major_axis.x), three_digits(b.major_axis.y),
             with_error(b.centroid.x, e.centroid.x), with_error(b.centroid.y, e.centroid.y),
             with_error(b.energy, e.energy), std::to_string(b.pixels)});
      }
      for (const std::string& sentence : sentences_on(b))
        remarks += nothing ? fmt::format("{}: {}\n", name, sentence)
                           : fmt::format("{}, {}: {}\n", id, name, sentence);
    }
    const std::string table = differences_table(blob.differences);
    if (!table.empty()) differences += fmt::format("\nhighlight {}:{}", blob.id.value_or(1), table);
  }
  std::string text;
  for (const auto& [name, picture] : blobs.pictures)
    text += picture_text(name, picture, blobs.least_share);
  for (const auto& [name, b] : blobs.highlights.front().images)
    if (b.nonfinite > 0)
      text += fmt::format("{}: {} pixels are not finite and are left out\n", name, b.nonfinite);
  if (peaks.size() > 1) text += '\n' + aligned(peaks) + '\n' + aligned(widths);
  text += '\n' + remarks;
  if (!nothing) text += "An exponent needs to know which angle each pixel sees: --scene.\n";
  return text + differences;
}

std::string blobs_csv(const records::Blobs& blobs) {
  std::string text;
  for (const records::Blob& blob : blobs.highlights)
    for (const auto& [axis, curve] : blob.curves) {
      if (text.empty()) text = "highlight,axis,offsetPixels" + csv_head(curve.radiance);
      for (std::size_t i = 0; i < curve.offset_pixels.size(); ++i)
        text += fmt::format("{},{},{}", blob.id.value_or(1), axis,
                            records::json_number(curve.offset_pixels[i])) +
                csv_values(curve.radiance, i);
    }
  return text.empty() ? "highlight,axis,offsetPixels\n" : text;
}

std::string blobs_svg(const records::Blobs& blobs) {
  constexpr std::size_t kMostHighlights = 5;
  const bool single = blobs.highlights.size() == 1;
  const std::size_t count = std::min(kMostHighlights, blobs.highlights.size());
  Chart chart;
  chart.id = "blob";
  chart.title = single                            ? "The highlight, along its axes"
                : count < blobs.highlights.size() ? fmt::format(
                                                        "The {} brightest of {} highlights, along "
                                                        "their long axes",
                                                        count, blobs.highlights.size())
                                                  : "The highlights, along their long axes";
  chart.description = "Radiance over the distance from the peak.";
  chart.x = {"pixels from the reference's peak", -1, 1};
  std::size_t line = 0;
  for (std::size_t k = 0; k < count; ++k)
    for (const auto& [axis, curve] : blobs.highlights[k].curves) {
      if (!single && axis != "major") continue;
      chart.x.from = std::min(chart.x.from, curve.offset_pixels.front());
      chart.x.to = std::max(chart.x.to, curve.offset_pixels.back());
      for (const auto& [name, column] : curve.radiance)
        chart.series.push_back(
            {single ? fmt::format("{}, {} axis", name, axis == "major" ? "long" : "short")
                    : fmt::format("{}: {}", blobs.highlights[k].id.value_or(k + 1), name),
             curve.offset_pixels, column, style_of(line++)});
    }
  set_top(chart);
  return draw_chart_file(chart);
}

}  // namespace lobelia::cli
