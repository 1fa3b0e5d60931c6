// What the program and lobelia_picture_reader have to agree on.
#pragma once

namespace lobelia {

inline constexpr char kReaderFile[] = "lobelia_picture_reader";

/// A packet of the reader's standard input, a socket: a ReadingRequest, with the picture's file and the pipe for the answer.
inline constexpr int kRequestDescriptors = 2;

/// What the reader sends back when the child has ended.
struct ReaderVerdict {
  int status = 0;         ///< as wait(2) has it
  bool too_long = false;  ///< it was killed because it did nothing for too long
};

}  // namespace lobelia
