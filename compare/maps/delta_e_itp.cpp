// Delta E ITP of each pixel as shown; formula and source in metrics/delta_e_itp.cpp.
#include "compare/metrics/delta_e_itp.hpp"

#include "compare/maps/difference_map.hpp"

namespace lobelia {
namespace {

std::vector<float> measure(const MapInput& input) {
  return delta_e_itp_of_pixels(input.shown_a, input.shown_b).values;
}

}  // namespace

extern const DifferenceMap delta_e_itp_map;
constinit const DifferenceMap delta_e_itp_map{
    "delta_e_itp",
    "delta E ITP",
    "colour difference as shown to an adapted eye, 1 is just noticeable",
    false,
    true,
    measure};

}  // namespace lobelia
