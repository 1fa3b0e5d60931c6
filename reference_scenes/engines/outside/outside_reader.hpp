// Outside engines in XML: an <engine> or <pictures> of a grid, or a file whose root element is such an <engine>.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/records/outside_engine.hpp"
#include "renderer/scene/xml_format.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

/// <engine> and <pictures>.
std::span<const XmlElement> outside_elements();

/// Whether the <engine> describes one, and does not just name one of the catalogue.
bool is_outside_engine(pugi::xml_node node);

/// `directory` is that of InputFile::real_path() of the XML file. Notes errors in `source`, and then returns none. Starts
/// nothing.
std::optional<records::OutsideEngine> read_outside_engine(XmlSource& source, pugi::xml_node node,
                                                          const std::filesystem::path& directory);

/// A file whose root is an <engine>. Throws Error(kInput) with all errors, each "file:line:column: ...".
records::OutsideEngine read_engine_file(const std::filesystem::path& path);

// The text of an outside engine's command.

/// The text with each {name} replaced by `value_of(name)`; {{ is a brace. Throws std::runtime_error for a brace without its
/// other, and whatever `value_of` throws.
std::string filled_in(std::string_view text,
                      const std::function<std::string(std::string_view name)>& value_of);

/// Arguments out of a line: blanks divide them, quotation marks of both kinds keep blanks. Throws std::runtime_error for a
/// mark that is not closed, or what only a shell would understand, such as a lone '|'.
std::vector<std::string> arguments_of(std::string_view line);

}  // namespace lobelia
