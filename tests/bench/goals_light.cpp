// Light transport beside Cycles: the time to the same error.
#include <fmt/format.h>

#include <map>

#include "studies/cost/benchmarks.hpp"
#include "studies/cost/convergence.hpp"
#include "tests/bench/goals.hpp"

namespace lobelia::bench {
namespace {

struct Series {
  std::vector<double> samples, seconds, errors;
};

Series series_of(const cost::Table& table, const std::string& start) {
  Series series;
  for (const cost::Variant& variant : table.variants)
    if (variant.name.starts_with(start + ", ") && cost::setting(variant, "samples") > 1) {
      series.samples.push_back(cost::setting(variant, "samples"));
      series.seconds.push_back(variant.seconds->median);
      series.errors.push_back(variant.errors[0].second);
    }
  return series;
}

/// Cycles' error at its most samples, its time for that, and ours.
Round at_equal_error(const cost::Table& table) {
  const std::string ours = "ours", theirs = [&] {
    for (const cost::Variant& variant : table.variants)
      if (!variant.name.starts_with(ours)) return variant.name.substr(0, variant.name.find(','));
    throw std::runtime_error("no other engine traces light here");
  }();
  const Series other = series_of(table, theirs), own = series_of(table, ours);
  if (own.samples.size() < 2 || other.samples.empty())
    throw std::runtime_error("too few numbers of samples");
  const cost::TimeTo time =
      cost::time_to(own.samples, own.seconds, own.errors, other.errors.back());
  return {time.seconds, other.seconds.back()};
}

}  // namespace

void add_light_goals(const Tools&, Goals& goals) {
  struct Case {
    const char *id, *table, *what;
    double goal;
  };
  // One run of the study measures all of them; each round is a run of its own.
  const auto tables = std::make_shared<std::vector<cost::Table>>();
  const auto used = std::make_shared<std::map<std::string, int>>();
  for (const Case& one :
       {Case{"light.sky", "environment", "a sky with a small sun, Cycles' error", 8},
        Case{"light.rectangle", "rectangle_light", "a rectangle of light, Cycles' error", 12},
        Case{"light.between", "inter_reflection", "light from surface to surface", 5}})
    goals.add({one.id, one.what, "s", "Cycles, at the same error", true, one.goal, 1, 0, [=] {
                 if (tables->empty() || (*used)[one.id]++ > 0) {
                   *tables = cost::measure_transport({});
                   used->clear();
                   (*used)[one.id] = 1;
                 }
                 for (const cost::Table& table : *tables)
                   if (table.id.find(one.table) != table.id.npos) return at_equal_error(table);
                 throw std::runtime_error(fmt::format("there is no table of '{}'", one.table));
               }});
}

}  // namespace lobelia::bench
