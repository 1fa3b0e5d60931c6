#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"

namespace lobelia::truth {
namespace {

constexpr auto kR = LobeAngle::kReflection, kH = LobeAngle::kHalfVector;
constexpr ModelRow kRows[] = {
    {"phong_rdf", kR, false, false, false, 1},
    {"modified_phong", kR, true, false, true, 1},
    {"blinn_phong_rdf", kH, false, true, false, 1},
    {"modified_blinn_phong", kH, true, true, true, 1},
    {"blinn_phong_ndf", kH, true, false, false, 4},
    {"blinn_phong_heightfield", kH, true, false, true, 4},
    {"microfacet_smith", kH, true, false, true, 4, true},
};

}  // namespace

const ModelRow& model_row(std::string_view model) {
  const auto* const row = std::ranges::find(kRows, model, &ModelRow::name);
  if (row == std::end(kRows))
    throw Error(ExitCode::kInternal,
                fmt::format("formulas/model.cpp has no row for the model '{}'", model));
  return *row;
}

}  // namespace lobelia::truth
