// 1 / (2 pi integral of lobe times cosines times sin x, x = 0..pi/2), in pieces: as long as the lobe is wide near its
// peak, then longer and longer. The lobe of a family ends in a corner, and so does a piece.
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

#include "base/system/error.hpp"
#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/printed.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {
namespace {

/// The tail beyond a lobe this small adds nothing: the whole integral is of the size of 1/n, or of 1 below n = 1.
constexpr double kNothing = 1e-40;
constexpr double kTolerance = 1e-22;  ///< of the last piece's error, of the whole

/// Ends of the pieces, from 0 to a right angle.
std::vector<Big> pieces(const ModelRow& model, const LobeId& lobe, double exponent) {
  const Big right_angle = boost::math::constants::half_pi<Big>();
  const Big part = model.lobe_of_half_angle ? 2 : 1;
  // A formula may fall on any scale, and end anywhere.
  const Big unit =
      part * (lobe.formula ? angle_at(lobe, 0.5, exponent) : Big(1 / sqrt(Big(exponent))));
  std::vector<Big> ends{0, right_angle, right_angle / 2};
  for (const double factor : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 11.0})
    ends.push_back(factor * unit);
  for (Big end = 16 * unit; end < right_angle; end *= 2) ends.push_back(end);
  if (lobe.order > 0 || lobe.formula) ends.push_back(part * angle_at(lobe, 0, exponent));
  std::erase_if(ends, [&](const Big& end) { return end > right_angle; });
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// For a formula, which may have corners anywhere.
Big with_corners(const auto& integrand, const Big& begin, const Big& end) {
  return boost::math::quadrature::gauss_kronrod<Big, 21>::integrate(integrand, begin, end, 12,
                                                                    1e-12);
}

double integrate(const ModelRow& model, const LobeId& lobe, double exponent) {
  const auto integrand = [&](const Big& cos_x, const Big& sin_x, const Big& cosine) {
    const Big value = lobe_of_cosine(lobe, cosine, exponent) * sin_x;
    return model.integral_has_cosine ? Big(value * cos_x) : value;
  };
  // One cosine gives the others by roots, which are faster.
  const auto other = [](const Big& leg) { return Big(sqrt((1 - leg) * (1 + leg))); };
  const auto of_angle = [&](const Big& x) {
    const Big c = cos(model.lobe_of_half_angle ? Big(x / 2) : x);
    return model.lobe_of_half_angle ? integrand(2 * c * c - 1, 2 * c * other(c), c)
                                    : integrand(c, other(c), c);
  };
  const auto normalised = [&](const Big& sum) {
    return double(1 / (2 * boost::math::constants::pi<Big>() * sum * model.parts));
  };
  const auto highest_from = [&](const Big& begin) {
    return lobe_of_cosine(lobe, cos(model.lobe_of_half_angle ? Big(begin / 2) : begin), exponent);
  };
  const auto smooth = [&](const Big& begin, const Big& end) {
    return lobe.formula ? with_corners(of_angle, begin, end)
                        : boost::math::quadrature::gauss<Big, 20>::integrate(of_angle, begin, end);
  };
  const std::vector<Big> ends = pieces(model, lobe, exponent);
  Big sum = 0;
  for (std::size_t i = 1; i + 1 < ends.size(); ++i) {
    const Big& begin = ends[i - 1];
    if (highest_from(begin) * std::max(exponent, 1.0) < kNothing) return normalised(sum);
    sum += smooth(begin, ends[i]);
  }
  const Big last = ends[ends.size() - 2], piece = ends.back() - last;
  // The error is to be small beside the whole, of which a narrow lobe leaves little for the last piece.
  const Big tolerance = kTolerance * sum / (piece * highest_from(last));
  if (tolerance > 1) return normalised(sum);
  // With half angles, a lobe without an end is smooth here.
  if (model.lobe_of_half_angle && lobe.order == 0 && !lobe.formula)
    return normalised(sum + smooth(last, ends.back()));
  // cos^n with a small n rises steeply from the right angle. The piece starts there, with points crowded at that end.
  thread_local boost::math::quadrature::tanh_sinh<Big> corner;
  // Over 0 to 1, in parts of the piece: over a shorter interval Boost's smallest step underflows.
  const auto from_right_angle = [&](const Big& part) {
    const Big c = sin(Big(piece * part));
    return integrand(c, other(c), model.lobe_of_half_angle ? Big(sqrt((1 + c) / 2)) : c);
  };
  sum += piece * (lobe.formula ? with_corners(from_right_angle, 0, 1)
                               : corner.integrate(from_right_angle, Big(0), Big(1), tolerance));
  return normalised(sum);
}

}  // namespace

Big angle_at(const LobeId& lobe, double value, double exponent) {
  Big above = 0, beyond = boost::math::constants::half_pi<Big>();
  // By halves; first in the exponent, for a narrow lobe.
  while (beyond > 1e-9 && lobe_of_cosine(lobe, Big(cos(beyond / 2)), exponent) <= value)
    beyond /= 2;
  for (int step = 0; step < 100; ++step) {
    const Big middle = (above + beyond) / 2;
    (lobe_of_cosine(lobe, Big(cos(middle)), exponent) > value ? above : beyond) = middle;
  }
  return beyond;
}

double coefficient(ModelId model, LobeId lobe, double exponent) {
  // Pictures ask for the same few again and again, and each takes about 10 ms.
  static std::mutex mutex;
  static std::map<std::tuple<int, LobeId, double>, double> known;
  const std::tuple key(int(model.index), lobe, exponent);
  {
    const std::lock_guard lock(mutex);
    if (const auto found = known.find(key); found != known.end()) return found->second;
  }
  const double value = integrate(model_row(model), lobe, exponent);
  const std::lock_guard lock(mutex);
  return known[key] = value;
}

double coefficient(const Highlight& highlight) {
  if (highlight.normalisation == Normalisation::kExact)
    return coefficient(highlight.model, highlight.lobe, highlight.exponent);
  const ModelRow& model = model_row(highlight.model);
  // Shadowing is not in the coefficient: the distribution is the heightfield's.
  const std::string_view printed = model.has_shadowing ? "blinn_phong_heightfield" : model.name;
  const auto& row = *std::ranges::find(paper::kRows, printed, &paper::Row::name);
  const std::string_view lobe = info(highlight.lobe).name;
  if (lobe != "cosine" && lobe != "cs16")
    throw Error(ExitCode::kInput, "the paper prints no coefficient for the lobe '{}'", lobe);
  const auto column = row.column(lobe == "cosine" ? paper::Lobe::kCosine : paper::Lobe::kCs16);
  return double(column(highlight.exponent) / model.parts);
}

}  // namespace lobelia::truth
