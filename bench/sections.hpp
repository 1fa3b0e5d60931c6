// The parts of `make bench`; each prints a table, checks what it timed, and ends by saying what limits it.
#pragma once

#include <string>

namespace lobelia::bench {

void lobes();     ///< nanoseconds to evaluate a lobe
void pictures();  ///< megapixels per second, for each model and lobe
void trace(
    const std::string& scene);  ///< milliseconds to render one scene, for the engines' script
void threads();                 ///< efficiency on 1 to all processors
void sizes(const std::string& program);  ///< whole commands, 256^2 to 8192^2, with peak memory
void comparisons(
    const std::string& program);  ///< of large pictures with peak memory, and of folders
void plan();                      ///< cells of a grid, planned per second
void exr();                       ///< packing and writing pictures
void reading();                   ///< what it costs to read a picture in a process of its own
void starting();                  ///< what it costs to run another program

}  // namespace lobelia::bench
