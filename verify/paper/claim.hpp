// A claim of the paper, and what came out when it was measured.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lobelia::paper {

enum class Verdict {
  kConfirmed,
  kNotReproduced,
  kFound  ///< the paper does not speak of it: found while measuring
};

/// Where the claims are that are called more-accurate.
inline constexpr char kConclusions[] =
    "conclusions: the models are more accurate than the classical ones";

/// "confirmed", "not reproduced", "found"
std::string_view name(Verdict verdict);

struct Figure {
  std::string what;  ///< "largest difference"
  double value = 0;
  std::string
      text;        ///< the value with as many digits as are worth saying: the same on every machine
  std::string at;  ///< where: "n = 1024, x = 3.5 degrees"; may be empty
};

struct Claim {
  std::string_view name;              ///< "cs16-largest-error"
  std::string_view where;             ///< in the paper
  std::string statement;              ///< in our words
  std::string printed;                ///< the figure or formula as printed; "" where there is none
  std::vector<Figure> measured = {};  ///< the first is the one that the verdict is about
  std::string definition = {};        ///< what was measured, and how
  Verdict verdict = Verdict::kFound;
  std::string reason = {};  ///< where one is known
};

/// "0.0907", "1.70e-2", "36.8": significant digits, no locale, nothing that is not ASCII.
std::string figure_text(double value, int digits);

Figure figure(std::string what, long double value, int digits, std::string at = "");
/// With a number of decimals: for what is near 1.
Figure fixed(std::string what, long double value, int decimals, std::string at = "");
/// For what is 0 but for rounding: "below 1e-15", where it is; the value itself, where it is not.
Figure vanishing(std::string what, long double value, double bound, std::string at = "");

/// "n = 208"
std::string at_exponent(long double n);

/// Whether `measured`, rounded as `printed` is, gives `printed`; `unit` is that of its last digit.
bool rounds_to(long double measured, double printed, double unit);
Verdict confirmed_if(bool holds);

}  // namespace lobelia::paper
