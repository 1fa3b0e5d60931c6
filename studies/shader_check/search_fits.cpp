// Numbers that a shader has in place of the model's: a reflectance, a floor, an exponent.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "studies/shader_check/search.hpp"

namespace lobelia::shader_check {
namespace {

/// Two decimal digits where the number has no more, else four.
std::string number(double value) {
  const std::string shortest = fmt::format("{:.2g}", value);
  return std::abs(std::strtod(shortest.c_str(), nullptr) / value - 1) < 2e-3
             ? shortest
             : fmt::format("{:.4g}", value);
}
/// The number that is printed, because people write round ones.
double rounded(double value) { return std::strtod(number(value).c_str(), nullptr); }

/// A value with a larger relative error tells nothing of a number.
constexpr double kUnclearValue = 0.02;
/// No floor of 4 (N.L) (N.V) is higher.
constexpr double kFarFromFloors = 0.8;

/// A mean weighted by errors.
class Mean {
 public:
  void add(double value, double error) {
    const double weight = 1 / (error * error);
    if (!std::isfinite(weight) || !std::isfinite(value)) return;
    sum_ += weight * value, weights_ += weight;
  }
  double value() const { return weights_ > 0 ? sum_ / weights_ : 0; }

 private:
  double sum_ = 0, weights_ = 0;
};

/// y = slope x + offset by least squares.
class Line {
 public:
  void add(double x, double y, double error) {
    const double w = 1 / (error * error);
    w_ += w, x_ += w * x, xx_ += w * x * x, y_ += w * y, xy_ += w * x * y;
  }
  std::pair<double, double> fit() const {
    const double d = determinant();
    return d > 0 ? std::pair{(w_ * xy_ - x_ * y_) / d, (xx_ * y_ - x_ * xy_) / d}
                 : std::pair{0.0, 0.0};
  }
  double error_of_slope() const { return std::sqrt(w_ / determinant()); }
  double error_of_offset() const { return std::sqrt(xx_ / determinant()); }

 private:
  double determinant() const { return w_ * xx_ - x_ * x_; }
  double w_ = 0, x_ = 0, xx_ = 0, y_ = 0, xy_ = 0;
};

double over_both_cosines(double l, double v, const Geometry&, double) { return 1 / (l * v); }

double fifth_power(double cosine) {
  const double one_minus = 1 - std::clamp(cosine, 0.0, 1.0);
  return std::pow(one_minus, 5);
}
struct FresnelPower {
  std::string_view of;
  double (*power)(const Geometry&);
};
constexpr FresnelPower kFresnelPowers[] = {
    {"", fresnel_power},
    {" of N.V in place of V.H,", [](const Geometry& g) { return fifth_power(g.n_dot_v); }},
    {" by Karis's power of 2,", [](const Geometry& g) {
       const double c = std::max(g.v_dot_h, 0.0);
       return std::exp2((-5.55473 * c - 6.98316) * c);
     }}};

/// The exponent with the smallest weighted squares that are left, of a formula at one exponent.
double best_exponent(Formula formula, const Group& group, const Radiances& radiances) {
  const auto left = [&](double log_n) {
    formula.exponent = std::exp(log_n);
    const std::vector<double> shape = shape_values(formula, group.seen);
    double ss = 0, sy = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      ss += radiances.weight[i] * shape[i] * shape[i];
      sy += radiances.weight[i] * shape[i] * radiances.value[i];
    }
    return ss > 0 && sy > 0 ? -sy * sy / ss : 0;
  };
  double best = 0, least = 0;
  constexpr double kFrom = -2, kTo = 11, kStep = 0.4;
  for (double at = kFrom; at < kTo; at += kStep)
    if (const double value = left(at); value < least) least = value, best = at;
  double low = best - kStep, high = best + kStep;
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = left(a), at_b = left(b);
  while (high - low > 1e-7) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a, a = high - kGolden * (high - low), at_a = left(a);
    } else {
      low = a, a = b, at_a = at_b, b = low + kGolden * (high - low), at_b = left(b);
    }
  }
  return std::exp((low + high) / 2);
}

}  // namespace

