// The cs16 column outside n = 16..1024, for which the paper gives it.
#include <fmt/format.h>

#include "studies/paper/claim.hpp"
#include "studies/paper/energy.hpp"

namespace lobelia::paper {

Claim outside_the_range() {
  Claim claim{"outside-the-range", "table of coefficients, cs16 column",
              "the energy outside n = 16..1024, where the paper makes no claim", ""};
  for (const RowNumber number : {kPhong, kModifiedPhong, kBlinn, kModifiedBlinn}) {
    const Row& row = kRows[number];
    for (const Real n : {1.0L, 8.0L, 1e6L})
      claim.measured.push_back(fixed(std::string(row.title), energy(row, Lobe::kCs16, n), 5,
                                     n > 100 ? "n = 1e6" : at_exponent(n)));
  }
  claim.definition =
      "printed coefficient times the row's integral over the lobe's support, cut at a right angle: "
      "below 16 the lobe is wider than that, and below 8 theta_cr does not exist";
  claim.reason =
      "above the range the residual is that of the factor of n alone, 1.063, 1.068 or 1.027 for 17/16; "
      "below it the fits fail";
  return claim;
}

}  // namespace lobelia::paper
