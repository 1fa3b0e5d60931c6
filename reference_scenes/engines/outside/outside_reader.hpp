// Outside engines in XML: an <engine> or <pictures> of a grid, or a file whose root element is such an <engine>.
#pragma once

#include <filesystem>
#include <optional>

#include "records/outside_engine.hpp"
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

}  // namespace lobelia
