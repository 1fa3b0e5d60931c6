// Every filter, once: the file and a place in this list are all that one takes.
#pragma once

#include "renderer/filters/blackman_harris.hpp"
#include "renderer/filters/box.hpp"
#include "renderer/filters/gaussian.hpp"
#include "renderer/filters/mitchell.hpp"
#include "renderer/filters/tent.hpp"
#include "renderer/type_list.hpp"

namespace lobelia {

/// The box first: it is what a scene has that names none.
using Filters = TypeList<filters::Box, filters::Tent, filters::Gaussian, filters::BlackmanHarris,
                         filters::Mitchell>;

}  // namespace lobelia
