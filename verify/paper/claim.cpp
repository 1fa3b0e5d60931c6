#include "verify/paper/claim.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lobelia::paper {

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kConfirmed:
      return "confirmed";
    case Verdict::kNotReproduced:
      return "not reproduced";
    case Verdict::kFound:
      return "found";
  }
  return "";
}

std::string figure_text(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value);
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const auto e = scientific.find('e');
  const int power = std::stoi(scientific.substr(e + 1));  // after rounding: 0.9996 is 1.00
  if (power < -1 || power >= 6) return scientific.substr(0, e) + fmt::format("e{}", power);
  return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - power));
}

Figure figure(std::string what, long double value, int digits, std::string at) {
  const auto number = static_cast<double>(value);
  return {std::move(what), number, figure_text(number, digits), std::move(at)};
}

Figure fixed(std::string what, long double value, int decimals, std::string at) {
  const auto number = static_cast<double>(value);
  return {std::move(what), number, fmt::format("{:.{}f}", number, decimals), std::move(at)};
}

Figure vanishing(std::string what, long double value, double bound, std::string at) {
  const auto number = static_cast<double>(value);
  if (!(std::abs(number) < bound)) return figure(std::move(what), value, 3, std::move(at));
  return {std::move(what), number, "below " + figure_text(bound, 1), std::move(at)};
}

std::string at_exponent(long double n) { return fmt::format("n = {:.0f}", double(n)); }

bool rounds_to(long double measured, double printed, double unit) {
  return std::abs(measured - static_cast<long double>(printed)) <=
         static_cast<long double>(unit) / 2;
}

Verdict confirmed_if(bool holds) { return holds ? Verdict::kConfirmed : Verdict::kNotReproduced; }

}  // namespace lobelia::paper
