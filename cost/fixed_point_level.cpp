#include "cost/fixed_point_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cost/lobe_errors.hpp"

namespace lobelia::cost {
namespace {

constexpr int kLeastBits = 6, kMostBits = 32;
constexpr FixedRounding kRoundings[] = {FixedRounding::kNearest, FixedRounding::kTruncate};
constexpr std::size_t kSamples = 4096;
/// More bits are wasted once the error is within this of what the shape alone makes.
constexpr double kNothingMore = 0.05;

LobeId cosine() { return *find_lobe("cosine"); }

Circuit table_circuit(FixedPoint f, unsigned n, int address_bits) {
  const auto table = std::make_shared<const FixedTable>(f, n, address_bits);
  const double step = std::ldexp(1, table->bits_within() - f.bits);
  return {fmt::format("table of {}", 1 << address_bits), f,
          fixed_table_operations(f, *table, address_bits),
          [table](std::uint64_t s) { return table->value(s); },
          [n, step](double s) {
            const double from = std::floor(s / step) * step;
            const double a = lobe_value(cosine(), from, n),
                         b = lobe_value(cosine(), from + step, n);
            return a + (b - a) * (s - from) / step;
          }};
}

std::vector<Circuit> circuits(unsigned n, const std::vector<int>& bits) {
  std::vector<Circuit> all;
  for (const FixedRounding rounding : kRoundings)
    for (const int count : bits) {
      const FixedPoint f{count, rounding};
      // Those of the catalogue that squarings alone make.
      for (const LobeId lobe : all_lobes())
        if (lobe.order > 0 && (lobe.order & (lobe.order - 1)) == 0)
          all.push_back(cs_circuit(f, n, lobe.order));
      all.push_back(power_circuit(f, n));
      for (const int address_bits : {4, 5, 6, 8})
        if (FixedTable::fits(f, n, address_bits)) all.push_back(table_circuit(f, n, address_bits));
    }
  return all;
}

Way row(const Circuit& circuit, unsigned n) {
  const CircuitErrors e = circuit_errors(circuit, n);
  const std::string rounding(name(circuit.f.rounding));
  Times count;
  count.least = count.median = count.most = circuit.operations;
  return {
      fmt::format("{}, {} bits, {}", circuit.what, circuit.f.bits, rounding),
      {{"lobe", circuit.what}, {"bits", std::to_string(circuit.f.bits)}, {"rounding", rounding}},
      count,
      {e.max, e.rms, e.energy},
      {},
      {{"shape", e.shape}, {"rounding", e.rounding}, {"quantisation", e.quantisation}}};
}

/// The errors of one kind of circuit over all numbers of bits.
struct OverBits {
  std::vector<Circuit> circuits;
  std::vector<CircuitErrors> errors;

