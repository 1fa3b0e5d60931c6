// lobelia._lobelia: what the package program/python/lobelia is made of.
#include "program/python/module.hpp"

#include "base/system/error.hpp"
#include "base/system/host.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/threads.hpp"
#include "base/system/version.hpp"
#include "base/words/text.hpp"
#include "program/command/commands.hpp"

namespace lobelia::python {
namespace {

/// Takes Python's command line, for records.
void take_command_line() {
  const py::list words = py::module_::import("sys").attr("orig_argv");
  cli::command_line() = {"python3"};
  for (std::size_t i = 1; i < words.size(); ++i) cli::command_line().push_back(path_of(words[i]));
}

void set_python_error(const Error& error) {
  if (error.code() == ExitCode::kInterrupted) return PyErr_SetNone(PyExc_KeyboardInterrupt);
  std::vector<std::string> lines;  // as the program prints them
  for (const std::string& line : error.lines()) lines.push_back(printable(line, 2000));
  const py::object made =
      py::module_::import("lobelia._errors").attr("error_of")(int(error.code()), lines);
  PyErr_SetObject(py::type::handle_of(made).ptr(), made.ptr());
}

}  // namespace

void add_errors(py::module_& module) {
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      std::rethrow_exception(pointer);
    } catch (const Error& error) {
      set_python_error(error);
    } catch (const std::filesystem::filesystem_error& error) {
      set_python_error(as_error(error));
    }
  });
  module.attr("version") = kVersion;
  take_command_line();
  own_file();  // as long as the path that Python knows is good
}

}  // namespace lobelia::python

PYBIND11_MODULE(_lobelia, module) {
  using namespace lobelia::python;
  lobelia::keep_to_usual_threads();
  add_errors(module);
  add_lobes(module);
  add_pictures(module);
  add_compare(module);
  add_profile(module);
  add_render(module);
  add_farm(module);
}
