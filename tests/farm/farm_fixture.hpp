// A small grid in a directory of its own.
#pragma once

#include <fmt/format.h>

#include "base/system/files.hpp"
#include "farm/farm.hpp"
#include "lobelia_paths.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {

class FarmTest : public testing::Test {
 protected:
  Grid grid(const std::string& exponents, const std::string& engines = "") {
    const auto path = directory_.path() / "grid.xml";
    write_file(path, fmt::format("<grid version=\"1\" title=\"A small grid\">"
                                 "<scene file=\"{}/reference_scenes/scenes/oblique_45.xml\"/>"
                                 "<film width=\"48\" height=\"48\"/>"
                                 "<axis name=\"exponent\" values=\"{}\"/>{}</grid>",
                                 LOBELIA_SOURCE_DIR, exponents, engines));
    return read_grid(path);
  }
  std::filesystem::path out() const { return directory_.path() / "out"; }
  std::filesystem::path in_cell(const std::string& id, const std::string& file) const {
    return out() / "cells" / id / file;
  }
  Json cell_record(const std::string& id) const { return read_json(in_cell(id, "cell.json")); }
  /// A program that answers as POV-Ray does, and fails at every picture.
  std::filesystem::path failing_povray() const {
    const auto path = directory_.path() / "povray";
    write_file(path,
               "#!/bin/sh\n"
               "echo 'POV-Ray 3.7.0.10' >&2\n"
               "case \"$*\" in *version*) exit 0;; esac\n"
               "exit 3\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }

  TemporaryDirectory directory_;
};

}  // namespace lobelia
