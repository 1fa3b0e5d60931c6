# What `cmake --install` copies. Programs find their parts from where they lie, so the whole tree may be moved.
# The components are the Debian packages: tools/cmake/lobelia_packages.cmake.
set(LOBELIA_DATA share/lobelia)
set(LOBELIA_DOCS share/doc/lobelia)

# Grids name their scenes as ../scenes/NAME.xml.
install(DIRECTORY reference_scenes/scenes reference_scenes/grids DESTINATION ${LOBELIA_DATA})
# The pages and schemas of records are the program's own: program/command/CMakeLists.txt makes them.
set(reference ${PROJECT_BINARY_DIR}/reference)
install(DIRECTORY docs/reference/ DESTINATION ${LOBELIA_DATA}/schemas FILES_MATCHING PATTERN *.xsd)
install(DIRECTORY ${reference}/ DESTINATION ${LOBELIA_DATA}/schemas FILES_MATCHING PATTERN *.schema.json)
install(FILES README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md SECURITY.md LICENSE DESTINATION ${LOBELIA_DOCS} COMPONENT doc)
install(DIRECTORY docs DESTINATION ${LOBELIA_DOCS} COMPONENT doc)
install(DIRECTORY ${reference} DESTINATION ${LOBELIA_DOCS}/docs COMPONENT doc)

# Builds all that is installed, and no test: `cmake --build BUILD --target installed`.
add_custom_target(installed DEPENDS lobelia lobelia_image_io lobelia_api manual)
if(TARGET lobelia_python)
  add_dependencies(installed lobelia_python)
endif()

if(EXISTS /etc/debian_version)
  include(lobelia_packages)
endif()
