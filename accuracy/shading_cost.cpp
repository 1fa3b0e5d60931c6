#include "accuracy/shading_cost.hpp"

#include "renderer/operation_count.hpp"

namespace lobelia::accuracy {
namespace {

/// Read off `lobelia cost --level picture reference_scenes/scenes/head_on.xml` with AVX-512, where a
/// multiplication is some 0.015 ms a megapixel (docs/cost.md). Exponentials and logarithms in float64 take
/// more terms on half as many lanes; the rest of a kernel hides part of what simple operations take.
struct Weights {
  double simple, divide_or_root, transcendental;
  double rounding;  ///< of what goes from float64 to float32: nine components, one s, or nothing
};
constexpr Weights kWeights[] = {{1, 6, 28, 4}, {1, 6, 28, 3}, {1.5, 10, 70, 0}};

}  // namespace

double shading_cost(LobeId lobe, Precision precision) {
  const OperationCount count = operations(lobe);
  const Weights& w = kWeights[std::size_t(precision)];
  return w.simple * (count.multiply + count.add + count.compare) +
         w.divide_or_root * (count.divide + count.root) + w.transcendental * count.transcendental +
         w.rounding;
}

}  // namespace lobelia::accuracy
