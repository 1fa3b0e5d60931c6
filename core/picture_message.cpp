#include "core/picture_message.hpp"

#include <cstring>

namespace lobelia {
namespace {

/// Both go through a message in the same order; that is the whole of the format.
class Packer {
 public:
  void operator()(std::uint64_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes += text;
  }
  std::string bytes;
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}
  void operator()(std::uint64_t& number) {
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
  }
  void operator()(std::string& text) { text = take(number()); }
  std::uint64_t number() {
    std::uint64_t value = 0;
    (*this)(value);
    return value;
  }
  void end() const {
    if (!bytes_.empty()) throw std::runtime_error("a message is too long");
  }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw std::runtime_error("a message ends early");
    const std::string_view result = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return result;
  }
  std::string_view bytes_;
};

template <class T>
void whole(Packer& pack, const T& value) {
  pack(static_cast<std::uint64_t>(value));
}
template <class T>
void whole(Unpacker& unpack, T& value) {
  value = static_cast<T>(unpack.number());
}

void texts(Packer& pack, const std::vector<std::string>& all) {
  pack(all.size());
  for (const std::string& text : all) pack(text);
}
void texts(Unpacker& unpack, std::vector<std::string>& all) {
  // Each takes at least its length's bytes, so that memory is bounded by the message's own.
  for (std::uint64_t left = unpack.number(); left > 0; --left) unpack(all.emplace_back());
}

void numbers(Packer& pack, const std::vector<double>& all) {
  pack(std::string(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(double)));
}
void numbers(Unpacker& unpack, std::vector<double>& all) {
  std::string bytes;
  unpack(bytes);
  all.resize(bytes.size() / sizeof(double));
  if (!all.empty()) std::memcpy(all.data(), bytes.data(), all.size() * sizeof(double));
}

template <class Through, class Window>
void window(Through& through, Window& window) {
  for (auto* side : {&window.x, &window.y, &window.width, &window.height}) whole(through, *side);
}

/// The names have to be all of PictureSource's: this does not compile where one was added and is not sent.
template <class Through, class Source>
void source(Through& through, Source& source) {
  auto& [format, layer, channels, value_type, transfer, multiplied_by_alpha, chromaticities,
         icc_profile, icc_is_srgb, data, display, alpha, layers, mip_levels] = source;
  through(format);
  through(layer);
  texts(through, channels);
  through(value_type);
  through(transfer);
  whole(through, multiplied_by_alpha);
  numbers(through, chromaticities);
  through(icc_profile);
  whole(through, icc_is_srgb);
  window(through, data);
  window(through, display);
  through(alpha);
  texts(through, layers);
  whole(through, mip_levels);
}

template <class Through, class Request>
void request(Through& through, Request& request) {
  whole(through, request.names_only);
  whole(through, request.on_one_thread);
  through(request.format);
  through(request.path);
  through(request.layer);
  through(request.limit.pixels_of_any_file);
  through(request.limit.pixels_per_byte);
}

template <class Through, class Answer>
void answer(Through& through, Answer& answer) {
  whole(through, answer.kind);
  through(answer.refusal);
  texts(through, answer.names);
  source(through, answer.source);
  through(answer.width);
  through(answer.height);
  whole(through, answer.has_overscan);
}

}  // namespace

std::string pack(const ReadingRequest& message) {
  Packer packer;
  request(packer, message);
  return packer.bytes;
}

std::string pack(const ReadingAnswer& message) {
  Packer packer;
  answer(packer, message);
  return packer.bytes;
}

ReadingRequest unpack_request(std::string_view bytes) {
  Unpacker unpacker(bytes);
  ReadingRequest message;
  request(unpacker, message);
  unpacker.end();
  return message;
}

ReadingAnswer unpack_answer(std::string_view bytes) {
  Unpacker unpacker(bytes);
  ReadingAnswer message;
  answer(unpacker, message);
  unpacker.end();
  if (message.kind > ReadingAnswer::Kind::kPicture) throw std::runtime_error("an unknown answer");
  if (message.kind != ReadingAnswer::Kind::kPicture) return message;
  if (message.width > kMaxImageSide || message.height > kMaxImageSide)
    throw std::runtime_error("a picture is too large");
  const PixelWindow picture{0, 0, int(message.width), int(message.height)};
  for (const PixelWindow& window : {picture, message.source.data, message.source.display})
    if (!window_problem("", window).empty()) throw std::runtime_error("a picture is too large");
  return message;
}

}  // namespace lobelia
