#include "renderer/filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "renderer/filters/catalogue.hpp"

namespace lobelia {
namespace {

constexpr auto kNames = map_types<std::string_view>(Filters{}, []<class F>() { return F::kName; });

/// Steps of the cumulative distribution: the filter is taken as linear within one, off by 1e-7 of it.
constexpr int kSteps = 4096;

}  // namespace

std::span<const std::string_view> filter_names() { return kNames; }
std::string_view name(Filter filter) { return kNames.at(filter.index); }

std::optional<Filter> find_filter(std::string_view name) {
  static constexpr auto kRadii = map_types<double>(Filters{}, []<class F>() { return F::kRadius; });
  const auto index = find_id<std::size_t>(kNames, name);
  if (!index) return std::nullopt;
  return Filter{std::uint8_t(*index), kRadii[*index]};
}

FilterSampler::FilterSampler(Filter filter) : box_(filter.index == 0), radius_(filter.radius) {
  if (box_) return;
  static constexpr auto kValues = map_types<double (*)(double)>(
      Filters{}, []<class F>() -> double (*)(double) { return &F::value; });
  const auto value = kValues.at(filter.index);
  cumulative_.push_back(0);
  double integral = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double here = value(2 * (i + 0.5) / kSteps - 1);
    integral += here;
    negative_.push_back(here < 0);
    cumulative_.push_back(cumulative_.back() + std::abs(here));
  }
  const double total = cumulative_.back();
  for (double& c : cumulative_) c /= total;
  scale_ = total / integral;
}

FilterSampler::Offset FilterSampler::operator()(double u) const {
  if (box_) return {radius_ * (2 * u - 1), 1};
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
  const std::size_t step = std::size_t(above - cumulative_.begin()) - 1;
  const double low = cumulative_[step], width = cumulative_[step + 1] - low;
  const double within = width > 0 ? (u - low) / width : 0.5;
  return {radius_ * (2 * (double(step) + within) / kSteps - 1), negative_[step] ? -scale_ : scale_};
}

}  // namespace lobelia
