#include "reference_scenes/agreement/witness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lobelia::agreement {
namespace {

constexpr WitnessKind kWitnesses[] = {
    {"povray_native_half", "POV-Ray native, half", "povray", false, Witness::kNative},
    {"povray_native_float", "POV-Ray native, float", "povray", true, Witness::kNative},
    {"povray_expressed_half", "POV-Ray expressed, half", "povray", false, Witness::kExpressed},
    {"povray_expressed_float", "POV-Ray expressed, float", "povray", true, Witness::kExpressed},
    {"blender_expressed", "Blender expressed", "blender", false, Witness::kExpressed},
    {"blender_native", "Blender native", "blender", false, Witness::kNative},
};

/// Limits hold up to an exponent; the first that reaches far enough counts.
struct Limit {
  std::string_view witness;
  double up_to;
  Target target;
};
constexpr double kAnyExponent = kMaxExponent;
constexpr Limit kLimits[] = {
    {"ours", 1e6, {false, 1e-5}},
    {"povray_native_half", kAnyExponent, {true, 4.9e-4}},
    {"povray_native_float", kAnyExponent, {true, 2.3e-7}},
    {"povray_expressed_half", kAnyExponent, {true, 4.9e-4}},
    {"povray_expressed_float", kAnyExponent, {true, 2.3e-7}},
    {"blender_expressed", 1024, {false, 1.1e-5}},
    {"blender_expressed", 1e5, {false, 7e-5}},
    {"blender_native", 1024, {false, 1.3e-4}},
    {"blender_native", 1e5, {false, 3e-3}},
};

struct Reason {
  std::string_view witness, text;
};
constexpr std::string_view kTwoHalves =
    "Two half floats leave 2^-22 = 2.4e-7 of a value, and POV-Ray has colours in float32 on the way to "
    "each, with 6e-8 for every operation.";
constexpr Reason kReasons[] = {
    {"povray_native_float", kTwoHalves},
    {"povray_expressed_float", kTwoHalves},
    {"blender_expressed",
     "Cycles has the place of a point in float32, some 1e-7 of the sphere's radius off, and more where it is "
     "seen at a grazing angle, on a small sphere or from afar (5 radii in pictures of the whole sphere). The "
     "normal is as far off, the lobe's angle up to twice as far, and a lobe falls by up to 0.6 sqrt(n) of "
     "its peak per radian: 4e-5 at n = 1e5, before any of these."},
    {"blender_native",
     "Cycles' closure takes the n-th power of N.H, and a float32 below 1 is 6e-8 from the next: for each "
     "rounding n times that, 6e-3 of the value at n = 1e5. So far off, it is off in the ring, too."},
};

}  // namespace

std::span<const WitnessKind> witnesses() { return kWitnesses; }

std::optional<Target> target_of(const WitnessKind& witness, double exponent) {
  for (const Limit& limit : kLimits)
    if (limit.witness == witness.name && exponent <= limit.up_to) return limit.target;
  return std::nullopt;
}

std::string_view known_reason(const WitnessKind& witness) {
  const auto found = std::ranges::find(kReasons, witness.name, &Reason::witness);
  return found == std::end(kReasons) ? std::string_view() : found->text;
}

std::string short_number(double value) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return "inf";
  std::string text = fmt::format("{:.1e}", value);  // 4.9e-04
  const auto digits = text.find('e') + 2;
  while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  if (text[digits - 1] == '+') text.erase(digits - 1, 1);
  if (const auto zero = text.find(".0e"); zero != std::string::npos) text.erase(zero, 2);
  return text;
}

std::string target_text(const Target& target) {
  return fmt::format("{} of the {}", short_number(target.limit),
                     target.relative ? "value" : "peak");
}

}  // namespace lobelia::agreement
