// Cases of the laws: the catalogues, crossed. A model or a lobe that joins its catalogue is
// tested by every law without a line of test code.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <ostream>

#include "base/words/constants.hpp"
#include "renderer/highlight.hpp"
#include "renderer/lobe_properties.hpp"
#include "tests/test.hpp"

namespace lobelia {

inline constexpr double kExponents[] = {0.1, 1, 2, 15.9, 16, 54, 128, 1024, 1e4, 1e6, 1e8};
inline constexpr double kSampledExponents[] = {1, 16, 1024,
                                               1e5};  ///< where each costs many samples

inline double radians(double degrees) { return degrees * kPi / 180; }

inline std::string text(const Highlight& h) {
  return fmt::format("{} {} {} n = {:g}", info(h.model).name, info(h.lobe).name,
                     name(h.normalisation), h.exponent);
}
inline void PrintTo(const Highlight& h, std::ostream* out) { *out << text(h); }

/// A test that loops over nothing would pass whatever it says.
template <class T>
std::vector<T> not_empty(std::vector<T> cases) {
  if (cases.empty()) ADD_FAILURE() << "there is no case to test";
  return cases;
}

/// Every listed lobe, an order that is no power of two, and the highest order.
inline std::vector<LobeId> lobes() {
  const auto listed = all_lobes();
  std::vector<LobeId> result(listed.begin(), listed.end());
  for (const char* name : {"cs12", "cs1024"}) result.push_back(*find_lobe(name));
  return not_empty(result);
}

inline std::vector<ModelId> models_where(auto&& predicate) {
  std::vector<ModelId> result;
  for (const ModelId model : all_models())
    if (predicate(info(model))) result.push_back(model);
  return not_empty(result);
}
inline std::vector<ModelId> every_model() {
  return models_where([](const ModelInfo&) { return true; });
}

/// Models x lobes x exponents.
inline std::vector<Highlight> highlights(const std::vector<ModelId>& models, const auto& exponents,
                                         Normalisation normalisation = Normalisation::kExact) {
  std::vector<Highlight> result;
  for (const ModelId model : models)
    for (const LobeId& lobe : lobes())
      if (normalisation == Normalisation::kExact || has_paper_coefficient(lobe))
        for (const double n : exponents) result.push_back({model, lobe, normalisation, n});
  return not_empty(result);
}

/// The same in both normalisations.
inline std::vector<Highlight> highlights_of_both(const std::vector<ModelId>& models,
                                                 const auto& exponents) {
  std::vector<Highlight> result = highlights(models, exponents),
                         paper = highlights(models, exponents, Normalisation::kPaper);
  result.insert(result.end(), paper.begin(), paper.end());
  return result;
}

}  // namespace lobelia