std::vector<const Mistake*> Search::fitted_fresnel(const Shape& shape, const Chain& chain) {
  const std::vector<Formula> formula = formulas(shape);
  const std::vector<Group>& groups = values_.some.samples.groups();
  const std::vector<Radiances>& radiances = values_.some.of(chain);
  const std::vector<std::vector<double>> shapes = values_.some.samples.shapes(formula);
  std::vector<const Mistake*> all;
  for (const auto& [of, power] : kFresnelPowers) {
    // c (F0 + (1 - F0) w) as a + b w: F0 is a / (a + b).
    double sum = 0, weights = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      double aa = 0, ab = 0, bb = 0, ay = 0, by = 0;
      for (std::size_t i = 0; i < shapes[g].size(); ++i) {
        const double w = radiances[g].weight[i], a = shapes[g][i],
                     b = a * power(groups[g].seen[i].as(formula[g].reversed)),
                     y = radiances[g].value[i];
        aa += w * a * a, ab += w * a * b, bb += w * b * b, ay += w * a * y, by += w * b * y;
      }
      const double determinant = aa * bb - ab * ab;
      if (!(determinant > 1e-9 * aa * bb)) continue;
      const double a = (ay * bb - by * ab) / determinant, b = (aa * by - ab * ay) / determinant;
      const double c = a + b, f0 = a / c;
      if (!(c > 0) || !(f0 > 0) || !(f0 < 1)) continue;
      const double weight = determinant / aa * c * c;
      sum += weight * f0, weights += weight;
    }
    if (weights == 0) continue;
    const double f0 = rounded(sum / weights);
    if (f0 < 1e-4 || f0 > 0.99) continue;
    all.push_back(keep({"fresnel", Part::kFresnel,
                        fmt::format("a Fresnel factor{} of F0 = {} is in it", of, number(f0)),
                        nullptr, [f0, power = power](Formula& f, double) {
                          f.f0 = f0;
                          f.fresnel = power;
                        }}));
  }
  return all;
}

