#include "base/pictures/subsampled_exr.hpp"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "base/pictures/picture_light.hpp"

namespace lobelia {
namespace {

class MemoryStream : public Imf::IStream {
 public:
  explicit MemoryStream(std::string_view bytes) : Imf::IStream("picture"), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || std::size_t(count) > bytes_.size() - at_) throw Iex::InputExc("it is cut off");
    std::memcpy(to, bytes_.data() + at_, std::size_t(count));
    at_ += std::size_t(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override {
    if (to > bytes_.size()) throw Iex::InputExc("it is cut off");
    at_ = to;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// The calling one, as fork() leaves no other.
constexpr int kThreads = 0;

PixelWindow window_of(const Imath::Box2i& box) {
  // Sides that no int holds are refused as those without pixels.
  const auto side = [](int first, int last) {
    const std::int64_t length = std::int64_t{last} - first + 1;
    return length <= std::numeric_limits<int>::max() ? int(length) : 0;
  };
  return {box.min.x, box.min.y, side(box.min.x, box.max.x), side(box.min.y, box.max.y)};
}

PicturePart part_of(const Imf::Header& header) {
  PicturePart part{header.hasName() ? header.name() : "", {}};
  const Imf::ChannelList& channels = header.channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    part.channels.emplace_back(channel.name());
  return part;
}

/// Throws Error(kInput) unless the channel has one value for `side` x `side` pixels.
void require_sampling(const PictureBytes& file, const Imf::Header& header, const std::string& name,
                      int side) {
  const Imf::Channel& channel = header.channels()[name];
  if (channel.xSampling != side || channel.ySampling != side)
    unreadable_picture(
        file.path,
        fmt::format(
            "its channel {} has one value for {} x {} pixels; only chroma (RY and BY beside "
            "Y) may have one for 2 x 2, and any other channel has one a pixel",
            name, channel.xSampling, channel.ySampling));
}

Image read_rgb(const PictureBytes& file, const Imath::Box2i& data, const std::string& prefix) {
  MemoryStream stream(file.bytes);
  Imf::RgbaInputFile input(stream, prefix, kThreads);
  const PixelWindow window = window_of(data);
  Image image(window.width, window.height);
  std::vector<Imf::Rgba> row(std::size_t(window.width));
  for (int y = 0; y < window.height; ++y) {
    // Each row goes to the same place.
    input.setFrameBuffer(Imf::ComputeBasePointer(row.data(), {data.min.x, 0}, window.width), 1, 0);
    input.readPixels(data.min.y + y);
    for (int x = 0; x < window.width; ++x) {
      const Imf::Rgba& from = row[std::size_t(x)];
      const auto to = image.pixel(x, y);
      to[0] = from.r;
      to[1] = from.g;
      to[2] = from.b;
    }
  }
  return image;
}

Image read_channel(Imf::InputFile& input, const Imath::Box2i& data, const std::string& name) {
  const PixelWindow window = window_of(data);
  Image image(window.width, window.height);
  Imf::FrameBuffer buffer;
  constexpr std::size_t kPixel = 3 * sizeof(float);
  buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, image.values().data(), data, kPixel,
                                       kPixel * std::size_t(window.width)));
  input.setFrameBuffer(buffer);
  input.readPixels(data.min.y, data.max.y);
  for (std::size_t i = 0; i < image.values().size(); i += 3)
    image.values()[i + 1] = image.values()[i + 2] = image.values()[i];
  return image;
}

Picture read_layer(const PictureBytes& file, Imf::InputFile& input, const std::string& name) {
  const Imf::Header& header = input.header();
  const PicturePart part = part_of(header);
  const PictureLayer layer = find_layer(file.path.string(), {&part, 1}, name);
  Picture picture;
  PictureSource& source = picture.source;
  source = picture_source("openexr", {&part, 1}, layer);
  source.data = window_of(header.dataWindow());
  source.display = window_of(header.displayWindow());
  if (const std::string problem = windows_problem(source.data, source.display); !problem.empty())
    unreadable_picture(file.path, problem);
  const auto pixels = [](const PixelWindow& window) {
    return std::uint64_t(window.width) * std::uint64_t(window.height);
  };
  if (file.on_header)
    file.on_header({pixels(source.data) + pixels(source.display),
                    pixels(source.data) * part.channels.size() * sizeof(float)});

  const std::string& first = source.channels[0];
  const Imf::PixelType type = header.channels()[first].type;
  source.value_type = type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
  require_sampling(file, header, first, 1);
  if (layer.has_chroma) {
    for (const std::size_t c : {1, 2}) require_sampling(file, header, source.channels[c], 2);
    const std::size_t dot = first.rfind('.');
    picture.image =
        read_rgb(file, header.dataWindow(), dot == first.npos ? "" : first.substr(0, dot));
  } else if (layer.where.size() == 1) {
    picture.image = read_channel(input, header.dataWindow(), first);
  } else {
    unreadable_picture(file.path,
                       "it has chroma (RY, BY), so that only the picture and single "
                       "channels are read");
  }
  ColourMeaning meaning;
  if (layer.is_colour && Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& of = Imf::chromaticities(header);
    meaning.primaries = {of.red.x,  of.red.y,  of.green.x, of.green.y,
                         of.blue.x, of.blue.y, of.white.x, of.white.y};
  }
  decode_colours(file.path, meaning, picture);
  place_on_display(picture);
  return picture;
}

/// The result of `use` for the opened file. Throws Error(kInput) in place of OpenEXR's exceptions.
template <class Use>
auto opened(const PictureBytes& file, const Use& use) {
  try {
    MemoryStream stream(file.bytes);
    Imf::InputFile input(stream, kThreads);
    return use(input);
  } catch (const Iex::BaseExc& problem) {
    unreadable_picture(file.path, problem.what());
  }
}

}  // namespace

Picture read_subsampled_exr(const PictureBytes& file, const std::string& layer) {
  return opened(file, [&](Imf::InputFile& input) { return read_layer(file, input, layer); });
}

std::vector<std::string> subsampled_exr_layers(const PictureBytes& file) {
  return opened(file, [&](const Imf::InputFile& input) {
    const PicturePart part = part_of(input.header());
    return picture_layer_names({&part, 1});
  });
}

}  // namespace lobelia
