#include "reference_scenes/agreement/witness.hpp"

#include <fmt/format.h>

#include <cmath>

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

}  // namespace

std::span<const WitnessKind> witnesses() { return kWitnesses; }

std::optional<Target> target_of(const WitnessKind& witness, double exponent) {
  for (const Limit& limit : kLimits)
    if (limit.witness == witness.name && exponent <= limit.up_to) return limit.target;
  return std::nullopt;
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
