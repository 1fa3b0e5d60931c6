#include "core/gain_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kXmp = "http://ns.adobe.com/xap/1.0/\0"sv, kMpf = "MPF\0"sv,
                           kIso = "urn:iso:std:iso:ts:21496:-1\0"sv,
                           kGainMapSpace = "http://ns.adobe.com/hdr-gain-map/1.0/";

/// The pictures that MPF lists besides the first, within the file.
std::vector<std::string_view> further_pictures(std::string_view jpeg) {
  std::vector<std::string_view> found;
  constexpr std::uint64_t kMostPictures = 16, kEntries = 0xb002, kEntrySize = 16;
  for (const std::string_view mpf : jpeg_segments(jpeg, kMpf)) {
    // As a TIFF. Offsets of pictures count from its beginning.
    const bool little = mpf.starts_with("II");
    const auto start = std::uint64_t(mpf.data() - jpeg.data());
    const std::uint64_t directory = number_at(mpf, 4, little);
    const std::uint64_t fields = directory < mpf.size() ? number_at(mpf, directory, little, 2) : 0;
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(fields, 64); ++i) {
      const std::uint64_t field = directory + 2 + 12 * i;
      if (number_at(mpf, field, little, 2) != kEntries) continue;
      const std::uint64_t count = number_at(mpf, field + 4, little) / kEntrySize,
                          entries = number_at(mpf, field + 8, little);
      for (std::uint64_t k = 1; k < std::min(count, kMostPictures); ++k) {
        const std::uint64_t size = number_at(mpf, entries + kEntrySize * k + 4, little),
                            at = start + number_at(mpf, entries + kEntrySize * k + 8, little);
        if (at < jpeg.size() && size <= jpeg.size() - at) found.push_back(jpeg.substr(at, size));
      }
    }
  }
  return found;
}

/// A property of the gain map: an attribute, an element, or an element with a list of three.
std::optional<std::array<double, 3>> property(const pugi::xml_node& description,
                                              const std::string& name) {
  std::vector<std::string> texts;
  if (const auto attribute = description.attribute(name.c_str())) {
    texts.emplace_back(attribute.value());
  } else if (const auto element = description.child(name.c_str())) {
    for (const auto& item : element.child("rdf:Seq").children("rdf:li"))
      texts.emplace_back(item.text().get());
    if (texts.empty()) texts.emplace_back(element.text().get());
  }
  std::array<double, 3> values{};
  if (texts.size() != 1 && texts.size() != 3) return std::nullopt;
  for (std::size_t c = 0; c < 3; ++c)
    if (!parse_number(texts[std::min(c, texts.size() - 1)], values[c])) return std::nullopt;
  return values;
}

/// What is said of gain maps in XMP.
struct Xmp {
  pugi::xml_document document;
  pugi::xml_node description;  ///< null: nothing is said
  std::string prefix;

  explicit Xmp(std::string_view jpeg) {
    for (const std::string_view packet : jpeg_segments(jpeg, kXmp)) {
      if (description || packet.find(kGainMapSpace) == packet.npos) continue;
      document.load_buffer(packet.data(), packet.size());
      description = document.find_node([&](const pugi::xml_node& node) {
        if (std::string_view(node.name()) != "rdf:Description") return false;
        prefix = prefix_of(node);
        return !prefix.empty() && !node.attribute((prefix + "Version").c_str()).empty();
      });
    }
  }

 private:
  /// "hdrgm:", as the node or one around it declares it.
  static std::string prefix_of(pugi::xml_node node) {
    constexpr std::string_view kDeclares = "xmlns:";
    for (; node; node = node.parent())
      for (const auto& attribute : node.attributes())
        if (attribute.value() == kGainMapSpace &&
            std::string_view(attribute.name()).starts_with(kDeclares))
          return std::string(attribute.name()).substr(kDeclares.size()) + ":";
    return "";
  }
};

/// Nothing if the XMP lacks the largest gain: it is not that of a map.
std::optional<GainMap> by_xmp(const Xmp& xmp) {
  const auto get = [&](const char* name) { return property(xmp.description, xmp.prefix + name); };
  const auto largest = get("GainMapMax");
  if (!largest) return std::nullopt;
  constexpr double kOffset = 1.0 / 64;
  const std::array<double, 3> none{}, one{1, 1, 1}, offset{kOffset, kOffset, kOffset};
  GainMap gain;
  gain.max = *largest;
  gain.min = get("GainMapMin").value_or(none);
  gain.gamma = get("Gamma").value_or(one);
  gain.offset_base = get("OffsetSDR").value_or(offset);
  gain.offset_hdr = get("OffsetHDR").value_or(offset);
  gain.base_is_hdr =
      lower_case(xmp.description.attribute((xmp.prefix + "BaseRenditionIsHDR").c_str()).value()) ==
      "true";
  if (gain.base_is_hdr) std::swap(gain.offset_base, gain.offset_hdr);
  return gain;
}

