// The sections of `make bench-details`. Each prints a table, checks what it timed, and ends with its bottleneck.
#pragma once

#include "bench/inputs.hpp"
#include "core/timing.hpp"

namespace lobelia::bench {

void lobes();                            ///< nanoseconds to evaluate a lobe
void pictures();                         ///< megapixels per second, for each model and lobe
void trace(const std::string& scene);    ///< seconds to render one scene, for engines.sh
void threads();                          ///< efficiency on 1 to all processors
void sizes(const std::string& program);  ///< whole commands, 256^2 to 8192^2, with peak memory
/// Whole commands that compare large pictures, with peak memory, and folders.
void comparisons(const std::string& program);
/// Whole commands that compare two pictures, beside idiff, odiff and flip where they are on PATH.
void others(const std::string& program);
void plan();      ///< cells of a grid, planned per second
void exr();       ///< compressing and writing pictures
void reading();   ///< the cost of reading a picture in a process of its own
void starting();  ///< the cost of running another program

}  // namespace lobelia::bench
