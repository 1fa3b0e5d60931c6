#include "studies/cost/fixed_point.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "core/interrupt.hpp"
#include "studies/cost/benchmarks.hpp"
#include "studies/cost/lobe_errors.hpp"

namespace lobelia::cost {
namespace {

constexpr int kLeastBits = 6, kMostBits = 32;
constexpr FixedRounding kRoundings[] = {FixedRounding::kNearest, FixedRounding::kTruncate};
/// Steps are integrated by Simpson's rule in pieces over which the exponent changes by this: exact to 1e-6.
constexpr double kPiece = 1 / 256.0;
/// More bits are wasted once the error is within this of the shape's.
constexpr double kNothingMore = 0.05;

PreparedLobe cosine(unsigned n) { return prepare(*find_lobe("cosine"), n); }

double unit(FixedPoint f) {
  return std::exp2(-f.bits) * (f.rounding == FixedRounding::kNearest ? 0.5 : 1);
}

Circuit table_circuit(FixedPoint f, unsigned n, int address_bits) {
  const auto table = std::make_shared<const FixedTable>(f, n, address_bits);
  const double step = std::ldexp(1, table->bits_within() - f.bits),
               range = std::ldexp(step, address_bits);
  return {
      fmt::format("table of {}", 1 << address_bits), f,
      fixed_table_operations(f, *table, address_bits),
      // The roundings of s, n times as large by the slope, of the entries and of the product; and the part cut off.
      unit(f) * (n + 1.0) + std::exp2(-f.bits - 1) + cosine(n).value(range),
      [table](std::uint64_t s) { return table->value(s); },
      [truth = cosine(n).value, step, range](double s) {
        if (s >= range) return 0.0;
        const double from = std::floor(s / step) * step;
        const double a = truth(from), b = truth(from + step);
        return a + (b - a) * (s - from) / step;
      }};
}

std::vector<Circuit> circuits(unsigned n, const std::vector<int>& bits) {
  std::vector<Circuit> all;
  for (const FixedRounding rounding : kRoundings)
    for (const int count : bits) {
      const FixedPoint f{count, rounding};
      // The lobes of the catalogue that need no power but squarings.
      for (const LobeId& lobe : all_lobes()) {
        if (family(lobe) == "cs" && (lobe.order & (lobe.order - 1)) == 0)
          all.push_back(cs_circuit(f, n, lobe.order));
        if (family(lobe) == "pk") all.push_back(pk_circuit(f, n, lobe.order));
      }
      all.push_back(power_circuit(f, n));
      for (const int address_bits : {4, 5, 6, 8})
        if (FixedTable::fits(f, n, address_bits)) all.push_back(table_circuit(f, n, address_bits));
    }
  return all;
}

Variant circuit_variant(const Circuit& circuit, const CircuitErrors& e) {
  const std::string rounding(name(circuit.f.rounding));
  Variant variant;
  variant.name = fmt::format("{}, {} bits, {}", circuit.what, circuit.f.bits, rounding);
  variant.settings = {
      {"lobe", circuit.what}, {"bits", std::to_string(circuit.f.bits)}, {"rounding", rounding}};
  variant.count = circuit.operations;
  variant.errors = {{"max", e.max}, {"rms", e.rms}, {"energy", e.energy}};
  variant.facts.emplace().circuit = e;
  if (e.steps_looked_at < e.steps) {
    variant.errors_at_most.emplace() = {{"max", e.max_at_most}};
    variant.error_spreads.emplace() = {
        {"max", 0}, {"rms", e.rms_spread}, {"energy", e.energy_spread}};
  }
  return variant;
}

std::vector<CircuitErrors> errors_of_all(const std::vector<Circuit>& circuits, unsigned n) {
  std::vector<CircuitErrors> errors(circuits.size());
  oneapi::tbb::parallel_for(std::size_t{0}, circuits.size(), [&](std::size_t i) {
    if (!interrupted()) errors[i] = circuit_errors(circuits[i], n);
  });
  throw_if_interrupted();
  return errors;
}

/// The errors of one kind of circuit over all numbers of bits.
struct OverBits {
  std::vector<Circuit> circuits;
  std::vector<CircuitErrors> errors;

