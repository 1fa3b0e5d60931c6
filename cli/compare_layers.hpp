// What `lobelia compare` does about layers: which one is the picture, and what is said of the others.
#pragma once

#include <optional>
#include <string>

#include "compare/layers.hpp"

namespace lobelia::cli {

struct LayerOptions {
  std::string layer;  ///< "" for the picture itself
  bool all = false;
};

/// `options.layer`, or where all are asked for and one file has no picture, the first that both have.
std::string main_layer(const std::string& a, const std::string& b, const LayerOptions& options);

/// Nothing unless all are asked for.
std::optional<OtherLayers> compare_other_layers(const std::string& a, const std::string& b,
                                                const std::string& main,
                                                const LayerOptions& options,
                                                const ComparisonOptions& comparison);

/// The table's lines: the verdict and the limits of each layer, and the layers of one file alone.
void print_layers(const OtherLayers& layers);

}  // namespace lobelia::cli
