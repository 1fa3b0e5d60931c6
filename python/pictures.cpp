// Pictures as arrays, and their files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/text.hpp"
#include "python/module.hpp"

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
  const Image image = image_of(array, "image");
  const std::filesystem::path file = path_of(path);
  const std::string ending = file.extension().string();
  if (ending != ".exr" && ending != ".png")
    throw Error(ExitCode::kUsage, fmt::format("{}: the name must end in .exr or .png",
                                              printable_path(file.string())));
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
                fmt::format("{}: it has masked values, which would count as the numbers below the "
                            "mask; fill them first, with numpy.ma.filled",
                            name));
}

Image image_of(const py::object& object, const std::string& name) {
  const py::array array = py::array::ensure(object);
  if (!array) PyErr_Clear();
  const auto fail = [&](const std::string& what) {
    throw Error(
        ExitCode::kInput,
        fmt::format("{}: {}; a picture is a path, or an array (height, width, 3) of floats, "
                    "linear light with Rec. 709 primaries",
                    name, what));
  };
  if (!array || array.dtype().kind() == 'O' || array.dtype().kind() == 'U')
    fail("it is no array of numbers");
  if (array.ndim() != 3 || array.shape(2) != 3)
    fail(fmt::format("its shape is ({})",
                     fmt::join(array.shape(), array.shape() + array.ndim(), ", ")));
  if (array.dtype().kind() != 'f')
    fail(fmt::format("its values are {}", std::string(py::str(array.dtype()))));
  refuse_masked(object, name);
  const py::ssize_t height = array.shape(0), width = array.shape(1);
  if (height < 1 || width < 1 || height > kMaxImageSide || width > kMaxImageSide ||
      height * width > kMaxImagePixels)
    throw Error(ExitCode::kInput,
                fmt::format("{}: it has {} x {} pixels; allowed: 1 to {} a side, {} in all", name,
                            width, height, kMaxImageSide, kMaxImagePixels));
  const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!values) throw py::error_already_set();
  Image image{int(width), int(height)};
  const float* const from = values.data();
  const py::gil_scoped_release released;
  std::copy_n(from, image.values().size(), image.values().begin());
  return image;
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
