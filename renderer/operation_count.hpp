// Counts the arithmetic operations of a lobe or a model by running it on numbers that count them, and prices them.
#pragma once

#include "renderer/highlight.hpp"
#include "renderer/precision.hpp"

namespace lobelia {

struct OperationCount {
  int multiply_add = 0;  ///< a b + c in one instruction
  int multiply = 0, add = 0, divide = 0;
  int root = 0;
  int transcendental = 0;  ///< exp, log, arc sine
  int compare = 0;         ///< including the selection after it; a maximum, a conversion
  friend bool operator==(const OperationCount&, const OperationCount&) = default;
};

/// From s to the lobe's value, without terms that depend on n only: they are computed once a picture.
OperationCount operations(LobeId lobe);

/// From the cosine to the lobe's value by the textbook formula (`definition`); n and k are constants.
OperationCount textbook_operations(LobeId lobe);

/// From the three unit vectors to s, and the product with N.L where the model has it.
OperationCount operations(ModelId model);

/// In multiplications of float32: 1 for a multiply-add, 6 for a division. The one table of prices, by which `search` and
/// `render --accuracy` choose, so that they choose the same on every machine; times are measured beside it.
double price(const OperationCount& count, Precision precision = Precision::kFloat32);
/// The price of a lobe's value. A formula is evaluated node by node, whatever the precision.
double price(const LobeId& lobe, Precision precision = Precision::kFloat32);

}  // namespace lobelia
