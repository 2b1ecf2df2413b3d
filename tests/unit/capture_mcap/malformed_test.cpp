/// Whatever is done to a file: an error that says what and where, or what was read before it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "capture/mcap/recover.hpp"
#include "unit/capture_mcap/capture.hpp"

namespace coop::mcap {
namespace {

using test::SmallFile;

ReadLimits small_limits() {
  ReadLimits limits;
  limits.max_chunk = std::uint64_t{1} << 20U;
  return limits;
}

std::vector<std::byte> sample(Compression compression) {
  SmallFile file(compression);
  const std::string text = "attached";
  file.writer().add(Attachment{1, 2, "name", "text/plain", test::bytes_of(text)});
  file.writer().add(Metadata{"versions", {{"a", "b"}}});
  for (Nanoseconds i = 0; i < 5; ++i) file.message(1 + i % 2, i, "text " + std::to_string(i));
  file.end_chunk();
  for (Nanoseconds i = 3; i < 8; ++i) file.message(1 + i % 2, i, "more " + std::to_string(i));
  return file.finish();
}

/// Messages read before the first error; everything a program does with a file is done.
std::size_t read_all(const std::vector<std::byte>& bytes) {
  std::size_t messages = 0;
  try {
    Reader reader(open_memory(bytes), small_limits());
    const Summary& summary = reader.summary();
    for (const AttachmentIndex& index : summary.attachments) {
      try {
        static_cast<void>(reader.attachment(index));
      } catch (const FileError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("byte "));
      }
    }
    MessageCursor cursor = reader.messages();
    while (cursor.next()) ++messages;
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("byte "));
  }
  return messages;
}

/// Messages recovered; what comes out has to be a file without defect.
std::size_t recover_all(const std::vector<std::byte>& bytes) {
  std::vector<std::byte> out;
  RecoverOptions options;
  options.limits = small_limits();
  try {
    const RecoverReport report = recover(open_memory(bytes), write_to_memory(out), options);
    Reader reader(open_memory(out));
    EXPECT_TRUE(reader.summary().complete);
    EXPECT_FALSE(reader.summary().scanned);
    EXPECT_EQ(test::lines_of(reader).size(), report.messages);
    return report.messages;
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("byte "));
    return 0;
  }
}

class MalformedTest : public ::testing::TestWithParam<Compression> {};

TEST_P(MalformedTest, AFileCutAnywhereIsReadUpToThere) {
  const std::vector<std::byte> whole = sample(GetParam());
  ASSERT_EQ(read_all(whole), 10U);
  std::size_t most = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::vector<std::byte> cut(whole.begin(),
                                     whole.begin() + static_cast<std::ptrdiff_t>(length));
    const std::size_t read = read_all(cut);
    EXPECT_GE(read, most) << "a longer piece has more in it; " << length;
    most = read;
    EXPECT_GE(recover_all(cut), read) << length;
  }
  EXPECT_EQ(most, 10U);
}

TEST_P(MalformedTest, ABitFlippedAnywhereDoesNoHarm) {
  std::vector<std::byte> bytes = sample(GetParam());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned bit : {0U, 7U}) {
      const std::byte before = bytes[i];
      bytes[i] ^= static_cast<std::byte>(1U << bit);
      EXPECT_LE(read_all(bytes), 10U);
      // A header that lies about its own length leaves nothing to begin with; else a flipped bit
      // costs a chunk at most, or the attachment beside it.
      const std::size_t recovered = recover_all(bytes);
      if (i >= kMagic.size() + kRecordPrefix + 20) {
        EXPECT_GE(recovered, 5U) << i << " " << bit;
      }
      bytes[i] = before;
    }
  }
}

TEST_P(MalformedTest, LengthsThatLieDoNoHarm) {
  const std::vector<std::byte> whole = sample(GetParam());
  for (const std::uint64_t lie :
       {~std::uint64_t{0}, std::uint64_t{1} << 63U, std::uint64_t{0x7FFFFFFF}, std::uint64_t{0}}) {
    for (std::size_t i = 0; i + 8 <= whole.size(); ++i) {
      std::vector<std::byte> bytes = whole;
      for (std::size_t k = 0; k < 8; ++k) bytes[i + k] = static_cast<std::byte>(lie >> (8 * k));
      EXPECT_LE(read_all(bytes), 10U);
      recover_all(bytes);
    }
  }
}

TEST_P(MalformedTest, SeveralRandomChangesDoNoHarm) {
  const std::vector<std::byte> whole = sample(GetParam());
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> place(kMagic.size(), whole.size() - 1);
  std::uniform_int_distribution<int> value(0, 255);
  std::uniform_int_distribution<int> count(1, 8);
  for (int round = 0; round < 1000; ++round) {
    std::vector<std::byte> bytes = whole;
    for (int i = count(random); i > 0; --i) {
      bytes[place(random)] = static_cast<std::byte>(value(random));
    }
    EXPECT_LE(read_all(bytes), 10U);
    recover_all(bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MalformedTest,
                         ::testing::Values(Compression::kNone, Compression::kLz4,
                                           Compression::kZstd),
                         [](const auto& one) {
                           return one.param == Compression::kNone ? std::string("none")
                                                                  : std::string(name_of(one.param));
                         });

TEST(Malformed, ASmallChunkThatUncompressesToMuchIsRefusedBeforeItDoes) {
  // 64 MB of zeros in a few kilobytes, in a chunk that admits to 1 MB.
  const std::vector<std::byte> zeros(std::size_t{64} << 20U);
  Compressor compressor(Compression::kZstd, 1);
  ByteBuffer buffer;
  Chunk bomb;
  bomb.compression = "zstd";
  bomb.records = compressor.compress(zeros, buffer);
  bomb.uncompressed_size = std::uint64_t{1} << 20U;
  Decompressor decompressor;
  std::vector<std::byte> out;
  EXPECT_THROW(decompressor.decompress(bomb, 0, std::uint64_t{1} << 30U, out), FileError);
  EXPECT_LE(out.capacity(), std::size_t{4} << 20U);
}

}  // namespace
}  // namespace coop::mcap
