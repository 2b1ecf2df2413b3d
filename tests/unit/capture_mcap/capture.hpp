#pragma once
#include <cstring>
#include <string>

#include "capture/mcap/reader.hpp"
#include "capture/mcap/writer.hpp"

namespace coop::mcap::test {

inline constexpr Nanoseconds kMillisecond = 1'000'000;

inline Bytes bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

inline std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline std::vector<std::byte> content_of(const Source& source) {
  std::vector<std::byte> bytes(source.size());
  source.read(0, bytes);
  return bytes;
}

/// The messages as "topic time text", in the order of reading.
inline std::vector<std::string> lines_of(Reader& reader, const Selection& selection = {}) {
  std::vector<std::string> lines;
  MessageCursor cursor = reader.messages(selection);
  while (const auto read = cursor.next()) {
    lines.push_back(read->channel->topic + " " + std::to_string(read->message.log_time) + " " +
                    text_of(read->message.data));
  }
  return lines;
}

/// A small file in memory, chunk by chunk as the test wants it.
class SmallFile {
 public:
  explicit SmallFile(Compression compression = Compression::kNone, const Layout& layout = {})
      : compressor_(compression, 1), writer_(write_to_memory(bytes_), {"ros2", "test"}, layout) {
    writer_.add(Schema{1, "std_msgs/msg/String", "ros2msg", "string data\n"});
    writer_.add(Channel{1, 1, "/a", "cdr", {{"offered_qos_profiles", ""}}});
    writer_.add(Channel{2, 1, "/b", "cdr", {}});
  }

  SmallFile& message(std::uint16_t channel, Nanoseconds time, const std::string& text) {
    builder_.add(Message{channel, sequence_++, time, time, bytes_of(text)});
    return *this;
  }
  SmallFile& end_chunk() {
    writer_.add(make_ready(builder_, compressor_, buffer_));
    builder_.clear();
    return *this;
  }
  FileWriter& writer() { return writer_; }
  std::vector<std::byte> finish() {
    if (!builder_.empty()) end_chunk();
    writer_.finish();
    return bytes_;
  }
  /// As it is now: without its end.
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  Compressor compressor_;
  ByteBuffer buffer_;
  ChunkBuilder builder_;
  FileWriter writer_;
  std::uint32_t sequence_ = 0;
};

}  // namespace coop::mcap::test
