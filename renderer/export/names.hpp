// Names and texts of exported highlights. A text has parts with guards: a part that several highlights need is
// written once, and two exports can be used together.
#pragma once

#include <initializer_list>
#include <set>

#include "renderer/highlight.hpp"

namespace lobelia {

/// The name of the function and of its file: "lobelia_modified_phong_cs16", with "_paper" for that normalisation,
/// "_n64" for a fixed exponent and "_fresnel" for that factor. A formula is named by its hash.
std::string function_name(const Highlight& highlight, bool fixed_exponent = false,
                          bool fresnel = false);

/// "Modified_Phong" from "modified_phong".
std::string capitalised(std::string_view name);

/// Explains "Romanyuk et al." to a reader who has only the exported file.
inline constexpr std::string_view kPaper =
    "Romanyuk et al.: O. N. Romanyuk, I. V. Abramchuk, S. A. Kyrylashchuk, S. O. Romanyuk, Modelling\n"
    "// of a specular component of colour by using energy-correct models of surface reflectivity\n"
    "// (Vinnytsia National Technical University).";

/// `modified Phong with the lobe cs16, normalisation "exact"`
std::string heading(const Highlight& highlight);

/// `text` with each "%name%" replaced.
std::string fill(std::string_view text,
                 std::initializer_list<std::pair<std::string_view, std::string_view>> values);

class Parts {
 public:
  /// The language's guard against reading a part twice; "%name%" is the part's name.
  Parts(std::string_view begin, std::string_view end) : begin_(begin), end_(end) {}

  /// Appends the part unless it is there already.
  void add(const std::string& name, std::string_view text);
  const std::string& text() const { return text_; }

 private:
  std::string begin_, end_, text_;
  std::set<std::string> names_;
};

}  // namespace lobelia
