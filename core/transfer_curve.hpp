// From the values of a file to light: which curve they were encoded with.
#pragma once

#include <string>
#include <string_view>

#include "core/image.hpp"
#include "core/picture_bytes.hpp"

namespace lobelia {

struct TransferCurve {
  enum class Kind { kLinear, kSrgb, kRec709, kPower };
  Kind kind = Kind::kLinear;
  double gamma = 1;  ///< of a kPower: light = value^gamma
  std::string name;  ///< for the record: "linear", "sRGB", "Rec709", "gamma 1.8", ...
};

/// The encoding that a file states, as OpenImageIO reports it.
struct EncodingStatement {
  std::string_view format;  ///< "dpx"
  std::string_view space;   ///< "oiio:ColorSpace"; empty if it says nothing
  double gamma = 1;         ///< "oiio:Gamma"
  bool is_float = false;    ///< half, float or double values
};

/// The curve of the colours of any format but PNG. A format that has a field for it (DPX, Cineon, TGA, Radiance, RLA)
/// says it; of others `space` is a text of the library or what it assumes, and does not count: integers are sRGB,
/// floats linear, and so is an EXR. Throws Error(kInput) with the file's name `where` if it is none that is read.
TransferCurve transfer_curve(const std::string& where, const EncodingStatement& statement);

/// The same of a PNG, by its chunks: cICP, else sRGB, else gAMA, else sRGB.
TransferCurve transfer_curve(const std::string& where, const PngColour& colour);

/// In place. What is below 0 stays as it is, but for sRGB's and Rec. 709's straight pieces.
void decode(const TransferCurve& curve, Image& image);

}  // namespace lobelia
