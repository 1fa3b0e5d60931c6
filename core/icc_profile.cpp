// ICC.1:2022: header 7.2, tags 7.3, XYZ 10.31, curves 10.6 and 10.18.
#include "core/icc_profile.hpp"

#include <cmath>
#include <optional>
#include <string_view>

#include "core/colour.hpp"

namespace lobelia {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint32_t number(Bytes bytes, std::size_t at, std::size_t size = 4) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | (at + i < bytes.size() ? bytes[at + i] : 0u);
  return value;
}

double fixed(Bytes bytes, std::size_t at) {
  return double(std::int32_t(number(bytes, at))) / 65536;
}

/// A tag's or a field's name of four letters.
bool is_at(Bytes bytes, std::size_t at, std::string_view name) {
  for (std::size_t i = 0; i < 4; ++i)
    if (at + i >= bytes.size() || bytes[at + i] != std::uint8_t(name[i])) return false;
  return true;
}

std::optional<Bytes> find_tag(Bytes profile, std::string_view name) {
  constexpr std::size_t kTags = 128, kMostTags = 1000;
  const std::size_t count = number(profile, kTags);
  for (std::size_t i = 0; i < count && i < kMostTags; ++i) {
    const std::size_t entry = kTags + 4 + 12 * i;
    if (!is_at(profile, entry, name)) continue;
    const std::size_t at = number(profile, entry + 4), size = number(profile, entry + 8);
    if (at > profile.size() || size > profile.size() - at || size < 12) return std::nullopt;
    return profile.subspan(at, size);
  }
  return std::nullopt;
}

bool is_near_primary(Bytes profile, std::string_view name, double x, double y, double z) {
  const auto tag = find_tag(profile, name);
  if (!tag || !is_at(*tag, 0, "XYZ ") || tag->size() < 20) return false;
  constexpr double kNear = 0.003;
  return std::abs(fixed(*tag, 8) - x) < kNear && std::abs(fixed(*tag, 12) - y) < kNear &&
         std::abs(fixed(*tag, 16) - z) < kNear;
}

/// NaN where it is not known.
double parametric(Bytes tag, double value) {
  const std::size_t type = number(tag, 8, 2);
  constexpr std::size_t kParameters[] = {1, 3, 4, 5, 7};
  if (type >= std::size(kParameters) || tag.size() < 12 + 4 * kParameters[type]) return NAN;
  double p[7] = {1, 1, 0, 0, 0, 0, 0};  // g, a, b, c, d, e, f
  for (std::size_t i = 0; i < kParameters[type]; ++i) p[i] = fixed(tag, 12 + 4 * i);
  const auto [g, a, b, c, d, e, f] = p;
  if (type == 0) return std::pow(value, g);
  if (type <= 2)
    return value >= -b / a ? std::pow(a * value + b, g) + (type == 2 ? c : 0) : type == 2 ? c : 0;
  return value >= d ? std::pow(a * value + b, g) + (type == 4 ? e : 0)
                    : c * value + (type == 4 ? f : 0);
}

double curve(Bytes tag, double value) {
  if (is_at(tag, 0, "para")) return parametric(tag, value);
  if (!is_at(tag, 0, "curv")) return NAN;
  const std::size_t count = number(tag, 8);
  if (count == 0) return value;
  if (count == 1) return std::pow(value, number(tag, 12, 2) / 256.0);
  if ((tag.size() - 12) / 2 < count) return NAN;
  const double place = value * double(count - 1);
  const auto below = std::size_t(place);
  const double low = number(tag, 12 + 2 * below, 2), high = number(tag, 14 + 2 * below, 2);
  return (low + (high - low) * (place - double(below))) / 65535;
}

bool is_srgb_curve(Bytes profile, std::string_view name) {
  const auto tag = find_tag(profile, name);
  if (!tag) return false;
  constexpr double kNear = 0.002;
  for (const float value : {0.1f, 0.5f, 0.9f})
    if (!(std::abs(curve(*tag, value) - srgb_decoded(value)) < kNear)) return false;
  return true;
}

}  // namespace

bool is_srgb_profile(Bytes profile) {
  if (is_at(profile, 16, "GRAY")) return is_srgb_curve(profile, "kTRC");
  return is_at(profile, 16, "RGB ") && is_near_primary(profile, "rXYZ", 0.4360, 0.2225, 0.0139) &&
         is_near_primary(profile, "gXYZ", 0.3851, 0.7169, 0.0971) &&
         is_near_primary(profile, "bXYZ", 0.1431, 0.0606, 0.7141) &&
         is_srgb_curve(profile, "rTRC") && is_srgb_curve(profile, "gTRC") &&
         is_srgb_curve(profile, "bTRC");
}

}  // namespace lobelia
