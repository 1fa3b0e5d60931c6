#include "gallery/pages/views.hpp"

// In the order of the navigation. NAME_page.cpp defines `const View NAME_view`.
#define LOBELIA_VIEWS(VIEW) \
  VIEW(explorer) VIEW(stability) VIEW(paper) VIEW(cost) VIEW(search) VIEW(bench)

namespace lobelia::gallery {

#define LOBELIA_DECLARE(name) extern const View name##_view;
LOBELIA_VIEWS(LOBELIA_DECLARE)
#undef LOBELIA_DECLARE

std::span<const View* const> views() {
#define LOBELIA_ADDRESS(name) &name##_view,
  static constexpr const View* kViews[] = {LOBELIA_VIEWS(LOBELIA_ADDRESS)};
#undef LOBELIA_ADDRESS
  return kViews;
}

}  // namespace lobelia::gallery
