#include "gallery/views.hpp"

#include "gallery/cost_page.hpp"

namespace lobelia::gallery {

std::span<const View> views() {
  static constexpr View kViews[] = {
      {"cost", "Cost", "cost.html", cost_view},
  };
  return kViews;
}

}  // namespace lobelia::gallery
