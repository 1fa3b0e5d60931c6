// From the values of a file to light: which curve they were encoded with.
#pragma once

#include <string>
#include <string_view>

#include "core/image.hpp"

namespace lobelia {

struct TransferCurve {
  enum class Kind { kLinear, kSrgb, kRec709, kPower };
  Kind kind = Kind::kLinear;
  double gamma = 1;  ///< of a kPower: light = value^gamma
  std::string name;  ///< for the record: "linear", "sRGB", "Rec709", "gamma 1.8", ...
};

/// What a file says of its values, as OpenImageIO hands it on.
struct EncodingStatement {
  std::string_view format;  ///< "png"
  std::string_view space;   ///< "oiio:ColorSpace"; empty if it says nothing
  double gamma = 1;         ///< "oiio:Gamma"
  bool is_float = false;    ///< half, float or double values
};

/// The curve of the colours. Throws Error(kInput) with the file's name `where` if it is none that is read.
/// A file that says nothing is sRGB if its values are integers, otherwise linear.
TransferCurve transfer_curve(const std::string& where, const EncodingStatement& statement);

/// In place. What is below 0 stays as it is, but for sRGB's and Rec. 709's straight pieces.
void decode(const TransferCurve& curve, Image& image);

}  // namespace lobelia
