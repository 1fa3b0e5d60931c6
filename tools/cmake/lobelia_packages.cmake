# Debian packages by CPack: `make package`. A component of `cmake --install` is a package.
set(CPACK_GENERATOR DEB)
# Who builds a package is its maintainer, as for Debian's own tools.
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
else()
  set(CPACK_PACKAGE_CONTACT "Local build <lobelia@example.org>")
endif()
set(CPACK_PACKAGE_VENDOR Lobelia)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program library development doc)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Debian's policy wants a copyright and a changelog in every package. Only CPack sets LOBELIA_DEBIAN.
set(CPACK_CUSTOM_INSTALL_VARIABLES LOBELIA_DEBIAN=1)
set(debian ${PROJECT_BINARY_DIR}/debian)
file(READ LICENSE license)
file(CONFIGURE OUTPUT ${debian}/copyright CONTENT "Lobelia\n\n@license@" @ONLY)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${debian}/changelog @ONLY CONTENT
"lobelia (@PROJECT_VERSION@-1) unstable; urgency=medium

  * Built from the source.

 -- @CPACK_PACKAGE_CONTACT@  @now@
")
execute_process(COMMAND gzip -9nc ${debian}/changelog OUTPUT_FILE ${debian}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${debian}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${debian}/triggers)

set(library liblobelia${PROJECT_VERSION_MAJOR})
set(exact "(= ${PROJECT_VERSION}-1)")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # it would be the first line of every package
set(about "Lobelia renders normalised Phong and Blinn-Phong models, has POV-Ray and
Blender Cycles render the same scene, and compares the pictures pixel by
pixel.")
# lobelia_package(COMPONENT NAME SECTION "summary" "last paragraph"): the other variables are set below.
macro(lobelia_package component name section summary text)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${about}\n.\n${text}")
  install(CODE "if(LOBELIA_DEBIAN)
    file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/share/doc/${name}\" TYPE FILE
      FILES [[${debian}/changelog.Debian.gz]] [[${debian}/copyright]])
  endif()" COMPONENT ${component})
endmacro()
lobelia_package(program lobelia graphics "comparison render farm for specular highlights"
  "This package has the program, its man pages, scenes and grids.")
lobelia_package(library ${library} libs "comparison of specular highlights (shared library)"
  "This package has the shared library, and the parts that read pictures.")
lobelia_package(development liblobelia-dev libdevel "comparison of specular highlights (development files)"
  "This package has the header, and files for CMake and pkg-config.")
if(TARGET lobelia_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  lobelia_package(python python3-lobelia python "comparison of specular highlights (Python module)"
    "This package has the module for Python 3, and a plug-in for pytest.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${library} ${exact}, ${LOBELIA_PYTHON_DEPENDS}")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "lobelia ${exact}, python3-matplotlib, python3-pytest")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/tools/packaging/python/postinst ${PROJECT_SOURCE_DIR}/tools/packaging/python/prerm)
endif()
lobelia_package(doc lobelia-doc doc "comparison render farm for specular highlights (documentation)"
  "This package has the documentation as Markdown.")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${library} ${exact}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library} ${exact}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "povray, blender")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "lobelia-doc, libsunflow-java, default-jre-headless, chromium")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
include(CPack)