  template <class Make>
  OverBits(Make make, FixedRounding rounding, unsigned n) {
    for (int bits = kLeastBits; bits <= kMostBits; ++bits)
      circuits.push_back(make(FixedPoint{bits, rounding}));
    errors = errors_of_all(circuits, n);
  }
  /// The first place from which on it holds of all errors, if any.
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

/// How far to trust the errors that were not measured at all steps.
void add_sampling_remark(Table& table, const std::vector<CircuitErrors>& errors) {
  std::size_t parts = 0;
  double rms = 0, energy = 0;
  for (const CircuitErrors& e : errors) {
    if (e.steps_looked_at == e.steps) continue;
    ++parts;
    rms = std::max(rms, e.rms_spread / e.rms);
    energy = std::max(energy, e.energy_spread);
  }
  if (parts > 0)
    table.remarks.push_back(fmt::format(
        "{} of {} variants have more than {} steps, of which {} were looked at: their max is a bracket, and the "
        "standard errors are at most {:.1g} of rms and {:.1g} in energy.",
        parts, errors.size(), kMostSteps, 2 * kCells + 2, rms, energy));
}

/// Compares a circuit with cos^n, step after step.
class Steps {
 public:
  Steps(const Circuit& circuit, unsigned n)
      : circuit_(circuit), n_(n), end_(highlight_end(n)), truth_(cosine(n).value) {}

  /// The first step is 0; this one ends at the highlight's end or beyond.
  std::uint64_t last() const {
    return std::uint64_t(std::ceil(end_ * double(circuit_.f.one()) - up()));
  }

  /// Integrals of the error and of its square over a step.
  struct Sums {
    double drift = 0, square = 0;
  };
  /// Widens the largest errors.
  Sums measure(std::uint64_t step, CircuitErrors& errors) const {
    const FixedPoint f = circuit_.f;
    const double value = f.value(circuit_.value(step)), at = circuit_.ideal(f.value(step));
    const auto edge = [&](double x) { return std::clamp(x / double(f.one()), 0.0, end_); };
    const double from = edge(double(step) + up() - 1), to = edge(double(step) + up());
    const auto largest = [](double& most, double error) { most = std::max(most, std::abs(error)); };
    // The value is constant over a step and cos^n falls, so that the error is largest at the ends.
    const auto error_at = [&](double s) {
      const double ideal = circuit_.ideal(s), truth = truth_(s);
      largest(errors.max, value - truth);
      largest(errors.shape, ideal - truth);
      largest(errors.rounding, value - ideal);
      largest(errors.quantisation, at - ideal);
      return value - truth;
    };
    Sums sums;
    const int pieces = std::max(1, int(std::ceil((to - from) * n_ / kPiece)));
    double a = error_at(from);
    for (int i = 0; i < pieces; ++i) {
      const double width = (to - from) / pieces, begin = from + i * width;
      const double m = error_at(begin + width / 2), b = error_at(begin + width);
      sums.drift += width / 6 * (a + 4 * m + b);
      sums.square += width / 6 * (a * a + 4 * m * m + b * b);
      a = b;
    }
    return sums;
  }

 private:
  double up() const { return circuit_.f.rounding == FixedRounding::kNearest ? 0.5 : 0; }