/// ISO 21496-1, annex C.2. Nothing if the data are too short for a map's: the base picture has a version alone.
std::optional<GainMap> by_iso(const std::filesystem::path& path, std::string_view data) {
  if (data.size() < 5) return std::nullopt;
  if (number_at(data, 0, false, 2) != 0)
    unreadable_picture(path, "its gain map is of a later version of ISO 21496-1");
  const auto flags = static_cast<unsigned char>(data[4]);
  const bool three = (flags & 0x80) != 0, in_base_colours = (flags & 0x40) != 0,
             one_denominator = (flags & 8) != 0;
  if (three && !in_base_colours)
    unreadable_picture(path,
                       "its gain map is for the colour space of the HDR picture; only one for that "
                       "of the base picture is read");
  std::size_t at = 5;
  const auto take = [&] {
    at += 4;
    return number_at(data, at - 4, false);
  };
  const double common = one_denominator ? double(take()) : 0;
  const auto fraction = [&](bool is_signed) {
    const std::uint64_t bits = take();
    const double number = is_signed ? double(std::int32_t(std::uint32_t(bits))) : double(bits);
    return number / (one_denominator ? common : double(take()));
  };
  fraction(false);  // the headroom of the base and of the HDR picture
  fraction(false);
  GainMap gain;
  for (std::size_t c = 0; c < 3; ++c) {
    if (c > 0 && !three) {
      for (auto* values : {&gain.min, &gain.max, &gain.gamma, &gain.offset_base, &gain.offset_hdr})
        (*values)[c] = (*values)[0];
      continue;
    }
    gain.min[c] = fraction(true);
    gain.max[c] = fraction(true);
    gain.gamma[c] = fraction(false);
    gain.offset_base[c] = fraction(true);
    gain.offset_hdr[c] = fraction(true);
  }
  if (at > data.size()) unreadable_picture(path, "the numbers of its gain map are cut off");
  gain.base_is_hdr = (flags & 4) != 0;
  return gain;
}

bool is_possible(const GainMap& gain) {
  constexpr double kMostGain = 32, kLeastGamma = 0.01, kMostGamma = 100, kMostOffset = 16;
  for (std::size_t c = 0; c < 3; ++c)
    if (!(std::abs(gain.min[c]) <= kMostGain && std::abs(gain.max[c]) <= kMostGain &&
          gain.min[c] <= gain.max[c] && gain.gamma[c] >= kLeastGamma &&
          gain.gamma[c] <= kMostGamma && std::abs(gain.offset_base[c]) <= kMostOffset &&
          std::abs(gain.offset_hdr[c]) <= kMostOffset))
      return false;
  return true;
}

/// The two pixels around a place on one axis, and the weight of the second.
struct Between {
  int first, second;
  double weight;
};

Between between(int pixel, int size, int map_size) {
  const double place = (pixel + 0.5) * map_size / size - 0.5, below = std::floor(place);
  const auto inside = [&](double at) { return int(std::clamp(at, 0.0, double(map_size - 1))); };
  return {inside(below), inside(below + 1), place - below};
}

}  // namespace

std::optional<GainMap> find_gain_map(const std::filesystem::path& path, std::string_view jpeg) {
  if (!jpeg.starts_with("\xff\xd8")) return std::nullopt;
  const auto checked = [&](GainMap gain, std::string_view file) {
    if (!is_possible(gain)) unreadable_picture(path, "the numbers of its gain map are impossible");
    gain.jpeg = file;
    return gain;
  };
  for (const std::string_view file : further_pictures(jpeg)) {
    if (const Xmp xmp(file); xmp.description)
      if (const auto gain = by_xmp(xmp)) return checked(*gain, file);
    for (const std::string_view data : jpeg_segments(file, kIso))
      if (const auto gain = by_iso(path, data)) return checked(*gain, file);
  }
  if (Xmp(jpeg).description || !jpeg_segments(jpeg, kIso).empty())
    unreadable_picture(path,
                       "it says that it has a gain map, which is not there; --base-only reads the "
                       "picture without it");
  return std::nullopt;
}

void apply_gain(const GainMap& gain, const Image& map, const RgbMatrix& to_rec709, Image& light) {
  const RgbMatrix from_rec709 = inverse(to_rec709);
  apply(from_rec709, light);
  for (int y = 0; y < light.height(); ++y) {
    const Between rows = between(y, light.height(), map.height());
    for (int x = 0; x < light.width(); ++x) {
      const Between columns = between(x, light.width(), map.width());
      for (std::size_t c = 0; c < 3; ++c) {
        const auto row = [&](int at) {
          const double first = double(map.pixel(columns.first, at)[c]);
          return first + (double(map.pixel(columns.second, at)[c]) - first) * columns.weight;
        };
        const double above = row(rows.first);
        const double value = above + (row(rows.second) - above) * rows.weight;
        const double share = std::pow(std::max(value, 0.0), 1 / gain.gamma[c]);
        const double boost = gain.min[c] + (gain.max[c] - gain.min[c]) * share;
        float& target = light.pixel(x, y)[c];
        target =
            float((double(target) + gain.offset_base[c]) * std::exp2(boost) - gain.offset_hdr[c]);
      }
    }
  }
  apply(to_rec709, light);
}

}  // namespace lobelia
