// Counts the arithmetic of a lobe or a model, by running it on numbers that count.
#pragma once

#include "renderer/highlight.hpp"

namespace lobelia {

struct OperationCount {
  int multiply = 0, add = 0, divide = 0;
  int root = 0;
  int transcendental = 0;  ///< exp, log, arc sine
  int compare = 0;         ///< with the choice that follows it
  friend bool operator==(const OperationCount&, const OperationCount&) = default;
};

/// From s to the lobe's value. What depends on n only is not counted: it is computed once a picture.
OperationCount operations(LobeId lobe);

/// From the cosine to the lobe's value as a textbook writes it (`definition`); n and k are constants.
OperationCount textbook_operations(LobeId lobe);

/// From the three unit vectors to s, and the product with N.L where the model has it.
OperationCount operations(ModelId model);

}  // namespace lobelia
