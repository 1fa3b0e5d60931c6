// How a page first shows a grid of any number of axes.
#pragma once

#include "gallery/cells/shown_farm.hpp"

namespace lobelia::gallery {

/// The first axis runs down, the second groups the columns, the third runs across, and every combination
/// of the others has a section of its own. With fewer axes, or too many columns, there are no groups. The light is
/// always the last axis. -1: no such axis. A single axis that is too long for a line is a list: it has no columns either.
struct GridLayout {
  int rows = -1, groups = -1, columns = -1;
};

/// Throws Error(kInput) if the axes span more places than a page can show.
GridLayout lay_out(const ShownFarm& farm);

}  // namespace lobelia::gallery
