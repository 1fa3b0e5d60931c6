// Pictures as arrays, and their files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/pictures/picture_colour.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "program/python/module.hpp"

namespace lobelia::python {
namespace {

std::vector<py::ssize_t> shape_of(const Image& image) { return {image.height(), image.width(), 3}; }

py::array array_at(const Image& image, const py::object& owner) {
  return py::array_t<float>(shape_of(image), image.values().data(), owner);
}

/// Whether numpy.ma masks a value of it, or of an array in it down to that depth.
bool has_masked(const py::handle& given, int depth) {
  if (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given)) {
    for (const py::handle one : given)
      if (depth > 0 && has_masked(one, depth - 1)) return true;
    return false;
  }
  return py::isinstance<py::array>(given) &&
         py::module_::import("numpy.ma").attr("is_masked")(given).cast<bool>();
}

py::array read(const py::object& path) {
  Image image;
  run(py::none(), [&, file = path_of(path)](const ShowProgress&) { image = read_image(file); });
  return array_of(std::move(image));
}

void write(const py::object& path, const py::object& array, double exposure) {
  refuse_masked(array, "image");
  const ArrayPicture given = picture_of(array, "image");
  if (given.alpha)
    throw Error(ExitCode::kInput, "image: it has alpha, which would be lost; write image[..., :3]");
  const Image& image = given.picture.image;
  const std::filesystem::path file = path_of(path);
  const std::string ending = file.extension().string();
  if (ending != ".exr" && ending != ".png")
    throw Error(ExitCode::kUsage, "{}: the name must end in .exr or .png",
                printable_path(file.string()));
  run(py::none(), [&](const ShowProgress&) {
    if (ending == ".exr")
      write_exr(file, image, {});
    else
      write_png(file, to_display(image, exposure));
  });
}

}  // namespace

py::bytes png_of(const DisplayImage& picture) { return png_bytes(picture); }

py::array view_of(const Image& image, const py::object& owner) {
  py::array view = array_at(image, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

py::array array_of(Image image) {
  auto kept = std::make_unique<Image>(std::move(image));
  const py::capsule owner(kept.get(), [](void* one) { delete static_cast<Image*>(one); });
  return array_at(*kept.release(), owner);
}

void refuse_masked(const py::object& array, const std::string& name) {
  constexpr int kMostAxes = 32;  // of numpy
  if (has_masked(array, kMostAxes))
    throw Error(ExitCode::kInput,
                "{}: it has masked values, which would count as the numbers below the "
                "mask; fill them first, with numpy.ma.filled",
                name);
}

namespace {

/// One value of each pixel, from the array's channel `channel`.
std::vector<float> channel_of(const float* values, std::size_t pixels, std::size_t channels,
                              std::size_t channel) {
  std::vector<float> one(pixels);
  for (std::size_t i = 0; i < pixels; ++i) one[i] = values[channels * i + channel];
  return one;
}

/// Three equal channels.
Image grey(const std::vector<float>& values, int width, int height) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.values().size(); ++i) image.values()[i] = values[i / 3];
  return image;
}

/// As if the values had been read from a file: codes as those of a PNG.
ArrayPicture as_read(const float* values, int width, int height, std::size_t channels,
                     bool are_codes) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  ArrayPicture made;
  PictureSource& source = made.picture.source;
  source.format = "array";
  source.value_type = are_codes ? "uint8" : "float";
  source.transfer = are_codes ? "sRGB" : "linear";
  source.data = source.display = {0, 0, width, height};
  Image& image = made.picture.image;
  if (channels == 1) {
    image = grey(channel_of(values, pixels, 1, 0), width, height);
  } else {
    image = Image(width, height);
    for (std::size_t i = 0; i < image.values().size(); ++i)
      image.values()[i] = values[channels * (i / 3) + i % 3];
  }
  if (are_codes) decode(*named_curve("sRGB"), image);
  if (channels < 4) return made;
  const std::vector<float> alpha = channel_of(values, pixels, channels, 3);
  made.alpha = grey(alpha, width, height);
  // A PNG's colours are not multiplied by its alpha, those of floats are.
  source.multiplied_by_alpha = are_codes;
  if (are_codes)
    for (std::size_t i = 0; i < image.values().size(); ++i) image.values()[i] *= alpha[i / 3];
  return made;
}

