#include "studies/cost/lobe_errors.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "base/words/constants.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/number_limits.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::cost {
namespace {

/// The number in which errors of float and double are measured.
using Quad = boost::multiprecision::cpp_bin_float_quad;
static_assert(std::numeric_limits<Quad>::digits == 113);
const bool kQuadLimits = truth::made_limits<Quad>();

constexpr std::size_t kCore = 2048, kTail = 512;

std::size_t place_of(LobeId lobe) {
  const auto lobes = all_lobes();
  return std::size_t(std::find(lobes.begin(), lobes.end(), lobe) - lobes.begin());
}

constexpr std::size_t kLeaf = 1 << 14;  // numbers that are evaluated together
constexpr int kTerms = 6;               // of the series of cos^n about the middle of a leaf

float float_of(std::uint32_t bits) { return std::bit_cast<float>(bits); }
std::uint32_t bits_of(double s) { return std::bit_cast<std::uint32_t>(float(s)); }

/// Successive numbers of float32, as their bits.
struct Block {
  std::uint32_t first, last;
  double upper;  ///< bound of the error
  double begin() const { return float_of(first); }
  double end() const { return float_of(last); }
};

class Search {
 public:
  Search(const LobeVariant& variant, double exponent)
      : variant_(variant),
        n_(exponent),
        most_bend_(most_bend(variant.lobe)),
        own_(prepare(variant.lobe, exponent)),
        cosine_(prepare(*find_lobe("cosine"), exponent)),
        is_cosine_(variant.lobe == *find_lobe("cosine") ||
                   variant.lobe == find_lobe(fmt::format("cs{}", exponent))) {}

  /// The largest error at a few numbers of each octave: a lower bound of the result.
  double lower_bound() const {
    std::vector<float> s;
    for (std::uint32_t bits = least(); bits < bits_of(1); bits += kOctave / kLobeBlock)
      s.push_back(float_of(bits));
    const std::vector<double> value = variant_.values(s);
    double most = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const auto [high, low] = truth<Quad>(s[i]);
      const double error = std::abs((value[i] - high) - low);
      check(error, upper(s[i], s[i]), s[i]);
      most = std::max(most, error);
    }
    return most;
  }

  /// The blocks in which an error of more than `known` is possible, each of kLeaf numbers at most.
  std::vector<Block> leaves(double known) const {
    std::vector<Block> found, open;
    // Within one octave, so that a block's numbers are evenly spaced.
    for (std::uint32_t first = least(); first < bits_of(1); first += kOctave)
      open.push_back(bounded(first, first + kOctave - 1));
    while (!open.empty()) {
      const Block block = open.back();
      open.pop_back();
      if (block.upper <= known) continue;
      if (is_leaf(block, known)) {
        found.push_back(block);
        continue;
      }
      const std::uint32_t middle = block.first + (block.last - block.first) / 2;
      open.push_back(bounded(block.first, middle));
      open.push_back(bounded(middle + 1, block.last));
    }
    return found;
  }

  /// The numbers that decide: the ends of each step if the variant rounds 1 - s, otherwise all.
  std::vector<float> numbers(const Block& block) const {
    std::vector<float> s;
    if (!by_steps(block)) {
      for (std::uint32_t bits = block.first; bits <= block.last; ++bits)
        s.push_back(float_of(bits));
      return s;
    }
    s = {float_of(block.first), float_of(block.last)};
    for (std::uint64_t tie = first_tie(block); double(tie) * 0x1p-25 <= block.end(); tie += 2) {
      const std::uint32_t bits = bits_of(double(tie) * 0x1p-25);
      for (const std::uint32_t near : {bits - 1, bits, bits + 1})
        s.push_back(float_of(std::clamp(near, block.first, block.last)));
    }
    return s;
  }

