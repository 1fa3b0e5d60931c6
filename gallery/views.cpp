#include "gallery/views.hpp"

#include "gallery/cost_page.hpp"
#include "gallery/explorer_page.hpp"
#include "gallery/paper_page.hpp"
#include "gallery/stability_page.hpp"

namespace lobelia::gallery {

std::span<const View> views() {
  static constexpr View kViews[] = {
      {"explorer", "Explorer", "explorer.html", explorer_view},
      {"stability", "Stability", "stability.html", stability_view},
      {"paper", "Paper", "paper.html", paper_view},
      {"cost", "Cost", "cost.html", cost_view},
  };
  return kViews;
}

}  // namespace lobelia::gallery
