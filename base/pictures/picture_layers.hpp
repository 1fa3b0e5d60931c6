// Finds the layers of a picture's file by the names of its channels.
//
// A name is split at its last dot: "diffuse.R" is R of the layer "diffuse". R, G and B (or Red, Green, Blue, in any case)
// with one prefix are a layer of colours, and so are Y, RY and BY (luminance and chroma of an EXR); X and Y, or X, Y and
// Z, with a prefix are a vector; Y without X is grey. Every other channel is a layer of its own, with its full name. The
// order of channels does not matter. In a file of several parts (EXR parts, pages of a TIFF, frames of a GIF) layer names
// begin with the part's name, except in the part that holds the picture.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace lobelia {

struct PicturePart {
  std::string name;  ///< may be empty
  std::vector<std::string> channels;
  int mip_levels = 1;     ///< only the first is read
  std::string view = {};  ///< "left": what a part of a stereo EXR shows
  std::vector<std::string> views =
      {};  ///< all views of a stereo EXR with one part, the default one first
};

struct PictureLayer {
  std::string name;      ///< "" for the picture itself
  std::size_t part = 0;  ///< position in the file
  std::vector<std::size_t>
      where;                ///< channels of the part: R, G, B; a vector's two or three; or one
  bool is_colour = true;    ///< has a transfer curve, unlike alpha, depth and vectors
  std::string alpha = {};   ///< name of the layer with its alpha; "" if there is none
  bool has_chroma = false;  ///< `where` is Y, RY and BY instead of R, G and B
};

/// All layers, with unique names: the picture if there is one, then in the file's order.
std::vector<PictureLayer> picture_layers(std::span<const PicturePart> parts);

/// Their names, in that order.
std::vector<std::string> picture_layer_names(std::span<const PicturePart> parts);

/// Finds a layer by its name, or by that of a channel, of a part (its colours, or its only layer), or by what people call
/// it (base/pictures/layer_names.hpp). "" is the picture: R, G, B without a prefix, else Y without a prefix, else the
/// only layer of colours, else the only one called as renderers call their picture (is_called_picture(); the default
/// view's), else the only channel. Throws Error(kInput) with the file's name `where` and the layers that there are, the
/// nearest first; or with those that the name fits, if it fits several.
PictureLayer find_layer(const std::string& where, std::span<const PicturePart> parts,
                        const std::string& name);

}  // namespace lobelia
