// A view of one record that a run may have.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>

#include "gallery/fields.hpp"
#include "gallery/views.hpp"

namespace lobelia::gallery {

/// Empty where RUN/file is not there. `draw` fills what is on the page below its title; where it throws
/// Error(kInput) the page says that in place of everything.
std::optional<ViewPage> record_page(const std::filesystem::path& run, const char* file,
                                    const char* kind, const char* title,
                                    const std::function<void(ViewPage&, const Fields&)>& draw);

/// <header> with the title and a sentence below it.
void write_lead(Html& html, const char* title, const std::string& words);
/// A table's head: a column for each.
void write_columns(Html& html, std::initializer_list<std::string> columns);
/// "All of it is in FILE", with a link to it.
void write_source(Html& html, const std::string& command, const char* file);

}  // namespace lobelia::gallery
