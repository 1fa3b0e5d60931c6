#define LOBELIA_BENCH_SET avx512
#include "bench/hand_written_loop.inc"
