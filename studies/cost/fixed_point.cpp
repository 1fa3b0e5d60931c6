#include "studies/cost/fixed_point.hpp"

#include <bit>
#include <cmath>

#include "renderer/highlight.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "studies/cost/binary_power.hpp"
#include "studies/cost/lobe_errors.hpp"

namespace lobelia::cost {
namespace {

__extension__ using Wide = unsigned __int128;  // 1 squared has 65 bits
__extension__ using SignedWide = __int128;

std::uint64_t shifted(Wide x, int bits, FixedRounding rounding) {
  if (bits == 0) return std::uint64_t(x);
  const Wide half = rounding == FixedRounding::kNearest ? Wide(1) << (bits - 1) : 0;
  return std::uint64_t((x + half) >> bits);
}

int log2_of(int k) { return int(std::bit_width(unsigned(k))) - 1; }

/// s covered by a table is below 2^-this.
int range_shift(unsigned n) { return int(std::floor(-std::log2(highlight_end(n)))); }

}  // namespace

std::string_view name(FixedRounding rounding) {
  return rounding == FixedRounding::kNearest ? "rounded" : "truncated";
}

std::uint64_t FixedPoint::product(std::uint64_t a, std::uint64_t b) const {
  return shifted(Wide(a) * b, bits, rounding);
}

std::uint64_t FixedPoint::one_minus_cos(double s) const {
  const double scaled = (1 - s) * double(one());
  const double cosine =
      rounding == FixedRounding::kNearest ? std::floor(scaled + 0.5) : std::floor(scaled);
  return one() - std::uint64_t(cosine);
}

std::uint64_t fixed_cs(FixedPoint f, unsigned n, int k, std::uint64_t s) {
  const Wide whole = Wide(f.one()) * unsigned(k), part = Wide(n) * s;
  if (part >= whole) return 0;
  std::uint64_t power = shifted(whole - part, log2_of(k), f.rounding);
  for (int i = log2_of(k); i > 0; --i) power = f.product(power, power);
  return power;
}

std::uint64_t fixed_power(FixedPoint f, unsigned n, std::uint64_t s) {
  return HWY_NAMESPACE::binary_power(
      f.one() - s, n, [&](std::uint64_t a, std::uint64_t b) { return f.product(a, b); });
}

FixedPk::FixedPk(FixedPoint f, unsigned n, int k) : f_(f), n_(n), k_(k), range_(0) {
  const HWY_NAMESPACE::PkLobe lobe({double(n), k});
  while (lobe.value(std::ldexp(1 / lobe.n, range_)) > 0) ++range_;
  for (int j = 0; j < 3; ++j)
    q_[j] = std::llround(std::ldexp(lobe.of_t[j], (j + 1) * range_ + f.bits));
}

std::uint64_t FixedPk::value(std::uint64_t s) const {
  const SignedWide t = SignedWide(n_) * s, half = SignedWide(1) << (f_.bits + range_ - 1);
  if (t >= 2 * half) return 0;
  const auto times_t = [&](std::int64_t a) {
    return std::int64_t((t * a + (f_.rounding == FixedRounding::kNearest ? half : 0)) >>
                        (f_.bits + range_));
  };
  const std::int64_t base =
      std::int64_t(f_.one()) + times_t(q_[0] + times_t(q_[1] + times_t(q_[2])));
  if (base <= 0) return 0;
  auto power = std::uint64_t(base);
  for (int i = 1; i < k_; i *= 2) power = f_.product(power, power);
  return power;
}

double FixedPk::operations() const {
  const double bits = f_.bits, scale = (bits + 1) * std::bit_width(n_), cut = bits;
  double steps = 0;
  for (const std::int64_t q : q_)
    steps += (bits + range_) * int(std::bit_width(std::uint64_t(std::abs(q))));
  return scale + steps + cut + log2_of(k_) * bits * bits;
}

bool FixedTable::fits(FixedPoint f, unsigned n, int address_bits) {
  return f.bits > range_shift(n) + address_bits;
}

FixedTable::FixedTable(FixedPoint f, unsigned n, int address_bits)
    : f_(f), bits_within_(f.bits - range_shift(n) - address_bits) {
  const LobeId cosine = *find_lobe("cosine");
  const std::uint64_t intervals = std::uint64_t(1) << address_bits;
  for (std::uint64_t i = 0; i <= intervals; ++i) {
    const double s = std::ldexp(double(i), -address_bits - range_shift(n));
    entries_.push_back(std::uint64_t(std::round(lobe_value(cosine, s, n) * double(f.one()))));
  }
}

std::uint64_t FixedTable::value(std::uint64_t s) const {
  const std::uint64_t at = s >> bits_within_;
  if (at + 1 >= entries_.size()) return 0;
  const std::uint64_t within = s & ((std::uint64_t(1) << bits_within_) - 1);
  const std::uint64_t fall = entries_[at] - entries_[at + 1];
  return entries_[at] - shifted(Wide(fall) * within, bits_within_, f_.rounding);
}

double fixed_cs_operations(FixedPoint f, unsigned n, int k) {
  const double bits = f.bits, multiply_add = (bits + 1) * std::bit_width(n), cut = bits;
  return multiply_add + cut + log2_of(k) * bits * bits;
}

double fixed_power_operations(FixedPoint f, unsigned n) {
  int products = 0;
  HWY_NAMESPACE::binary_power(0, n, [&](int, int) { return ++products; });
  return double(products) * f.bits * f.bits;
}

double fixed_table_operations(FixedPoint f, const FixedTable& table, int address_bits) {
  const double bits = f.bits, read = std::exp2(address_bits) * bits, cut = bits;
  return read + bits * table.bits_within() + 2 * bits + cut;
}

}  // namespace lobelia::cost