std::vector<const Mistake*> Search::fitted_floors(const Shape& shape, const Chain& chain) {
  std::vector<Formula> formula = formulas(shape);
  // Few points are behind the surface and in the lobe: a sample may have none.
  const std::vector<Group>& groups = values_.all.samples.groups();
  const std::vector<Radiances>& radiances = values_.all.of(chain);
  const std::vector<std::vector<double>> shapes = values_.all.samples.shapes(formula);
  const bool has_cosine = formula.front().cosine != nullptr;
  double light = 0, light_weight = 0, lobe = 0, best_lobe = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    double ss = 0, sy = 0;
    for (std::size_t i = 0; i < shapes[g].size(); ++i) {
      ss += radiances[g].weight[i] * shapes[g][i] * shapes[g][i];
      sy += radiances[g].weight[i] * shapes[g][i] * radiances[g].value[i];
    }
    if (!(ss > 0) || !(sy > 0)) continue;
    const double c = sy / ss;
    // Behind the surface the floor is the cosine; where the lobe's own cosine is below 0, its power is.
    formula[g].behind = Formula::Behind::kLeast;
    formula[g].least_light = 1e-6;
    const std::vector<double> behind = shape_values(formula[g], groups[g].seen);
    formula[g].behind = Formula::Behind::kBlack;
    const std::vector<double> factors = factor_values(formula[g], groups[g].seen);
    double fs = 0, fy = 0;
    for (std::size_t i = 0; i < behind.size(); ++i) {
      const Geometry& seen = groups[g].seen[i].as(formula[g].reversed);
      const double w = radiances[g].weight[i], y = radiances[g].value[i];
      if (seen.n_dot_l <= 0) {
        const double v = c * behind[i] / 1e-6;
        light += w * v * y, light_weight += w * v * v;
      } else if (shapes[g][i] == 0) {
        fs += w * c * c * factors[i] * factors[i], fy += w * c * factors[i] * y;
      }
    }
    if (fs > 0 && fy > 0 && fs > best_lobe)
      best_lobe = fs, lobe = std::pow(fy / fs, 1 / formula[g].exponent);
  }
  std::vector<const Mistake*> all;
  const auto is_floor = [](double value) { return value > 1e-7 && value < 0.6; };
  const auto add = [&](double of_light, double of_lobe) {
    const std::string words =
        of_light > 0 && of_lobe > 0
            ? fmt::format("a floor is in it: max(N.L, {}), and max(..., {}) in the lobe",
                          number(of_light), number(of_lobe))
            : fmt::format("a floor is in it: max({}, {})",
                          of_light > 0 ? "N.L" : "the lobe's cosine",
                          number(of_light > 0 ? of_light : of_lobe));
    all.push_back(
        keep({"floor", Part::kFloor, words, nullptr, [of_light, of_lobe](Formula& f, double) {
                if (of_light > 0) f.behind = Formula::Behind::kLeast;
                f.least_light = of_light;
                f.least_cosine = of_lobe;
              }}));
  };
  const double of_light = has_cosine && light_weight > 0 && is_floor(light / light_weight)
                              ? rounded(light / light_weight)
                              : 0;
  const double of_lobe = is_floor(lobe) ? rounded(lobe) : 0;
  if (of_light > 0) add(of_light, 0);
  if (of_lobe > 0) add(0, of_lobe);
  if (of_light > 0 && of_lobe > 0) add(of_light, of_lobe);
  // The same floor in both: it is hard to see in a power.
  if (of_light > 0 && of_lobe != of_light) add(of_light, of_light);
  return all;
}

std::vector<const Mistake*> Search::fitted_guards(const Shape& shape, const Chain& chain) {
  std::vector<Formula> formula = formulas(shape);
  const bool has_term = formula.front().geometry_term != nullptr;
  if (!has_term && info(highlight_.model).normalised == NormalisedQuantity::kRadiance) return {};
  if (!has_term)
    for (Formula& one : formula) one.geometry_term = over_both_cosines;
  const std::vector<Group>& groups = values_.all.samples.groups();
  const std::vector<Radiances>& radiances = values_.all.of(chain);
  const std::vector<std::vector<double>> shapes = values_.all.samples.shapes(formula);
  // shape P / value is (P + more) / c for P = 4 (N.L) (N.V), and max(P, least) / c.
  Mean more, least;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Line line;
    Mean coefficient;
    std::vector<std::array<double, 3>> points;  // P, shape P / value, its error
    for (std::size_t i = 0; i < shapes[g].size(); ++i) {
      const Geometry& seen = groups[g].seen[i].as(formula[g].reversed);
      const double product = 4 * std::abs(seen.n_dot_l * seen.n_dot_v),
                   value = radiances[g].value[i], weight = radiances[g].weight[i];
      const double relative = weight > 0 ? 1 / (std::abs(value) * std::sqrt(weight)) : 1;
      if (!(shapes[g][i] * value > 0) || relative > kUnclearValue) continue;
      const double quotient = shapes[g][i] * product / value;
      points.push_back({product, quotient, quotient * relative});
      line.add(product, quotient, quotient * relative);
      if (product > kFarFromFloors)
        coefficient.add(product / quotient, relative * product / quotient);
    }
    const auto [slope, offset] = line.fit();
    if (slope > 0) more.add(offset / slope, line.error_of_offset() / slope);
    for (const auto& [product, quotient, error] : points)
      if (const double floor = coefficient.value() * quotient; floor > 1.05 * product)
        least.add(floor, coefficient.value() * error);
  }
  std::vector<const Mistake*> all;
  const auto add = [&](double of_least, double of_more, const std::string& denominator) {
    all.push_back(
        keep({"denominator-floor", Part::kGuard,
              has_term ? fmt::format("the denominator is {}", denominator)
                       : fmt::format("it is divided by {}, without a geometry term", denominator),
              nullptr, [of_least, of_more, has_term](Formula& f, double) {
                if (!has_term) f.geometry_term = over_both_cosines;
                f.least_product = of_least;
                f.more_product = of_more;
              }}));
  };
  const auto is_floor = [](double value) { return value > 1e-6 && value < kFarFromFloors; };
  if (const double value = rounded(least.value()); is_floor(value))
    add(value, 0, fmt::format("max(4 (N.L)(N.V), {})", number(value)));
  if (const double value = rounded(more.value()); is_floor(value))
    add(0, value, fmt::format("4 (N.L)(N.V) + {}", number(value)));
  return all;
}