  const Circuit& circuit_;
  double n_, end_;
  std::function<double(double)> truth_;
};

}  // namespace

Circuit cs_circuit(FixedPoint f, unsigned n, int k) {
  const LobeId lobe = *find_lobe(fmt::format("cs{}", k));
  // The roundings of s and of the base, k times as large by the power, and of each squaring, as much larger as the
  // later ones make it.
  return {std::string(info(lobe).name),
          f,
          fixed_cs_operations(f, n, k),
          unit(f) * (n + 2.0 * k - 1),
          [=](std::uint64_t s) { return fixed_cs(f, n, k, s); },
          prepare(lobe, n).value};
}

Circuit pk_circuit(FixedPoint f, unsigned n, int k) {
  const auto pk = std::make_shared<const FixedPk>(f, n, k);
  const LobeId lobe{find_lobe("pk3.1")->index, std::uint16_t(k)};
  // The roundings of s, n times as large by the slope, which is 1 % more at most; of the three coefficients, which are to
  // nearest, and of the three steps, k times as large by the power; and of each squaring.
  return {std::string(info(lobe).name),
          f,
          pk->operations(),
          unit(f) * (1.01 * n + 3.0 * k + k - 1) + 1.5 * k * std::exp2(-f.bits),
          [pk](std::uint64_t s) { return pk->value(s); },
          prepare(lobe, n).value};
}

Circuit power_circuit(FixedPoint f, unsigned n) {
  // The roundings of s, of the squarings as above, and of at most a product for each bit of n.
  return {"cosine by squaring",
          f,
          fixed_power_operations(f, n),
          unit(f) * (2.0 * n + std::bit_width(n)),
          [=](std::uint64_t s) { return fixed_power(f, n, s); },
          cosine(n).value};
}

CircuitErrors circuit_errors(const Circuit& circuit, unsigned n) {
  const Steps all(circuit, n);
  const double end = highlight_end(n);
  CircuitErrors errors;
  double drift = 0, square = 0, drift_variance = 0, square_variance = 0;
  const auto measure = [&](std::uint64_t step) {
    ++errors.steps_looked_at;
    return all.measure(step, errors);
  };
  const auto add = [&](const Steps::Sums& sums) { drift += sums.drift, square += sums.square; };
  const std::uint64_t last = all.last();
  errors.steps = last + 1;
  if (errors.steps <= kMostSteps) {
    for (std::uint64_t step = 0; step <= last; ++step) add(measure(step));
  } else {
    // The first and the last may be cut. Of the others, two at random stand for each cell: the roundings of a circuit
    // have patterns.
    add(measure(0)), add(measure(last));
    std::mt19937_64 random(errors.steps);
    for (std::uint64_t cell = 0; cell < kCells; ++cell) {
      const std::uint64_t from = 1 + (last - 1) * cell / kCells,
                          size = 1 + (last - 1) * (cell + 1) / kCells - from;
      const std::uint64_t i = random() % size, j = (i + 1 + random() % (size - 1)) % size;
      const Steps::Sums a = measure(from + i), b = measure(from + j);
      const double half = double(size) / 2;
      add({half * (a.drift + b.drift), half * (a.square + b.square)});
      const auto squared = [&](double difference) { return std::pow(half * difference, 2); };
      drift_variance += squared(a.drift - b.drift);
      square_variance += squared(a.square - b.square);
    }
  }
  errors.rms = std::sqrt(square / end);
  errors.energy = std::abs(drift) * (n + 1.0);
  errors.rms_spread = square > 0 ? std::sqrt(square_variance) / (2 * square) * errors.rms : 0;
  errors.energy_spread = std::sqrt(drift_variance) * (n + 1.0);
  errors.max_at_most =
      errors.steps_looked_at == errors.steps ? errors.max : errors.shape + circuit.most_rounding;
  return errors;
}

Table fixed_point_table(unsigned n, const std::vector<int>& bits) {
  Table table;
  table.id = fmt::format("fixed-point-n{}", n);
  table.level = "fixed-point";
  table.title = fmt::format("A lobe in fixed point, n = {}", n);
  table.unit = "bit operations";
  table.per = "evaluation";
  table.errors = lobe_error_kinds();
  const std::vector<Circuit> tried = circuits(n, bits);
  const std::vector<CircuitErrors> errors = errors_of_all(tried, n);
  for (std::size_t i = 0; i < tried.size(); ++i)
    table.variants.push_back(circuit_variant(tried[i], errors[i]));
  for (const FixedRounding rounding : kRoundings)
    for (std::string& remark : remarks_of(n, rounding)) table.remarks.push_back(std::move(remark));
  add_sampling_remark(table, errors);
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
