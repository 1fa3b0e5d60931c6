#include "base/pictures/picture_message.hpp"

#include <cmath>
#include <cstring>

#include "base/pictures/orientation.hpp"

namespace lobelia {
namespace {

/// Packer and Unpacker take the fields of a message in the same order, which defines the format.
class Packer {
 public:
  template <class... Fields>
  void fields(const Fields&... all) {
    (add(all), ...);
  }
  std::string bytes;

 private:
  template <class T>
  void add(const T& whole) {
    const auto number = static_cast<std::uint64_t>(whole);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void add(const std::string& text) {
    add(text.size());
    bytes += text;
  }
  void add(const std::vector<std::string>& texts) {
    add(texts.size());
    for (const std::string& text : texts) add(text);
  }
  void add(double number) { add(std::vector<double>{number}); }
  void add(const std::vector<double>& numbers) {
    add(std::string(reinterpret_cast<const char*>(numbers.data()),
                    numbers.size() * sizeof(double)));
  }
  void add(const PixelWindow& window) { fields(window.x, window.y, window.width, window.height); }
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}
  template <class... Fields>
  void fields(Fields&... all) {
    (take(all), ...);
  }
  void end() const {
    if (!bytes_.empty()) throw std::runtime_error("a message is too long");
  }

 private:
  std::string_view take_bytes(std::uint64_t size) {
    if (size > bytes_.size()) throw std::runtime_error("a message ends early");
    const std::string_view result = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return result;
  }
  template <class T>
  void take(T& whole) {
    std::uint64_t number = 0;
    std::memcpy(&number, take_bytes(sizeof number).data(), sizeof number);
    whole = static_cast<T>(number);
  }
  void take(std::string& text) {
    std::uint64_t size = 0;
    take(size);
    text = take_bytes(size);
  }
  void take(std::vector<std::string>& texts) {
    std::uint64_t left = 0;
    // Each text takes at least the bytes of its length, so the message's size bounds the memory.
    for (take(left); left > 0; --left) take(texts.emplace_back());
  }
  void take(double& number) {
    std::vector<double> numbers;
    take(numbers);
    if (numbers.size() != 1 || !std::isfinite(numbers[0]))
      throw std::runtime_error("a message has no number");
    number = numbers[0];
  }
  void take(std::vector<double>& numbers) {
    std::string bytes;
    take(bytes);
    numbers.resize(bytes.size() / sizeof(double));
    if (!numbers.empty())
      std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  }
  void take(PixelWindow& window) { fields(window.x, window.y, window.width, window.height); }
  std::string_view bytes_;
};

/// Names all fields of PictureSource, so that it does not compile when a new one is not sent.
template <class Through, class Source>
void pass_source(Through& through, Source& source) {
  auto& [format, layer, channels, value_type, transfer, multiplied_by_alpha, chromaticities,
         icc_profile, icc_is_srgb, has_gain_map, samples, data, display, orientation, alpha, layers,
         mip_levels, cryptomattes, manifests, as_stored] = source;
  through.fields(format, layer, channels, value_type, transfer, multiplied_by_alpha, chromaticities,
                 icc_profile, icc_is_srgb, has_gain_map, samples, data, display, orientation, alpha,
                 layers, mip_levels, cryptomattes, manifests, as_stored);
}

template <class Through, class Request>
void pass_request(Through& through, Request& request) {
  through.fields(request.names_only, request.on_one_thread, request.as_stored, request.format,
                 request.path, request.layer, request.limit.pixels_of_any_file,
                 request.limit.pixels_per_byte);
}

template <class Through, class Answer>
void pass_answer(Through& through, Answer& answer) {
  through.fields(answer.kind, answer.refusal, answer.names);
  pass_source(through, answer.source);
  through.fields(answer.width, answer.height, answer.has_overscan);
}

}  // namespace

std::string pack(const ReadingRequest& message) {
  Packer packer;
  pass_request(packer, message);
  return packer.bytes;
}

std::string pack(const ReadingAnswer& message) {
  Packer packer;
  pass_answer(packer, message);
  return packer.bytes;
}

ReadingRequest unpack_request(std::string_view bytes) {
  Unpacker unpacker(bytes);
  ReadingRequest message;
  pass_request(unpacker, message);
  unpacker.end();
  return message;
}

ReadingAnswer unpack_answer(std::string_view bytes) {
  Unpacker unpacker(bytes);
  ReadingAnswer message;
  pass_answer(unpacker, message);
  unpacker.end();
  if (message.kind > ReadingAnswer::Kind::kPicture) throw std::runtime_error("an unknown answer");
  if (message.kind != ReadingAnswer::Kind::kPicture) return message;
  if (message.width > kMaxImageSide || message.height > kMaxImageSide)
    throw std::runtime_error("a picture is too large");
  if (message.source.orientation < kUpright || message.source.orientation > kMostOrientation)
    throw std::runtime_error("an orientation without a meaning");
  const PixelWindow picture{0, 0, int(message.width), int(message.height)};
  for (const PixelWindow& window : {picture, message.source.data, message.source.display})
    if (!window_problem("", window).empty()) throw std::runtime_error("a picture is too large");
  return message;
}

}  // namespace lobelia