  template <class Make>
  OverBits(Make make, FixedRounding rounding, unsigned n) {
    for (int bits = kLeastBits; bits <= kMostBits; ++bits) {
      circuits.push_back(make(FixedPoint{bits, rounding}));
      errors.push_back(circuit_errors(circuits.back(), n));
    }
  }
  /// From how many bits on it holds of the errors, if of any.
  template <class Holds>
  std::optional<std::size_t> from(Holds holds) const {
    std::optional<std::size_t> first;
    for (std::size_t i = errors.size(); i-- > 0 && holds(errors[i]);) first = i;
    return first;
  }
  int bits(std::size_t i) const { return circuits[i].f.bits; }
};

std::vector<std::string> remarks_of(unsigned n, FixedRounding rounding) {
  const OverBits cs16([n](FixedPoint f) { return cs_circuit(f, n, 16); }, rounding, n);
  const OverBits power([n](FixedPoint f) { return power_circuit(f, n); }, rounding, n);
  const double shape = cs16.errors.back().shape;
  const std::string_view word = name(rounding);
  if (shape < cs16.errors.back().rounding)
    return {fmt::format(
        "cs16, {}: its shape is within {:.2g} of cos^{}, so that every bit counts: "
        "{:.2g} with {} bits, {:.2g} with {}.",
        word, shape, n, cs16.errors.front().max, kLeastBits, cs16.errors.back().max, kMostBits)};
  std::vector<std::string> remarks;
  if (const auto i = cs16.from([](const CircuitErrors& e) { return e.rounding < e.shape; }))
    remarks.push_back(fmt::format(
        "cs16, {}: from {} bits on rounding makes less error ({:.2g}) than the shape ({:.2g}); the bits "
        "of s alone make {:.0f} % of it.",
        word, cs16.bits(*i), cs16.errors[*i].rounding, shape,
        100 * cs16.errors[*i].quantisation / cs16.errors[*i].rounding));
  const auto enough =
      cs16.from([](const CircuitErrors& e) { return e.max <= (1 + kNothingMore) * e.shape; });
  if (!enough) return remarks;
  const double reached = cs16.errors[*enough].max;
  remarks.push_back(fmt::format(
      "cs16, {}: more than {} bits are wasted at n = {}: all that they could take away is "
      "{:.0f} % of an error of {:.2g}.",
      word, cs16.bits(*enough), n, 100 * (reached - shape) / reached, reached));
  if (const auto i = power.from([&](const CircuitErrors& e) { return e.max <= reached; }))
    remarks.push_back(fmt::format(
        "cos^n by squaring, {}, is as exact with {} bits and {:.6g} bit operations, {:.2g} times the {:.6g} "
        "of cs16.",
        word, power.bits(*i), power.circuits[*i].operations,
        power.circuits[*i].operations / cs16.circuits[*enough].operations,
        cs16.circuits[*enough].operations));
  return remarks;
}

}  // namespace

Circuit cs_circuit(FixedPoint f, unsigned n, int k) {
  const LobeId lobe = *find_lobe(fmt::format("cs{}", k));
  return {std::string(info(lobe).name), f, fixed_cs_operations(f, n, k),
          [=](std::uint64_t s) { return fixed_cs(f, n, k, s); },
          [=](double s) { return lobe_value(lobe, s, n); }};
}

Circuit power_circuit(FixedPoint f, unsigned n) {
  return {"cosine by squaring", f, fixed_power_operations(f, n),
          [=](std::uint64_t s) { return fixed_power(f, n, s); },
          [n](double s) { return lobe_value(cosine(), s, n); }};
}

CircuitErrors circuit_errors(const Circuit& circuit, unsigned n) {
  const FixedPoint f = circuit.f;
  const double end = highlight_end(n);
  CircuitErrors errors;
  double drift = 0;
  const auto largest = [](double& most, double error) { most = std::max(most, std::abs(error)); };
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double s = end * (double(i) + 0.5) / kSamples;
    const double truth = lobe_value(cosine(), s, n);
    const double error = f.value(circuit.value(f.one_minus_cos(s))) - truth;
    drift += error;
    errors.rms += error * error;
    largest(errors.max, error);
    largest(errors.shape, circuit.ideal(s) - truth);
  }
  errors.rms = std::sqrt(errors.rms / kSamples);
  errors.energy = std::abs(drift) * end / kSamples * (n + 1.0);

  // A circuit is a step function, and farthest off at the ends of its steps. All steps, or as many as
  // samples, evenly chosen.
  const double up = f.rounding == FixedRounding::kNearest ? 0.5 : 0;
  const auto steps = std::uint64_t(std::ceil(end * double(f.one())));
  const std::uint64_t stride = steps / kSamples + 1;
  for (std::uint64_t step = 0; step <= steps; step += stride) {
    const double value = f.value(circuit.value(step)), at = circuit.ideal(f.value(step));
    for (const double edge : {double(step) + up - 1, double(step) + up}) {
      const double s = std::clamp(edge / double(f.one()), 0.0, 1.0);
      const double ideal = circuit.ideal(s);
      const double truth = lobe_value(cosine(), s, n);
      largest(errors.max, value - truth);
      largest(errors.shape, ideal - truth);
      largest(errors.rounding, value - ideal);
      largest(errors.quantisation, at - ideal);
    }
  }
  return errors;
}

Table fixed_point_table(unsigned n, const std::vector<int>& bits) {
  Table table{fmt::format("fixed-point-n{}", n),
              "fixed-point",
              fmt::format("A lobe in fixed point, n = {}", n),
              "evaluation",
              {{"max", "largest error, of the peak"},
               {"rms", "RMS error over the highlight, of the peak"},
               {"energy", "error of the energy, of that of cos^n"}},
              {},
              {},
              "bit operations"};
  for (const Circuit& circuit : circuits(n, bits)) table.ways.push_back(row(circuit, n));
  for (const FixedRounding rounding : kRoundings)
    for (std::string& remark : remarks_of(n, rounding)) table.remarks.push_back(std::move(remark));
  return table;
}

std::vector<Table> measure_fixed_point(const Options& options) {
  const bool quick = options.effort == Effort::kQuick;
  std::vector<int> bits;
  for (int count = kLeastBits; count <= kMostBits; count += quick ? 4 : 2) bits.push_back(count);
  std::vector<Table> tables;
  for (const unsigned n :
       quick ? std::vector<unsigned>{64, 1024} : std::vector<unsigned>{16, 64, 256, 1024, 65536}) {
    options.progress(fmt::format("n = {}", n));
    tables.push_back(fixed_point_table(n, bits));
  }
  return tables;
}

}  // namespace lobelia::cost
