// The catalogue of filters. To add one: write its file, include it here, add it to the list.
#pragma once

#include "renderer/filters/blackman_harris.hpp"
#include "renderer/filters/box.hpp"
#include "renderer/filters/gaussian.hpp"
#include "renderer/filters/mitchell.hpp"
#include "renderer/filters/tent.hpp"
#include "renderer/type_list.hpp"

namespace lobelia {

/// The box is first: it is the default.
using Filters = TypeList<filters::Box, filters::Tent, filters::Gaussian, filters::BlackmanHarris,
                         filters::Mitchell>;

}  // namespace lobelia