std::vector<const OutputStep*> Search::fitted_powers(const Shape& shape) {
  const std::vector<Formula> formula = formulas(shape);
  const std::vector<Group>& groups = values_.all.samples.groups();
  const std::vector<std::vector<double>> shapes = values_.all.samples.shapes(formula);
  Mean mean;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Line line;
    for (std::size_t i = 0; i < shapes[g].size(); ++i) {
      const double value = groups[g].values[i];
      // A value of 1 may be that of a clamp.
      if (!(value > 0) || std::abs(value - 1) < 1e-6 || !(shapes[g][i] > 0)) continue;
      const double relative = groups[g].errors[i] / value;
      if (relative < kUnclearValue) line.add(std::log(shapes[g][i]), std::log(value), relative);
    }
    const auto [slope, offset] = line.fit();
    if (slope > 0) mean.add(slope, line.error_of_slope());
  }
  const double power = mean.value();
  if (!(power > 0.2) || !(power < 5) || std::abs(power - 1) < 2e-3) return {};
  std::vector<const OutputStep*> all;
  const double root = std::round(10 / power) / 10;
  if (std::abs(root * power - 1) < 2e-3)
    all.push_back(values_.power(1 / root, fmt::format("1 / {:g}", root)));
  all.push_back(values_.power(rounded(power), number(power)));
  return all;
}

const Mistake* Search::fitted_exponent(const Shape& shape) {
  const std::vector<Group>& groups = values_.some.samples.groups();
  if (groups.size() < 2) return nullptr;
  const std::vector<Formula> formula = formulas(shape);
  const std::vector<Radiances>& radiances = values_.some.of({});
  std::vector<double> found;
  for (std::size_t g = 0; g < groups.size(); ++g)
    found.push_back(best_exponent(formula[g], groups[g], radiances[g]));
  const auto is = [&](const auto& rule) {
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (std::abs(found[g] / rule(groups[g].exponent) - 1) > 2e-3) return false;
    return true;
  };
  const double constant = rounded(found[0]), share = rounded(found[0] / groups[0].exponent);
  if (is([&](double) { return constant; }))
    return keep({"exponent-fixed", Part::kExponent,
                 fmt::format("the exponent is {}, whatever n", number(constant)), nullptr,
                 [constant](Formula& f, double) { f.exponent = constant; }});
  if (std::abs(share - 1) > 2e-3 && is([&](double n) { return share * n; }))
    return keep({"exponent", Part::kExponent,
                 fmt::format("{} n is used where n is expected", number(share)), nullptr,
                 [share](Formula& f, double n) { f.exponent = share * n; }});
  const double added = rounded(found[0] - groups[0].exponent);
  if (std::abs(added) > 2e-3 && is([&](double n) { return n + added; }))
    return keep({"exponent", Part::kExponent,
                 fmt::format("n {} {} is used where n is expected", added < 0 ? "-" : "+",
                             number(std::abs(added))),
                 nullptr, [added](Formula& f, double n) { f.exponent = n + added; }});
  return nullptr;
}

}  // namespace lobelia::shader_check
