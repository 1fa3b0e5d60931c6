#define LOBELIA_BENCH_SET avx2
#include "bench/hand_written_loop.inc"
