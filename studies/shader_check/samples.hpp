// A shader's values by exponent, and how well a formula fits them.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "studies/shader_check/explain.hpp"
#include "studies/shader_check/formula.hpp"
#include "studies/shader_check/outputs.hpp"

namespace lobelia::shader_check {

/// The values at one exponent.
struct Group {
  double exponent = 1;
  std::vector<Seen> seen;
  std::vector<double> values, errors;  ///< errors: that rounding may leave
};

/// Values are left out where they are no finite number, and in directions where float32 knows little.
std::vector<Group> groups_of(const Observed& observed);
/// Whether the values are half floats, all of them.
bool are_half_floats(const std::vector<Group>& groups);
/// Allows for the rounding of values to half floats.
void allow_half_floats(std::vector<Group>& groups);
/// The first points of each group: a sample, because points are random.
std::vector<Group> some_of(const std::vector<Group>& groups, std::size_t count);

/// The radiances from which the values of a group come, if a chain of outputs was applied to them. Infinite `above` or
/// `below`: any radiance beyond is as good.
struct Radiances {
  std::vector<double> value, below, above, weight;
  double largest = 0;
  bool are_possible = true;  ///< the chain may give all the values
};
std::vector<Radiances> radiances_of(const std::vector<Group>& groups, const Chain& chain);

/// What is added to a highlight: ambient + diffuse N.L.
struct Additions {
  bool ambient = false, diffuse = false, only_lit = false;
  double of_ambient = 0, of_diffuse = 0;
};

/// The differences that a fit leaves, in what rounding may leave.
struct Left {
  double almost_all = 0, most = 0, most_of_peak = 0;
  double penalty() const;  ///< infinite if it is no explanation
};

struct Fit {
  std::vector<double> coefficients, errors;  ///< by group; the error is relative
  std::vector<bool> is_seen;  ///< whether the highlight can be told from nothing there
  Additions additions;
  Left left;
};

/// Groups, and values of formulas at them, which are kept.
class Samples {
 public:
  Samples(std::vector<Group> groups, bool keeps) : groups_(std::move(groups)), keeps_(keeps) {}
  const std::vector<Group>& groups() const { return groups_; }
  /// By group, each formula being that of its exponent.
  std::vector<std::vector<double>> shapes(std::span<const Formula> formulas);

 private:
  const std::vector<double>& lobe(std::size_t group, const Formula& formula);
  const std::vector<double>& factor(std::size_t group, const Formula& formula);
  std::vector<Group> groups_;
  bool keeps_;
  using Key = std::array<std::uint64_t, 10>;
  std::map<Key, std::vector<double>> lobes_, factors_;
};

/// With the coefficient that fits each exponent best, and the additions that fit all together. The formulas are those of
/// the shapes: a higher exponent than the one asked for leaves more rounding.
Fit fit(const std::vector<Group>& groups, const std::vector<Radiances>& radiances,
        std::span<const Formula> formulas, const std::vector<std::vector<double>>& shapes,
        Additions additions = {});

}  // namespace lobelia::shader_check