  /// The largest error in a leaf.
  double largest(const Block& block, const std::vector<float>& given) const {
    std::vector<float> s = given;
    s.resize((s.size() + kLobeBlock - 1) / kLobeBlock * kLobeBlock, s.back());
    const std::vector<double> value = variant_.values(s);
    // cos^n by a series about the middle, in two doubles: cheaper than many digits at each number.
    const double middle = float_of(block.first + (block.last - block.first) / 2);
    const auto [high, low] = variant_.wide ? truth<Quad>(middle) : truth<long double>(middle);
    double terms[kTerms], term = 1;
    for (int j = 0; j < kTerms; ++j) terms[j] = term *= (j - n_) / (j + 1);
    const double scale = 1 / (1 - middle);
    double most = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double d = (double(s[i]) - middle) * scale;
      double change = terms[kTerms - 1];
      for (int j = kTerms - 2; j >= 0; --j) change = change * d + terms[j];
      const double error = (value[i] - high) - (low + high * (change * d));
      most = error < -most ? -error : error > most ? error : most;
      if (std::isnan(error)) most = error;
    }
    check(most, block.upper, middle);
    return most;
  }

 private:
  static constexpr std::uint32_t kOctave = 1 << 23;

  void check(double error, double allowed, double s) const {
    if (!(error <= allowed * (1 + 1e-9)))
      throw Error(ExitCode::kInternal, "{} is {:.3g} off near s = {}, n = {}; {:.3g} is allowed",
                  variant_.name(), error, s, n_, allowed);
  }

  /// The start of the first octave of the search.
  std::uint32_t least() const {
    return bits_of(std::exp2(variant_.wide ? -55 : -26) / n_) & ~(kOctave - 1);
  }

  /// cos^n as two doubles.
  template <class Number>
  std::pair<double, double> truth(double s) const {
    using std::pow;
    const Number value = pow(Number(1) - Number(s), Number(n_));
    const auto high = static_cast<double>(value);
    return {high, static_cast<double>(value - Number(high))};
  }

  Block bounded(std::uint32_t first, std::uint32_t last) const {
    Block block{first, last, 0};
    block.upper = upper(block.begin(), block.end());
    return block;
  }

  /// A bound of the error from `begin` to `end`: the lobes fall and bend by most_bend() at most, and the variant adds its
  /// allowed rounding; it cannot exceed the lobes' own values.
  double upper(double begin, double end) const {
    const double own = own_.value(begin), cosine = cosine_.value(begin);
    const double last_own = own_.value(end), last_cosine = cosine_.value(end);
    double shape = 0;
    if (!is_cosine_) {
      const double fallen = std::max(std::abs(own - last_cosine), std::abs(cosine - last_own));
      const double bent = std::max(std::abs(own - cosine), std::abs(last_own - last_cosine)) +
                          bend(n_ * (end - begin));
      shape = std::min(fallen, bent) + 4 * std::numeric_limits<double>::epsilon();
    }
    return std::min(shape + variant_.allowed, std::max(cosine, most_value(own)));
  }

  /// The most that the second derivative adds between two ends `width` apart in n s.
  double bend(double width) const { return most_bend_ / 8 * width * width; }

  /// The most that the variant can return for that value or a smaller one: each factor e adds a few roundings.
  double most_value(double own) const {
    const double k = variant_.lobe.order;
    const double base =
        k > 0 ? std::pow(std::pow(own, 1 / k) + 0x1p-22, k) : std::pow(own, 1 - 0x1p-21);
    return base * std::exp(2 * variant_.allowed) + std::numeric_limits<float>::min();
  }

  static std::uint64_t first_tie(const Block& block) {
    const auto from = std::uint64_t(std::ceil(block.begin() * 0x1p25));
    return from | 1;
  }
  std::uint64_t steps(const Block& block) const {
    return std::uint64_t((block.end() - block.begin()) * 0x1p24) + 1;
  }
  bool by_steps(const Block& block) const {
    return variant_.of_cosine && block.end() < 0.5 &&
           3 * steps(block) + 2 < std::uint64_t(block.last - block.first) + 1;
  }
  bool is_leaf(const Block& block, double known) const {
    const std::uint64_t count =
        by_steps(block) ? 3 * steps(block) + 2 : std::uint64_t(block.last - block.first) + 1;
    // So narrow that the series has the digits of the variant's numbers, and that bending does not matter.
    const double width = n_ * (block.end() - block.begin());
    return count <= kLeaf && width <= (variant_.wide ? 0x1p-11 : 0x1p-7) * (1 - block.end()) &&
           (is_cosine_ || bend(width) <= std::max(known * 0x1p-10, variant_.allowed / 4));
  }

  const LobeVariant& variant_;
  double n_, most_bend_;
  PreparedLobe own_, cosine_;
  bool is_cosine_;
};

}  // namespace

double most_bend(const LobeId& lobe) { return family(lobe) == "ggx" ? 8 : 3.5; }

std::vector<records::CostError> lobe_error_kinds() {
  return {{"max", "largest error, of the peak"},
          {"rms", "RMS error over the highlight, of the peak"},
          {"energy", "error of the energy, of that of cos^n"}};
}

LobeTruth::LobeTruth(double exponent) : cosine_energy_(1 / (exponent + 1)) {
  add_samples(exponent);
  cosine_ = place_of(*find_lobe("cosine"));
  const ModelId whole = *find_model("phong_rdf");  // 1/coefficient: 2 pi times the lobe's integral
  for (const LobeId& lobe : all_lobes()) {
    std::vector<Value>& values = values_.emplace_back();
    for (const float s : s_) {
      const Quad value = s < 1 ? lobe_definition<Quad>(lobe, Quad(1) - Quad(s), exponent) : Quad(0);
      values.push_back({double(value), double(value - Quad(double(value)))});
    }
    const double energy = 1 / (2 * kPi * truth::coefficient(whole, lobe, exponent));
    shape_energy_.push_back(values_.size() - 1 == cosine_ ? 0 : energy / cosine_energy_ - 1);
  }
}

