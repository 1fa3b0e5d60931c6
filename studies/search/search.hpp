// The cheapest lobe within an error, and the front between price and error.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/records/lobe_search.hpp"
#include "base/system/timing.hpp"
#include "renderer/highlight.hpp"
#include "studies/search/shape.hpp"

namespace lobelia::search {

/// Rounds a result to the precision in which a lobe is computed.
struct Rounding {
  std::string name;  ///< "float32", "float16", "fixed:12"
  double step = 0;   ///< of numbers just below 1
  std::function<double(double)> rounded;
};
/// Throws Error(kUsage).
Rounding parse_rounding(const std::string& text);
/// "16..1024", "128", "16..inf". Throws Error(kUsage).
Range parse_range(const std::string& text);

inline constexpr int kMostPrice = 12;
inline constexpr int kUsualPrice = 8;  ///< up to which lobes are listed if nothing is asked for

struct Request {
  Range range;
  std::string metric = "max";  ///< one of records::kSearchMetrics
  Rounding rounding = parse_rounding("float32");
  bool by_n = true;
  std::string family = "all";   ///< one of records::kSearchFamilies
  std::optional<double> error;  ///< the cheapest within it
  std::optional<int> price;     ///< the nearest for it
  std::function<void(double part, const std::string& what)> on_progress = {};
};

/// No lobe is dearer.
int most_price(const Request& request);

/// Finds and proves the best lobe of each shape, cheapest first, until one is within the error that is asked for. `chosen`
/// is empty if nothing is asked for, or no lobe meets it. Throws Error(kUsage) if that error is below the precision's.
records::LobeSearch search(const Request& request);

/// A lobe's error by the metric, with the rounding of the precision: the bound itself for "max".
double error_of(const records::SearchedLobe& lobe, const std::string& metric);

/// The table; the chosen one first, with its formula; or what is the best that is possible.
std::string search_text(const records::LobeSearch& found, const Request& request,
                        bool certificates);
/// Whether the record has what was asked for.
bool is_met(const records::LobeSearch& found, const Request& request);

/// The lobe at `count` values of s, a multiple of 64, aligned for SIMD.
void evaluate(const Lobe& lobe, double n, std::size_t count, const float* s, float* value);

/// Seconds for one value of each lobe and of one of the catalogue, in interleaved rounds, for numbers that the cache holds.
std::vector<Times> times_of(std::span<const Lobe> lobes, const LobeId& last);

}  // namespace lobelia::search
