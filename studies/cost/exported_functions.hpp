// The functions of `lobelia export --language hlsl --precision min16float`, character for character, computed in emulated
// half floats: HLSL is so close to C++ that a class may have them as members.
#pragma once

#include <string_view>
#include <vector>

#include "core/half.hpp"

namespace lobelia::cost {

template <Subnormals kSubnormals>
class ExportedFunctions {
 public:
  using min16float = HalfOf<kSubnormals>;
  using min16float3 = Half3Of<min16float>;

#include "studies/half_exports.inc"

  using Self = ExportedFunctions;
  struct Entry {
    std::string_view model, lobe;
    min16float (Self::*radiance)(min16float3 normal, min16float3 to_eye, min16float3 to_light,
                                 min16float exponent, min16float coefficient);
    min16float (Self::*lobe_value)(min16float s, min16float n);
  };
  static const std::vector<Entry>& all() {
    static const std::vector<Entry> entries{
#include "studies/half_export_list.inc"
    };
    return entries;
  }
};

}  // namespace lobelia::cost
