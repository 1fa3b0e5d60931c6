// The layers of a picture's file, by the names of its channels.
//
// A name is split at its last dot: "diffuse.R" is R of the layer "diffuse". R, G and B (or Red, Green, Blue;
// capitals or not) of one prefix are a layer. So are X and Y, or X, Y and Z, of a prefix: a vector, no colours.
// Y without X is grey. Every other channel is a layer of its own, under its full name. Their order does not matter.
// In a file of several parts (EXR parts, pages of a TIFF, frames of a GIF) the names of a part begin with the
// part's own, unless they do already or it is the part that holds the picture.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace lobelia {

struct PicturePart {
  std::string name;  ///< may be empty
  std::vector<std::string> channels;
  int mip_levels = 1;  ///< of which the first is read
};

struct PictureLayer {
  std::string name;      ///< "" for the picture itself
  std::size_t part = 0;  ///< position in the file
  std::vector<std::size_t>
      where;              ///< in the part: R, G, B; a vector's two or three; or one channel
  bool is_colour = true;  ///< not alpha, depth, a vector: the transfer curve is for colours
  std::string alpha =
      {};  ///< the layer that is the alpha of these colours: A beside R, G, B; "" if there is none
};

/// All of them, in the file's order, the picture first if it has one. The names differ.
std::vector<PictureLayer> picture_layers(std::span<const PicturePart> parts);

/// By name of a layer, a part or a channel; a part's name means its colours, or the only layer that it has. "" is
/// the picture: R, G, B without a prefix; else Y without a prefix; else the only layer of colours there is; else the
/// only channel there is. Throws Error(kInput) with the file's name `where`, what there is, and the nearest name.
PictureLayer find_layer(const std::string& where, std::span<const PicturePart> parts,
                        const std::string& name);

}  // namespace lobelia
