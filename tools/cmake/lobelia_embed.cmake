# lobelia_embed(TARGET FILE NAME): the text of FILE as `extern const std::string_view lobelia::embedded::NAME`, so that
# the program needs no data folder at run time.
function(lobelia_embed target file name)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded_${name}.cpp)
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  file(READ ${source} text)
  # In pieces, because compilers need not accept a literal of more than 64 KiB.
  set(literal "")
  string(LENGTH "${text}" length)
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 piece)
    string(APPEND literal "R\"lobelia(${piece})lobelia\"\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  file(CONFIGURE OUTPUT ${out} @ONLY NEWLINE_STYLE UNIX CONTENT
"// Made from ${file} by tools/cmake/lobelia_embed.cmake.
#include <string_view>
namespace lobelia::embedded {
extern const std::string_view ${name};
const std::string_view ${name} =
${literal};
}
")
  target_sources(${target} PRIVATE ${out})
endfunction()

# lobelia_embed_folder(TARGET FOLDER PATTERN NAME): the files of a folder, by their names without the ending, as
# `extern const std::span<const lobelia::EmbeddedText> lobelia::embedded::NAME` (renderer/export/embedded.hpp).
function(lobelia_embed_folder target folder pattern name)
  file(GLOB files RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${folder}/${pattern})
  set(declarations "")
  set(rows "")
  foreach(file ${files})
    get_filename_component(stem ${file} NAME_WE)
    lobelia_embed(${target} ${file} ${name}_${stem})
    string(APPEND declarations "extern const std::string_view ${name}_${stem};\n")
    string(APPEND rows "    {\"${stem}\", ${name}_${stem}},\n")
  endforeach()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded_${name}.cpp)
  file(CONFIGURE OUTPUT ${out} @ONLY NEWLINE_STYLE UNIX CONTENT
"// Made from ${folder}/ by tools/cmake/lobelia_embed.cmake.
#include \"renderer/export/embedded.hpp\"
namespace lobelia::embedded {
${declarations}
static const EmbeddedText ${name}_texts[] = {
${rows}};
extern const std::span<const EmbeddedText> ${name};
const std::span<const EmbeddedText> ${name} = ${name}_texts;
}
")
  target_sources(${target} PRIVATE ${out})
endfunction()
