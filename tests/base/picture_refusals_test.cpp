// Picture files that are refused, each in one line that says why.
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include "base/pictures/image_io.hpp"
#include "base/pictures/picture_file.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/base/picture_fixture.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

using Refusals = PictureFiles;

TEST_F(Refusals, MeetATiffOfOneBitThatDoesNotSaySo) {
  // 0x0f is four black and four white pixels.
  Tiff one{.width = 8, .height = 1, .samples_per_pixel = 1, .bits = 1, .photometric = 1};
  one.samples = "\x0f";
  const Image read = read_image(file("a.tif", tiff_file(one)));
  for (int x = 0; x < 8; ++x) EXPECT_EQ(read.pixel(x, 0)[0], x < 4 ? 0 : 1) << x;
  one.says_bits = false;
  for (const bool first : {false, true}) {
    one.directory_first = first;
    EXPECT_THAT(refusal(file("b.tif", tiff_file(one))), HasSubstr("no BitsPerSample"));
  }
  EXPECT_FALSE(is_tiff_without_bits("II*"));
  EXPECT_FALSE(is_tiff_without_bits(std::string("II*\0\x08\0\0\0\xff\xff", 10)));
}

TEST_F(Refusals, MeetAFileThatIsCutOffAnywhere) {
  const std::string pixels(75, 'x');
  struct Whole {
    const char* name;
    std::string bytes;
    std::size_t spare = 0;  ///< at the end, without a pixel: a PNG's last chunk, a TIFF's "no more"
  };
  const Whole files[] = {
      {"a.png", png_file({.width = 5, .height = 5, .samples = pixels}), 12},
      {"a.tif", tiff_file({.width = 5, .height = 5, .samples = pixels}), 4},
      {"b.tif", tiff_file({.width = 5, .height = 5, .samples = pixels, .directory_first = true}),
       1},
      {"a.jpg", grey_jpeg_file(3)},
      {"a.hdr", hdr_file(5, 5, std::string(100, 'x'))},
      {"a.ppm", "P6 5 5 255\n" + pixels},
      {"a.pfm", pfm_file(5, 5, std::vector<float>(75))},
      {"a.exr",
       read_file(exr("whole.exr", 5, 40, {{"Y", std::vector<float>(200, 0.5f)}}), 1 << 20)},
  };
  for (const auto& [name, bytes, spare] : files) {
    read_image(file(name, bytes));
    const std::size_t end = bytes.size() - spare, step = more_samples() == 1 ? 37 : 7;
    const std::size_t every_byte_from =
        end - std::min<std::size_t>(end, more_samples() == 1 ? 4 : 20);
    for (std::size_t length = 0; length < end;
         length = length < every_byte_from ? std::min(length + step, every_byte_from)
                                           : length + 1) {
      SCOPED_TRACE(length);
      refusal(file(name, bytes.substr(0, length)));
    }
  }
}

TEST_F(Refusals, NameTheSizesThatTheHeaderOfACutFileStates) {
  const auto cut = [](const std::string& bytes, const char* format) {
    return is_cut_off(bytes, format);
  };
  const std::string fill(16, 'x');
  EXPECT_FALSE(cut("SDPX" + std::string(12, 'x') + big_endian(36) + fill, "dpx"));
  EXPECT_TRUE(cut("SDPX" + std::string(12, 'x') + big_endian(37) + fill, "dpx"));
  EXPECT_FALSE(cut("XPDS" + std::string(12, 'x') + little_endian(36, 4) + fill, "dpx"));
  EXPECT_TRUE(cut("XPDS" + std::string(12, 'x') + little_endian(37, 4) + fill, "dpx"));
  EXPECT_FALSE(cut("SDPX" + std::string(12, 'x') + "\xff\xff\xff\xff" + fill, "dpx")) << "unknown";
  EXPECT_FALSE(cut("SDPX", "png"));
  // A thumbnail in a header ends before the scan of the picture begins.
  const std::string thumbnail = grey_jpeg_file(1), whole = thumbnail + grey_jpeg_file(3);
  EXPECT_FALSE(cut(whole, "jpeg"));
  EXPECT_TRUE(cut(whole.substr(0, whole.size() - 2), "jpeg"));
  EXPECT_FALSE(cut(whole + "a film beside the picture", "jpeg"));
}

