// The meaning of a layer's values: light, a share of the pixel, a distance, a direction, or the number of an object.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/pictures/picture.hpp"
#include "base/records/comparison.hpp"

namespace lobelia {

/// Named by records::kLayerTypes.
enum class LayerType : std::uint8_t { kColour, kAlpha, kDepth, kVector, kIdentifier };
constexpr std::string_view layer_type_name(LayerType type) {
  return records::kLayerTypes[std::size_t(type)];
}

/// The type of a layer by, in this order:
///   1. the file's metadata: the layers of a Cryptomatte hold identifiers;
///   2. the type of an EXR's channels: 32-bit integers are identifiers;
///   3. its names: A and alpha; single channels such as Z, depth or objectId; vectors such as N, normal, P or motion;
///   4. its channels: x and y, or x, y and z are a vector.
/// All others are colours. So are single channels of a vector: N.x alone has no direction.
LayerType layer_type(const PictureSource& source);

/// A layer of a Cryptomatte, by the layer's name without a channel: "CryptoObject01" has rank 1 of "CryptoObject".
struct CryptomatteRank {
  std::string name;
  int rank = 0;
};

/// The rank that the name says, if its beginning, or the end of that after a dot, is one of `cryptomattes`
/// (PictureSource::cryptomattes), or is called crypto...; nothing for other layers.
std::optional<CryptomatteRank> cryptomatte_rank(std::string_view layer,
                                                std::span<const std::string> cryptomattes);

/// That of the layer that was read, by the names of its channels or its own.
std::optional<CryptomatteRank> cryptomatte_rank(const PictureSource& source);

/// Whether `name` means the layer: it is the name of the layer ("" is that of the picture), the prefix of its channels, its
/// Cryptomatte, or what people call it (base/pictures/layer_names.hpp).
bool is_layer_called(const PictureSource& source, const std::string& name);

}  // namespace lobelia
