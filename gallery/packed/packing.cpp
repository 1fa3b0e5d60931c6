#include "gallery/packed/packing.hpp"

#include <zlib.h>

#include "base/system/error.hpp"
#include "base/words/base64.hpp"

namespace lobelia::gallery {

std::string packed_bytes(std::string_view bytes, int level) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  const auto* from = reinterpret_cast<const Bytef*>(bytes.data());
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, from,
                static_cast<uLong>(bytes.size()), level) != Z_OK)
    throw Error(ExitCode::kInternal, "zlib: not enough memory");
  result.resize(size);
  return base64(result);
}

}  // namespace lobelia::gallery
