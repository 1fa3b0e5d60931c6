// Counts the arithmetic operations of a lobe or a model by running it on numbers that count them.
#pragma once

#include "renderer/highlight.hpp"

namespace lobelia {

struct OperationCount {
  int multiply = 0, add = 0, divide = 0;
  int root = 0;
  int transcendental = 0;  ///< exp, log, arc sine
  int compare = 0;         ///< including the selection after it
  friend bool operator==(const OperationCount&, const OperationCount&) = default;
};

/// From s to the lobe's value, without terms that depend on n only: they are computed once a picture.
OperationCount operations(LobeId lobe);

/// From the cosine to the lobe's value by the textbook formula (`definition`); n and k are constants.
OperationCount textbook_operations(LobeId lobe);

/// From the three unit vectors to s, and the product with N.L where the model has it.
OperationCount operations(ModelId model);

}  // namespace lobelia
