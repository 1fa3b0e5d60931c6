// The parts of the Python module lobelia._lobelia, and what they share. The package program/python/lobelia is what users
// see; its docstrings say what each function takes.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/pictures/picture.hpp"
#include "compare/set/choice.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::python {

namespace py = pybind11;

/// How far the work is, from 0 to 1. For any thread.
using ShowProgress = std::function<void(double)>;

/// Runs work on another thread, without the GIL. Meanwhile the calling thread calls `progress`, if it is not None, with
/// the fraction done, and looks for Ctrl-C. That, or an exception of `progress`, stops work that looks at interrupted().
void run(const py::object& progress, const std::function<void(const ShowProgress&)>& work);

/// Adds the options that `add` declares to a command line and reads them from Python's: exponent=64 is --exponent=64,
/// quick=True is --quick, mask=["a", "b"] is given twice, crop=(0, 0, 5, 5) is --crop=0,0,5,5, None is left out. Throws
/// Error(kUsage).
void parse_options(const py::dict& options, const std::function<void(CLI::App&)>& add);

/// Python's options of a comparison, for read_choice(): as parse_options() takes them.
std::vector<GivenOption> given_options(const py::dict& options);

/// A path, a text that is one, or a text of XML, which begins with '<'. Reads pictures beside the file; of a text from
/// the working directory. Throws as read_scene().
Scene scene_of(const py::object& scene);
/// Warnings about the scene, one sentence each.
std::vector<std::string> warnings_of(const Scene& scene);

/// The values as (height, width, 3) float32, not copied.
py::array array_of(Image image);
/// The same while `owner` lives.
py::array view_of(const Image& image, const py::object& owner);
/// Throws Error(kInput) if the array, or one in the list, is a numpy.ma.MaskedArray with masked values: numbers stand there
/// all the same. `name` is for messages.
void refuse_masked(const py::object& array, const std::string& name);
/// An array as a picture.
struct ArrayPicture {
  Picture picture;              ///< its source says how the values became light
  std::optional<Image> alpha;   ///< of four channels the last, in three equal ones
  std::optional<Image> masked;  ///< 1 where numpy.ma masks a value of the pixel
};
/// A copy, because an Image owns its values. Floats are light, colours multiplied by alpha; uint8 are the codes of a PNG.
/// Throws Error(kInput) unless the array is (height, width) or has 1, 3 or 4 channels, of a size that may be compared, and
/// for a list with masked arrays. `name` is for messages.
ArrayPicture picture_of(const py::object& array, const std::string& name);
/// The picture alone. Also throws as refuse_masked().
Image image_of(const py::object& array, const std::string& name);
/// The bytes of a PNG file.
py::bytes png_of(const DisplayImage& picture);
/// Whether it is a text or has __fspath__.
bool is_path(const py::object& object);
std::string path_of(const py::object& path);

/// Exceptions, and what the module says of itself.
void add_errors(py::module_& module);
void add_lobes(py::module_& module);
void add_pictures(py::module_& module);
void add_compare(py::module_& module);
void add_profile(py::module_& module);
void add_render(py::module_& module);
void add_farm(py::module_& module);

}  // namespace lobelia::python