/// A deep part, and a flat one of two pixels behind it if `with_flat`.
void write_deep_exr(const std::filesystem::path& path, bool with_flat) {
  Imf::Header deep(2, 1), flat(2, 1);
  for (const char* name : {"R", "G", "B"})
    for (Imf::Header* header : {&deep, &flat})
      header->channels().insert(name, Imf::Channel(Imf::FLOAT));
  deep.setType(Imf::DEEPSCANLINE);
  if (with_flat) deep.setName("samples");
  deep.compression() = Imf::ZIPS_COMPRESSION;
  flat.setType(Imf::SCANLINEIMAGE);
  flat.setName("flat");
  const Imf::Header headers[] = {deep, flat};
  Imf::MultiPartOutputFile file(path.c_str(), headers, with_flat ? 2 : 1);
  {
    Imf::DeepScanLineOutputPart part(file, 0);
    std::vector<unsigned> counts(2, 1);
    float value = 1;
    std::vector<float*> samples(2, &value);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 8));
    for (const char* name : {"R", "G", "B"})
      buffer.insert(name, Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()),
                                         sizeof(float*), 2 * sizeof(float*), 4));
    part.setFrameBuffer(buffer);
    part.writePixels(1);
  }
  if (!with_flat) return;
  Imf::OutputPart part(file, 1);
  std::vector<float> values{0.5f, 0.25f};
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"})
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8));
  part.setFrameBuffer(buffer);
  part.writePixels(1);
}

TEST_F(Refusals, NameThePartOfADeepExr) {
  const auto path = directory_.path() / "a.exr";
  write_deep_exr(path, false);
  EXPECT_THAT(refusal(path), HasSubstr("it is deep: a pixel has any number of samples; flatten it "
                                       "first (oiiotool DEEP.exr --flatten"));
  write_deep_exr(path, true);
  EXPECT_THAT(refusal(path), HasSubstr("its part 'samples' is deep"));
  EXPECT_EQ(read_picture(path, "flat").image.pixel(1, 0)[2], 0.25f) << "the other part is flat";
}

TEST_F(Refusals, MeetAnExrWithTooLargeAClaim) {
  const auto box = window(0, 0, 1, 1);
  const ExrPart part{"one", box, box, {{"Y", {1}}}}, other{"two", box, box, {{"Y", {1}}}};
  for (const auto& parts : {std::vector{part}, std::vector{part, other}}) {
    const auto path = exr("a.exr", parts);
    read_image(path);
    std::string bytes = read_file(path, 1 << 20);
    const std::string name = std::string("compression\0compression\0", 24);
    bytes.replace(bytes.rfind(name) + name.size(), 4, little_endian(0x7f7f7f7f, 4));
    EXPECT_THAT(refusal(file("b.exr", bytes)), HasSubstr("claims more than the file has"));
  }
}

TEST_F(Refusals, NameInks) {
  EXPECT_THAT(refusal(file("a.jpg", grey_jpeg_file(4))), HasSubstr("its colours are"));
  EXPECT_THAT(refusal(file("a.tif", tiff_file({.samples_per_pixel = 4,
                                               .photometric = 5,
                                               .samples = std::string(4, '\x80')}))),
              HasSubstr("its colours are CMYK"));
}

TEST_F(Refusals, MeetNoPixelsOrTooManyBeforeMemoryIsTaken) {
  refusal(file("none.png", png_file({.width = 0, .height = 0})));
  refusal(file("none.ppm", "P6 0 0 255\n"));
  refusal(file("none.hdr", hdr_file(0, 0, "")));
  refusal(file("none.pfm", pfm_file(0, 0, {})));
  EXPECT_THAT(refusal(file("long.ppm", "P6 100000 1 255\n" + std::string(300000, 'x'))),
              HasSubstr("100000 x 1 pixels; at most 32768 a side"));
  EXPECT_THAT(refusal(file("huge.ppm", "P6 30000 30000 255\n")), HasSubstr("30000 x 30000"));
  refusal(file("huge.hdr", hdr_file(2000000000, 2000000000, "")));
}

}  // namespace
}  // namespace lobelia
