// Who is compared with the analytic picture, and how near each is held to come.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "reference_scenes/engine.hpp"

namespace lobelia::agreement {

struct WitnessKind {
  std::string_view name;    ///< "povray_native_half"
  std::string_view title;   ///< "POV-Ray native, half"
  std::string_view engine;  ///< empty: ours
  bool fine = false;
  Witness witness = Witness::kAny;
};

inline constexpr WitnessKind kOurs{"ours", "Lobelia", ""};
/// The engines' witnesses. An engine's own formats are tried for in the order given.
std::span<const WitnessKind> witnesses();
/// Of the two engines told the same formula, the one directly against the other; no witness of ours.
inline constexpr WitnessKind kDirect{"povray_blender", "POV-Ray against Blender", ""};

struct Target {
  bool relative =
      false;  ///< of the largest relative difference; otherwise of the largest of the peak
  double limit = 0;
};
/// Nothing where no one has said how near it should come.
std::optional<Target> target_of(const WitnessKind& witness, double exponent);
/// Why a witness is farther off than its target where it is, as far as it is known; or empty.
std::string_view known_reason(const WitnessKind& witness);
/// "4.9e-4", "0", "inf"
std::string short_number(double value);
/// "4.9e-4 of the value"
std::string target_text(const Target& target);

}  // namespace lobelia::agreement
