// The protocol between the program and lobelia_picture_reader.
#pragma once

namespace lobelia {

inline constexpr char kReaderFile[] = "lobelia_picture_reader";

/// A packet of the reader's standard input, a socket: a ReadingRequest, with the picture's file and the pipe for the answer.
inline constexpr int kRequestDescriptors = 2;

/// Sent back by the reader when the child has ended.
struct ReaderVerdict {
  int status = 0;         ///< as wait(2) has it
  bool too_long = false;  ///< it was killed because it did nothing for too long
};

}  // namespace lobelia
