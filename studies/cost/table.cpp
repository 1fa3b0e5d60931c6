#include "studies/cost/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace lobelia::cost {
namespace {

/// "1.8 times", "170 times", "1.3e+04 times", "infinitely many times"
std::string times_text(double more, double less) {
  const double ratio = less != 0   ? more / less
                       : more == 0 ? 1
                                   : std::numeric_limits<double>::infinity();
  if (!std::isfinite(ratio)) return "infinitely many times";
  if (ratio >= 9999.5) return fmt::format("{:.2g} times", ratio);
  return fmt::format("{:.{}f} times", ratio, ratio < 9.95 ? 1 : 0);
}

}  // namespace

records::CostSeconds seconds_record(const Times& times) {
  return {times.median, times.spread, times.least, times.most, times.rounds};
}

records::CostSeconds cost_of(const Variant& variant) {
  if (variant.seconds) return *variant.seconds;
  const double count = variant.count.value_or(0);
  return {count, 0, count, count, 0};
}

double setting(const Variant& variant, std::string_view name) {
  const std::string* value = records::find(variant.settings, name);
  return value ? std::strtod(value->c_str(), nullptr) : std::numeric_limits<double>::quiet_NaN();
}

int clearly_slower(const Variant& a, const Variant& b) {
  const records::CostSeconds of_a = cost_of(a), of_b = cost_of(b);
  const double noise = of_a.spread * of_a.median + of_b.spread * of_b.median;
  const double difference = of_b.median - of_a.median;
  return difference > noise ? 1 : difference < -noise ? -1 : 0;
}

records::CostFront pareto_front(const Table& table, std::size_t error) {
  struct Point {
    const Variant* variant;
    double cost, error;
    const Point* better = nullptr;  ///< of the front
  };
  std::vector<Point> points;
  for (const Variant& variant : table.ways)
    if (!std::isnan(variant.errors[error].second))
      points.push_back({&variant, cost_of(variant).median, variant.errors[error].second});
  std::vector<Point*> order;
  for (Point& point : points) order.push_back(&point);
  std::ranges::stable_sort(order, [](const Point* a, const Point* b) {
    return a->cost != b->cost ? a->cost < b->cost : a->error < b->error;
  });
  std::vector<const Point*> front;
  for (Point* point : order) {
    // The fastest that is as accurate: what one would take instead.
    const auto better =
        std::ranges::find_if(front, [&](const Point* f) { return f->error <= point->error; });
    if (better == front.end())
      front.push_back(point);
    else
      point->better = *better;
  }

  records::CostFront record;
  record.chart = table.id + "-" + table.errors[error].id + ".svg";
  const std::string unit = is_timed(table) ? "time" : table.unit;
  for (std::size_t i = 0; i < front.size(); ++i) {
    record.ways.push_back(front[i]->variant->name);
    if (i == 0) continue;
    const Point &from = *front[i - 1], &to = *front[i];
    record.in_words.push_back(
        fmt::format("from {} to {}: {} the {}, {} less error", from.variant->name, to.variant->name,
                    times_text(to.cost, from.cost), unit, times_text(from.error, to.error)));
  }
  for (const Point& point : points) {
    if (!point.better) continue;
    const Point& better = *point.better;
    const bool same = better.error == 0 ? point.error == 0 : point.error / better.error < 1.005;
    record.dominated_by.emplace_back(point.variant->name, better.variant->name);
    record.in_words.push_back(fmt::format("{} takes {} the {} of {} and has {}its error",
                                          point.variant->name, times_text(point.cost, better.cost),
                                          unit, better.variant->name,
                                          same ? "" : times_text(point.error, better.error) + " "));
  }
  return record;
}

void add_fronts(Table& table) {
  for (std::size_t e = 0; e < table.errors.size(); ++e)
    table.fronts.emplace_back(table.errors[e].id, pareto_front(table, e));
}

}  // namespace lobelia::cost
