// The messages between the program and lobelia_picture_reader (base/pictures/contained_reader.hpp), as bytes.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/picture.hpp"

namespace lobelia {

/// A packet on the reader's standard input, a socket. Two descriptors come with it: the picture's file and the pipe for
/// the answer.
struct ReadingRequest {
  bool names_only = false;  ///< layer names instead of a picture
  bool on_one_thread = false;
  bool as_stored = false;  ///< see read_stored_picture()
  std::string format;      ///< as picture_format(); "": any
  std::string path, layer;
  PictureLimit limit{};
};

inline constexpr int kRequestDescriptors = 2;
inline constexpr std::uint64_t kNoMoreValues = ~std::uint64_t{0};

/// The answer, without a picture's values: those follow in pieces, each after its length in bytes as a std::uint64_t. In
/// place of a length kNoMoreValues says that decoding failed; then follow the length and the text of a refusal.
struct ReadingAnswer {
  enum class Kind : std::uint64_t { kRefusal, kNames, kPicture };
  Kind kind = Kind::kRefusal;
  std::string refusal;             ///< one sentence
  std::vector<std::string> names;  ///< the layers'
  PictureSource source;
  std::uint64_t width = 0, height = 0;
  bool has_overscan = false;  ///< the overscan's values follow the picture's
};

/// The message that the reader sends when the child that decodes has ended.
struct ReaderVerdict {
  int status = 0;         ///< as of wait(2)
  bool too_long = false;  ///< it was killed after seconds_to_wait()
};

/// Longest request and longest answer; an answer may hold the names of a million channels.
inline constexpr std::size_t kMaxRequestBytes = 65536, kMaxAnswerBytes = std::size_t{1} << 28;

std::string pack(const ReadingRequest& request);
std::string pack(const ReadingAnswer& answer);

/// Throw std::runtime_error for bytes that are no such message and for pictures over the limits of image.hpp. An answer
/// is not trusted: a hostile file may control the process that sends it.
ReadingRequest unpack_request(std::string_view bytes);
ReadingAnswer unpack_answer(std::string_view bytes);

}  // namespace lobelia
