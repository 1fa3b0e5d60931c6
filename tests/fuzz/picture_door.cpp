
#include "base/pictures/orientation.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/pictures/picture_message.hpp"
#include "tests/fuzz/bundle.hpp"
#include "tests/fuzz/checks.hpp"

namespace lobelia::fuzz {
namespace {

template <class Message>
void check_message(std::string_view bytes, Message (*unpack)(std::string_view)) {
  Message message;
  try {
    message = unpack(bytes);
  } catch (const Error&) {
    throw std::logic_error("a message is refused as if a user had made it");
  } catch (const std::runtime_error& error) {
    if (std::string_view(error.what()).empty()) throw std::logic_error("refused without a word");
    return;
  }
  // The bytes may differ from ours: a flag that is 2 means true, and is packed as 1.
  const std::string packed = pack(message);
  if (pack(unpack(packed)) != packed)
    throw std::logic_error("a message is accepted and packed to another one");
}

}  // namespace

void check_picture_door(std::string_view bytes) {
  const std::string_view footer = bytes.substr(bytes.size() - std::min(bytes.size(), kFooterBytes));
  for (const char* ending : {".exr", ".tga"}) {
    const auto format = picture_format(bytes, footer, ending);
    is_cut_off(bytes, format);
  }
  is_exr_that_claims_too_much(bytes);
  is_tiff_without_bits(bytes);
  is_heif_of_hdr(bytes);
  has_subsampled_channels(bytes);
  for (const char* format : {"jpeg", "png", "webp", "tiff", "hdr"}) {
    const int stated = stated_orientation(bytes, format, 1);
    const int left = orientation_left_by_libtiff(bytes, stated, 1);
    if (std::min(stated, left) < kUpright || std::max(stated, left) > kMostOrientation)
      throw std::logic_error("an orientation without a meaning");
  }
  png_colour(bytes);
  has_gain_map(bytes);

  static const std::filesystem::path path = scratch() / "picture.tga";
  write_plainly(path, bytes);
  try {
    const PictureFile file(path);
    if (file.size() != bytes.size() || file.read_all() != bytes)
      throw std::logic_error("a picture's file is read as another");
    if (file.known_format().empty()) throw std::logic_error("a format without a name");
  } catch (const Error& error) {
    check_refusal(error);
  }
  check_message<ReadingRequest>(bytes, unpack_request);
  check_message<ReadingAnswer>(bytes, unpack_answer);
}

}  // namespace lobelia::fuzz
