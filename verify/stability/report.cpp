#include "verify/stability/report.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <iterator>

#include "core/interrupt.hpp"
#include "verify/stability/cases.hpp"

namespace lobelia::stability {
namespace {

void widen(Answer& worst, const Answer& other) {
  worst.ulp = std::max(worst.ulp, other.ulp);
  worst.of_peak = std::max(worst.of_peak, other.of_peak);
  worst.wrong_pixels += other.wrong_pixels;
}

/// In the order in which they are first met.
template <class Name>
std::vector<Summary> summarise(const Rows& rows, Name name_of, bool by_exponent = false) {
  std::vector<Summary> summaries;
  for (const Row& row : rows) {
    const std::string& name = name_of(row);
    const double exponent = by_exponent ? row.exponent : 0;
    auto found = std::find_if(summaries.begin(), summaries.end(), [&](const Summary& s) {
      return s.group == row.group && s.name == name && s.exponent == exponent;
    });
    if (found == summaries.end()) {
      found = summaries.insert(summaries.end(), {row.group, name});
      found->exponent = exponent;
    }
    ++found->cases;
    found->outside += row.outcome == Outcome::kOutside;
    found->not_compared += row.outcome == Outcome::kNotCompared;
    widen(found->naive, row.naive);
    widen(found->ours, row.ours);
    found->of_bound = std::max(
        {found->of_bound, row.ours.of_peak / row.bound_of_peak, row.ours.ulp / row.bound_ulp});
  }
  return summaries;
}

}  // namespace

std::size_t Report::count(Outcome outcome) const {
  return std::size_t(std::count_if(rows.begin(), rows.end(),
                                   [&](const Row& row) { return row.outcome == outcome; }));
}

Rows all_rows(const std::vector<LobeId>& lobes, const std::function<void(double)>& on_progress) {
  std::vector<std::function<Rows()>> jobs;
  for (const auto rows_of : {lobe_rows, coefficient_rows, vector_rows, density_rows, sphere_rows})
    for (const LobeId lobe : lobes) jobs.push_back([rows_of, lobe] { return rows_of(lobe); });
  for (const double n : kExponents)
    jobs.push_back([&lobes, n] { return precision_rows(lobes, n); });

  std::vector<Rows> parts(jobs.size());
  std::atomic<int> done{0};
  oneapi::tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    if (interrupted()) return;
    parts[i] = jobs[i]();
    on_progress(double(++done) / double(jobs.size()));
  });
  throw_if_interrupted();
  Rows rows;
  for (Rows& part : parts)
    rows.insert(rows.end(), std::make_move_iterator(part.begin()),
                std::make_move_iterator(part.end()));
  return rows;
}

std::vector<Summary> by_lobe(const Rows& rows) {
  return summarise(rows, [](const Row& row) -> const std::string& { return row.lobe; });
}
std::vector<Summary> by_case(const Rows& rows) {
  return summarise(rows, [](const Row& row) -> const std::string& { return row.name; });
}
std::vector<Summary> by_exponent(const Rows& rows) {
  return summarise(
      rows, [](const Row& row) -> const std::string& { return row.lobe; }, true);
}

}  // namespace lobelia::stability
