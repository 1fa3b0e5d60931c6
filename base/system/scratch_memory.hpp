// Keeps large pictures in files, so that a command that looks at one part after the other needs little memory.
#pragma once

#include <algorithm>
#include <cstddef>

namespace lobelia {

/// Pieces of memory from this size on are large: a picture of 6 million pixels.
inline constexpr std::size_t kLargePiece = std::size_t{64} << 20;

/// From now on allocate_zeroed() (base/pictures/image.hpp) maps pieces of at least `least` bytes from files without a
/// name in $TMPDIR, and while one is there, of a sixteenth as well. Where that has no room for one, it is in memory as
/// any other. 0: no piece, as at first.
void keep_large_pieces_in_files(std::size_t least = kLargePiece);

/// Whether a piece of so many bytes would be in a file now, if there is room for it.
bool is_kept_in_file(std::size_t bytes);

/// Says that so many bytes of such pieces may have been looked at or written since the last call, by this thread. Each time
/// that is 32 MiB for all threads together, no page of them stays in this process. They come back when they are looked at.
void looked_at(std::size_t bytes);

/// The same of a row of a part of a picture: the system brings the pages around it as well.
inline void looked_at_row(std::size_t bytes) {
  constexpr std::size_t kAround = std::size_t{64} << 10;
  looked_at(bytes + kAround);
}

/// Calls f(begin, end) for one range after the other of `count` elements, of `bytes` each in all arrays together, and says
/// that they were looked at.
template <class F>
void in_parts(std::size_t count, std::size_t bytes, const F& f) {
  constexpr std::size_t kPart = std::size_t{3} << 16;  // of pixels as well as of their values
  for (std::size_t begin = 0; begin < count; begin += kPart) {
    const std::size_t end = std::min(count, begin + kPart);
    f(begin, end);
    looked_at((end - begin) * bytes);
  }
}

/// For allocate_zeroed() and free_zeroed(): null, or false, where the piece is in no file.
void* map_file(std::size_t bytes);
bool unmap_file(void* memory);

}  // namespace lobelia
