// Pictures as bytes, between the program and the process that read them.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/picture.hpp"
#include "core/reading_limits.hpp"

namespace lobelia {

/// The request to the process that reads.
struct ReadingRequest {
  bool names_only = false;  ///< the layers' names, and not a picture
  bool on_one_thread = false;
  std::string format;  ///< of picture_format(), or "": any
  std::string path, layer;
  PictureLimit limit{};
};

/// Its answer, without a picture's values: those follow as they are.
struct ReadingAnswer {
  enum class Kind : std::uint64_t { kRefusal, kNames, kPicture };
  Kind kind = Kind::kRefusal;
  std::string refusal;             ///< one sentence
  std::vector<std::string> names;  ///< of layers
  PictureSource source;
  std::uint64_t width = 0, height = 0;
  bool has_overscan = false;  ///< of the data window; its values follow the picture's
};

/// Longest request and longest answer; an answer may hold the names of a million channels.
inline constexpr std::size_t kMaxRequestBytes = 65536, kMaxAnswerBytes = std::size_t{1} << 28;

std::string pack(const ReadingRequest& request);
std::string pack(const ReadingAnswer& answer);

/// Throw std::runtime_error if the bytes are no such message, or a picture is larger than is read. An answer comes
/// from a process that may do what a hostile file wants.
ReadingRequest unpack_request(std::string_view bytes);
ReadingAnswer unpack_answer(std::string_view bytes);

}  // namespace lobelia
