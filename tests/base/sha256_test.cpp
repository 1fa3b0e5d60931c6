#include "base/system/sha256.hpp"

#include "base/system/files.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

TEST(Sha256, GivesTheDigestsThatTheStandardPublishes) {
  // FIPS 180-4's examples, and NIST's of a million letters.
  EXPECT_EQ(hex(sha256("")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hex(sha256("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hex(sha256(std::string(1000000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, HashesAFileByItsBytes) {
  const TemporaryDirectory directory;
  const std::string text(300001, 'x');
  write_file(directory.path() / "file", text);
  EXPECT_EQ(sha256_of_file(directory.path() / "file"), sha256(text));
  EXPECT_THROW(sha256_of_file(directory.path() / "none"), Error);
  EXPECT_THROW(sha256_of_file(directory.path()), Error);
}

TEST(Sha256, AFileOverTheLimitIsRefusedBeforeAnyByteIsRead) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "huge";
  write_file(file, "");
  std::filesystem::resize_file(file, kMostHashedBytes + 1);
  EXPECT_THAT(error_words(ExitCode::kInput, [&] { sha256_of_file(file); }),
              testing::HasSubstr("8589934593 bytes; at most 8589934592 are read"));
}

TEST(Sha256, TheHashOfALargeFileEndsAtAnInterruption) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "large";
  write_file(file, "");
  std::filesystem::resize_file(file, kBytesBetweenLooks + 1);
  request_interrupt();
  EXPECT_EQ(thrown_by([&] { sha256_of_file(file); }).code(), ExitCode::kInterrupted);
  {
    const Uninterrupted to_the_end;
    EXPECT_EQ(sha256_of_file(file), sha256(std::string(kBytesBetweenLooks + 1, '\0')));
  }
  forget_interrupt();
}

TEST(Sha256, ReadsBackItsOwnHexadecimalAndNothingElse) {
  const Sha256Digest digest = sha256("abc");
  Sha256Digest back{};
  EXPECT_TRUE(from_hex(hex(digest), back));
  EXPECT_EQ(back, digest);
  const std::string good = hex(digest);
  for (const std::string& bad : {std::string(), good.substr(1), good + "0", "X" + good.substr(1),
                                 "/" + good.substr(1), ":" + good.substr(1)})
    EXPECT_FALSE(from_hex(bad, back)) << bad;
}

}  // namespace
}  // namespace lobelia
