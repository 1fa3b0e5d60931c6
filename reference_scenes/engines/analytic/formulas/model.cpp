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
};

}  // namespace

const ModelRow& model_row(ModelId model) {
  const std::string name(info(model).name);
  const auto* const row =
      std::find_if(std::begin(kRows), std::end(kRows), [&](auto& r) { return r.name == name; });
  if (row == std::end(kRows))
    throw Error(
        ExitCode::kInternal,
        "reference_scenes/engines/analytic/formulas/model.cpp has no row for the model " + name);
  return *row;
}

}  // namespace lobelia::truth