void LobeTruth::add_samples(double exponent) {
  const double end = highlight_end(exponent);
  // Numbers of the narrower type, so that every variant gets exactly the same s.
  const auto add = [&](double s, double weight) {
    s_.push_back(float(s));
    weight_.push_back(weight);
  };
  // Not the middle of a cell: that has few digits, so that 1 - s would not be rounded.
  const auto within = [](std::size_t i) {
    return double(i) + std::fmod(double(i + 1) * std::numbers::phi, 1.0);
  };
  for (std::size_t i = 0; i < kCore; ++i) add(end * within(i) / kCore, end / kCore);
  core_ = s_.size();
  const double step = -std::log(end) / kTail;
  for (std::size_t i = 0; i < kTail && end < 1; ++i) {
    const double s = end * std::exp(within(i) * step);
    add(s, s * step);
  }
  add(0, 0);
  add(1, 0);
  for (int bits = 1; bits <= 24; ++bits) add(1 - std::exp2(-bits), 0);
  for (int bits = 2; bits <= 60; ++bits) add(std::exp2(-bits), 0);
  while (s_.size() % kLobeBlock != 0) add(0, 0);
}

LobeVariantErrors LobeTruth::errors(const LobeVariant& variant) const {
  const std::vector<double> computed = variant.values(s_);
  const std::size_t place = place_of(variant.lobe);
  const std::vector<Value>&own = values_[place], &cosine = values_[cosine_];
  LobeVariantErrors errors;
  double drift = 0;
  const auto add = [&](LobeErrors& e, double difference, std::size_t i) {
    e.max = std::max(e.max, std::abs(difference));
    if (i < core_) e.rms += difference * difference;
  };
  for (std::size_t i = 0; i < s_.size(); ++i) {
    const double rounding = (computed[i] - own[i].high) - own[i].low;
    if (!(std::abs(rounding) <= variant.allowed))
      throw Error(ExitCode::kInternal, "{} is {:.3g} off at s = {}, n = {}; {:.3g} is allowed",
                  variant.name(), std::abs(rounding), s_[i], 1 / cosine_energy_ - 1,
                  variant.allowed);
    add(errors.rounding, rounding, i);
    add(errors.shape, (own[i].high - cosine[i].high) + (own[i].low - cosine[i].low), i);
    add(errors.all, (computed[i] - cosine[i].high) - cosine[i].low, i);
    drift += weight_[i] * rounding;
  }
  for (LobeErrors* e : {&errors.all, &errors.shape, &errors.rounding})
    e->rms = std::sqrt(e->rms / double(core_));
  errors.rounding.energy = std::abs(drift) / cosine_energy_;
  errors.shape.energy = std::abs(shape_energy_[place]);
  errors.all.energy = std::abs(shape_energy_[place] + drift / cosine_energy_);
  return errors;
}

LargestError largest_error(const LobeVariant& variant, double exponent, double at_least,
                           std::uint64_t most_numbers) {
  const Search search(variant, exponent);
  at_least = std::max(at_least, search.lower_bound());
  const std::vector<Block> leaves = search.leaves(at_least);
  // In an order that spreads over all places, in case not all can be evaluated.
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < leaves.size(); ++i)
    order.emplace_back(std::fmod(double(i) * std::numbers::phi, 1.0), i);
  std::sort(order.begin(), order.end());

  std::vector<double> most(leaves.size(), -1);
  std::atomic<double> known{at_least};
  std::atomic<std::uint64_t> numbers{0};
  const auto affordable = std::min<std::uint64_t>(leaves.size(), most_numbers / kLeaf + 1);
  oneapi::tbb::parallel_for(std::size_t{0}, std::size_t(affordable), [&](std::size_t i) {
    const Block& leaf = leaves[order[i].second];
    if (interrupted()) return;
    most[order[i].second] = 0;
    if (leaf.upper <= known) return;
    const std::vector<float> s = search.numbers(leaf);
    numbers += s.size();
    const double here = most[order[i].second] = search.largest(leaf, s);
    for (double before = known; here > before && !known.compare_exchange_weak(before, here);) {
    }
  });
  throw_if_interrupted();
  LargestError result{known, known, numbers};
  for (std::size_t i = 0; i < leaves.size(); ++i)
    if (most[i] < 0) result.at_most = std::max(result.at_most, leaves[i].upper);
  return result;
}

}  // namespace lobelia::cost
