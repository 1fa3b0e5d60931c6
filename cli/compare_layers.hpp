// What `lobelia compare` does about layers: which one is the picture, and what is said of the others.
#pragma once

#include <string>

#include "compare/layers.hpp"

namespace lobelia::cli {

/// `options.layer`, or where all are asked for and one file has no picture, the first that both have.
std::string main_layer(const std::string& a, const std::string& b, const LayerOptions& options);

/// The table's lines: the verdict and the limits of each layer, the layers of one file alone, and what was not
/// compared. `a` and `b` are the files' names.
void print_layers(const OtherLayers& layers, const std::string& a, const std::string& b);

/// A line for each file whose ICC profile says other colours than were assumed.
void print_profiles(const PicturePairSource& sources);

}  // namespace lobelia::cli
