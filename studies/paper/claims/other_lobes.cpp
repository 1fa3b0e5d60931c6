// Schlick's lobe and the Gaussian, beside cos^n.
#include "studies/paper/energy.hpp"
#include "studies/paper/search.hpp"

namespace lobelia::paper {
namespace {

constexpr int kLobeAngles = 100;

/// The angle at which cos^n x has fallen to `level`.
Real cosine_reach(Real n, Real level) { return std::acos(std::pow(level, 1 / n)); }
/// The same for Schlick's lobe: c/(n - n c + c) = level.
Real schlick_reach(Real n, Real level) { return std::acos(n / (1 / level - 1 + n)); }
/// The inflection of cos^n x: tan^2 x = 1/(n - 1).
Real inflection(Real n) { return std::atan(1 / std::sqrt(n - 1)); }

using Zone = Real (*)(Real n);
Real half_of_peak(Real n) { return cosine_reach(n, 0.5L); }
Real nine_tenths_of_peak(Real n) { return cosine_reach(n, 0.9L); }
Real hemisphere(Real) { return kRightAngle - 1e-6L; }

enum class Of { kPeak, kLocal };

/// The largest |lobe - cos^n| inside a zone, over the exponents of the paper.
template <class OtherLobe>
Extreme largest_error(OtherLobe other, Zone zone, Of of) {
  return largest_over_n([&](Real n) {
    return largest(
               [&](Real x) {
                 const Real reference = cosine_lobe(x, n);
                 return std::abs(other(x, n) - reference) / (of == Of::kLocal ? reference : 1);
               },
               0, zone(n), kLobeAngles)
        .value;
  });
}

constexpr char kSchlick[] = "text on Schlick's lobe";

Figure schlick_error(const char* what, Zone zone, Of of) {
  return figure(what, largest_error(schlick_lobe, zone, of), 3);
}

}  // namespace

Claim schlick_epicentre() {
  Claim claim{
      "schlick-epicentre", kSchlick,
      "in the epicentre, to half of the peak, the largest relative error of Schlick's lobe is within 10 %",
      "10 %"};
  claim.measured = {
      schlick_error("to half of the peak, of the local value", half_of_peak, Of::kLocal),
      schlick_error("to 9/10 of the peak, of the local value", nine_tenths_of_peak, Of::kLocal),
      schlick_error("to half of the peak, of the peak", half_of_peak, Of::kPeak),
      schlick_error("anywhere, of the peak", hemisphere, Of::kPeak)};
  claim.definition =
      "largest |Schlick - cos^n| / cos^n, n = 16..1024. The paper does not say where the epicentre ends; "
      "here, as in `lobelia profile`, at half of the peak of cos^n";
  claim.verdict = confirmed_if(claim.measured[0].value <= 0.1);
  claim.reason =
      "it holds up to the inflection (schlick-epicentre-inflection). To half of the peak it holds only for "
      "the error as a share of the peak";
  return claim;
}

Claim schlick_epicentre_inflection() {
  Claim claim{
      "schlick-epicentre-inflection", kSchlick,
      "in the epicentre, to the inflection, the largest relative error of Schlick's lobe is within 10 %",
      "10 %"};
  claim.measured = {schlick_error("to the inflection, of the local value", inflection, Of::kLocal),
                    schlick_error("to the inflection, of the peak", inflection, Of::kPeak)};
  claim.definition =
      "as for schlick-epicentre, but the epicentre ends at the inflection of cos^n, tan^2 x = 1/(n - 1), "
      "about 0.6 of the peak";
  claim.verdict = confirmed_if(claim.measured[0].value <= 0.1);
  claim.reason = "within a tenth of a per cent. The paper may have found the figure in this way";
  return claim;
}

Claim schlick_tail() {
  Claim claim{"schlick-tail", kSchlick, "in the blooming zone Schlick's lobe falls far too slowly",
              ""};
  for (const Real n : {16.0L, 1024.0L}) {
    const Real schlick = schlick_reach(n, 1 / 255.0L), cosine = cosine_reach(n, 1 / 255.0L);
    const std::string at = at_exponent(n);
    const auto add = [&](const char* what, Real value) {
      claim.measured.push_back(figure(what, value, 3, at));
    };
    add("its reach over that of cos^n", schlick / cosine);
    add("Schlick's reach in degrees", degrees(schlick));
    add("that of cos^n", degrees(cosine));
    add("solid angle over that of cos^n", versine(schlick) / versine(cosine));
    add("energy over that of cos^n", schlick_integral(n) * (n + 1) / (2 * kPi));
  }
  claim.definition =
      "reach is the angle where the lobe has fallen to 1/255 of its peak, the least that an 8-bit display "
      "shows; energy is the integral of lobe(x) sin x. Confirmed if the reach is more than 1.5 times as "
      "long; no figure is printed";
  claim.verdict = confirmed_if(claim.measured[0].value > 1.5 && claim.measured[5].value > 1.5);
  claim.reason = "it falls as 1/(n x^2/2), cos^n as exp(-n x^2/2)";
  return claim;
}

Claim gauss_accuracy() {
  const Extreme epicentre = largest_error(gauss_lobe, half_of_peak, Of::kPeak);
  const Extreme anywhere = largest_error(gauss_lobe, hemisphere, Of::kPeak);
  const Extreme at_1024 = largest_difference(gauss_lobe, kLastExponent, kRightAngle);
  const auto times = [](Real n) {
    const Real x = cosine_reach(n, 1 / 255.0L);
    return gauss_lobe(x, n) / cosine_lobe(x, n);
  };
  Claim claim{"gauss-accuracy", "text on the Gaussian lobe",
              "exp(-n x^2/2) is accurate in the epicentre and in the tail", ""};
  claim.measured = {figure("largest difference from cos^n", anywhere, 3),
                    figure("the same", at_1024.value, 2, "n = 1024"),
                    figure("in the epicentre", epicentre, 2),
                    figure("times too bright where cos^n is 1/255", times(16), 3, "n = 16"),
                    figure("the same", times(kLastExponent), 3, "n = 1024")};
  claim.definition =
      "absolute difference, a share of the peak; the epicentre is where cos^n is at least half of it. "
      "Confirmed if nowhere worse than cs16's 1.7e-2; no figure is printed";
  claim.verdict = confirmed_if(anywhere.value <= 1.7e-2L);
  claim.reason =
      "it differs from cos^n by the factor exp(n x^4/12). At small n the tail is nearly twice as bright as "
      "it should be";
  return claim;
}

Claim gauss_angle() {
  // Light and eye at 45 degrees on either side of the normal, which then is H.
  const Real of_h_and_l = kPi / 4, of_n_and_h = 0;
  Claim claim{"gauss-angle", "formula of the Gaussian lobe",
              "the angle of exp(-n x^2/2) is that of H and L", "angle of H and L"};
  claim.measured = {
      figure("lobe in the mirror direction, light at 45 degrees", gauss_lobe(of_h_and_l, 16), 3,
             "n = 16"),
      figure("the same with the angle of N and H", gauss_lobe(of_n_and_h, 16), 3, "n = 16")};
  claim.definition =
      "the lobe for light at 45 degrees, seen from the mirror direction, where a highlight has its peak. "
      "Confirmed if it is 1";
  claim.verdict = confirmed_if(claim.measured[0].value == 1);
  claim.reason =
      "a misprint for N and H. The angle of H and L is half of that of L and V, so the lobe would be "
      "largest with the eye at the light, whatever the normal";
  return claim;
}

Claim more_accurate_lobe() {
  const Extreme schlick = largest_error(schlick_lobe, hemisphere, Of::kPeak),
                gauss = largest_error(gauss_lobe, hemisphere, Of::kPeak),
                cs16 = largest_error(cs16_lobe, hemisphere, Of::kPeak);
  const auto worst = [](Real (*lobe)(Real, Real), Real n) {
    return largest_difference(lobe, n, hemisphere(n), 4 * kLobeAngles).value;
  };
  const Real crossing = root([&](Real n) { return worst(cs16_lobe, n) - worst(gauss_lobe, n); },
                             Real(17), Real(100), 20);
  Claim claim{"more-accurate-lobe", kConclusions,
              "more accurate, as a lobe: cs16 is nearer to cos^n than the other lobes compared",
              ""};
  claim.measured = {figure("largest difference of cs16 from cos^n", cs16, 3),
                    figure("of Schlick's", schlick, 3), figure("of the Gaussian", gauss, 3),
                    figure("exponent from which the Gaussian is nearer", crossing, 3)};
  claim.definition =
      "absolute difference over the hemisphere, a share of the peak, n = 16..1024. Confirmed if cs16's is "
      "the smallest. The paper does not say what more accurate means; the other more-accurate claims are "
      "other readings";
  claim.verdict = confirmed_if(cs16.value < std::min(schlick.value, gauss.value));
  claim.reason =
      "cs16 is far nearer than Schlick's lobe. The Gaussian, which costs more, is nearer for large n";
  return claim;
}

}  // namespace lobelia::paper