/// 1 at the pixels of which numpy.ma masks a value; nothing if it masks none.
std::optional<Image> masked_pixels(const py::object& object, int width, int height,
                                   std::size_t channels) {
  const py::module_ ma = py::module_::import("numpy.ma");
  if (!py::isinstance(object, ma.attr("MaskedArray")) || !has_masked(object, 0))
    return std::nullopt;
  const auto flags = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(
      ma.attr("getmaskarray")(object));
  std::vector<float> any(std::size_t(width) * std::size_t(height));
  for (std::size_t i = 0; i < channels * any.size(); ++i)
    if (flags.data()[i] != 0) any[i / channels] = 1;
  return grey(any, width, height);
}

}  // namespace

ArrayPicture picture_of(const py::object& object, const std::string& name) {
  const py::array array = py::array::ensure(object);
  if (!array) PyErr_Clear();
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::kInput,
                "{}: {}; a picture is a path, or an array (height, width), (height, width, 1), "
                "(height, width, 3) or (height, width, 4): floats are linear light with "
                "Rec. 709 primaries, uint8 are sRGB codes",
                name, what);
  };
  if (!array || array.dtype().kind() == 'O' || array.dtype().kind() == 'U')
    fail("it is no array of numbers");
  const std::size_t channels = array.ndim() == 2   ? 1
                               : array.ndim() == 3 ? std::size_t(array.shape(2))
                                                   : 0;
  if (channels != 1 && channels != 3 && channels != 4)
    fail(fmt::format("its shape is ({})",
                     fmt::join(array.shape(), array.shape() + array.ndim(), ", ")));
  const bool are_codes = array.dtype().kind() == 'u' && array.dtype().itemsize() == 1;
  if (array.dtype().kind() != 'f' && !are_codes)
    fail(fmt::format("its values are {}", std::string(py::str(array.dtype()))));
  const py::ssize_t height = array.shape(0), width = array.shape(1);
  if (height < 1 || width < 1 || height > kMaxImageSide || width > kMaxImageSide ||
      height * width > kMaxImagePixels)
    throw Error(ExitCode::kInput, "{}: it has {} x {} pixels; allowed: 1 to {} a side, {} in all",
                name, width, height, kMaxImageSide, kMaxImagePixels);
  const bool is_masked_array =
      py::isinstance(object, py::module_::import("numpy.ma").attr("MaskedArray"));
  if (!is_masked_array) refuse_masked(object, name);  // a list of masked arrays
  std::optional<Image> masked = masked_pixels(object, int(width), int(height), channels);
  auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!values) throw py::error_already_set();
  const float* const from = values.data();
  const py::gil_scoped_release released;
  std::vector<float> codes;
  constexpr float kOfCode = 1.0f / 255;  // as a PNG's are read: a quotient may be rounded otherwise
  if (are_codes)
    for (py::ssize_t i = 0; i < values.size(); ++i) codes.push_back(from[i] * kOfCode);
  ArrayPicture made =
      as_read(are_codes ? codes.data() : from, int(width), int(height), channels, are_codes);
  made.masked = std::move(masked);
  return made;
}

Image image_of(const py::object& object, const std::string& name) {
  refuse_masked(object, name);
  return picture_of(object, name).picture.image;
}

void add_pictures(py::module_& module) {
  module.def("read", &read);
  module.def("write", &write);
  module.def("refuse_masked", &refuse_masked);
  module.def("png", [](const py::object& array, double exposure) {
    return png_of(to_display(image_of(array, "image"), exposure));
  });
}

}  // namespace lobelia::python
