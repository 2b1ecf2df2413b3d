#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "capture/mcap/writer.hpp"
#include "capture/values/compare_captures.hpp"
#include "capture/values/export_csv.hpp"
#include "capture/values/layouts.hpp"
#include "capture/values/print_messages.hpp"
#include "support/temporary_folder.hpp"
#include "unit/capture_schema/cdr_bytes.hpp"

namespace coop::capture {
namespace {

using test::CdrBytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr mcap::Nanoseconds kSecond = 1'000'000'000;

/// A capture put together message by message.
class Capture {
 public:
  explicit Capture(const std::filesystem::path& path)
      : path_(path), writer_(mcap::Series{.path = path}, waiting()) {}

  std::uint16_t channel(const std::string& topic, const std::string& definition,
                        const std::string& encoding = "ros2msg") {
    return writer_.add_channel(writer_.add_schema("p/msg/M", encoding, definition), topic);
  }
  Capture& add(std::uint16_t channel, mcap::Nanoseconds time, std::span<const std::byte> payload) {
    EXPECT_TRUE(writer_.write({channel, sequence_++, time, time, payload}));
    return *this;
  }
  mcap::Reader read() {
    writer_.close();
    return mcap::Reader(path_);
  }

 private:
  static mcap::WriterOptions waiting() {
    mcap::WriterOptions options;
    options.when_full = mcap::WhenFull::kWait;
    return options;
  }

  std::filesystem::path path_;
  mcap::Writer writer_;
  std::uint32_t sequence_ = 0;
};

CdrBytes point(double x, const std::string& name = "a") {
  CdrBytes bytes;
  return bytes.put(x).text(name);
}
constexpr const char* kPoint = "float64 x\nstring name\n";

class CaptureValues : public testing::Test {
 protected:
  Capture capture(const std::string& name) { return Capture(folder_.path() / name); }

  static std::string printed(mcap::Reader reader, const PrintOptions& options) {
    std::ostringstream out;
    report_ = print_messages(reader, options, out);
    return out.str();
  }
  static std::vector<std::string> compared(mcap::Reader first, mcap::Reader second,
                                           const std::vector<std::string>& topics = {}) {
    std::vector<std::string> lines;
    for (const auto& topic : compare_captures(first, second, topics)) {
      lines.push_back((topic.is_same(false) ? "" : "! ") + topic.text());
    }
    return lines;
  }

  test::TemporaryFolder folder_;
  static inline PrintReport report_;
};

TEST_F(CaptureValues, messages_are_printed_with_their_topic_and_times) {
  auto file = capture("a.mcap");
  const auto channel = file.channel("/point", kPoint);
  file.add(channel, kSecond + 5, point(0.5)).add(channel, 2 * kSecond, point(1.0, "b"));
  auto reader = file.read();
  std::ostringstream json;
  PrintOptions options{.format = PrintFormat::kJson};
  print_messages(reader, options, json);
  EXPECT_EQ(json.str(),
            R"({"topic":"/point","sequence":0,"log_time":1.000000005,"publish_time":1.000000005,)"
            R"("data":{"x":0.5,"name":"a"}})"
            "\n"
            R"({"topic":"/point","sequence":1,"log_time":2.000000000,"publish_time":2.000000000,)"
            R"("data":{"x":1.0,"name":"b"}})"
            "\n");
  options = {.selection = {.start = 2 * kSecond, .topics = {"point"}}};
  std::ostringstream yaml;
  EXPECT_EQ(print_messages(reader, options, yaml).messages, 1U);
  EXPECT_EQ(yaml.str(),
            "topic: /point\nsequence: 1\nlog_time: 2.000000000\npublish_time: 2.000000000\n"
            "data:\n  x: 1.0\n  name: b\n---\n");
}

TEST_F(CaptureValues, what_cannot_be_decoded_is_said_with_its_reason) {
  auto file = capture("a.mcap");
  const auto good = file.channel("/good", kPoint);
  const auto idl = file.channel("/idl", "struct M {};", "ros2idl");
  const auto broken = file.channel("/broken", "nothing\n");
  auto cut = point(1.0);
  cut.bytes().resize(10);
  file.add(good, 1, cut).add(idl, 2, point(1.0)).add(broken, 3, point(1.0));
  const std::string text = printed(file.read(), {.format = PrintFormat::kJson});
  EXPECT_EQ(report_.undecoded, 3U);
  EXPECT_THAT(text,
              HasSubstr(R"x("data":null,"error":"x at byte 4: the payload ends (10 bytes)")x"));
  EXPECT_THAT(text, HasSubstr("a schema encoded as 'ros2idl', not ros2msg (18 bytes)"));
  EXPECT_THAT(text, HasSubstr("a type without a name"));
}

TEST_F(CaptureValues, a_topic_is_a_table) {
  auto file = capture("a.mcap");
  const auto channel = file.channel("/p", "uint8[] data\nstring name\n");
  file.add(channel, kSecond, CdrBytes().length(1).put(std::uint8_t{7}).text("a,b"));
  file.add(channel, 3 * kSecond, CdrBytes().length(2).put(std::uint16_t{0x0908}).text(""));
  auto reader = file.read();
  std::ostringstream out;
  const auto report = export_csv(reader, "p", {}, out);
  EXPECT_EQ(report.rows, 2U);
  EXPECT_EQ(report.columns, 4U);
  EXPECT_EQ(out.str(), "log_time,data[0],data[1],name\n1.000000000,7,,\"a,b\"\n3.000000000,8,9,\n");
  EXPECT_THAT([&] { export_csv(reader, "q", {}, out); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no topic q")));
}

TEST_F(CaptureValues, equal_captures_are_the_same_whatever_their_chunks_are) {
  auto a = capture("a.mcap");
  auto b = capture("b.mcap");
  for (Capture* file : {&a, &b}) {
    const auto channel = file->channel("/p", kPoint);
    for (int i = 0; i < 3; ++i) file->add(channel, kSecond * i, point(i));
  }
  EXPECT_THAT(compared(a.read(), b.read()), ElementsAre("/p: 3 messages, the same values"));
}

TEST_F(CaptureValues, the_first_difference_of_each_topic_is_told) {
  auto a = capture("a.mcap");
  auto b = capture("b.mcap");
  const auto pa = a.channel("/p", kPoint);
  const auto qa = a.channel("/q", kPoint);
  const auto ta = a.channel("/t", kPoint);
  const auto tb = b.channel("/t", "float32 x\nstring name\n");
  const auto pb = b.channel("/p", std::string(kPoint) + "# with a remark\n");
  const auto rb = b.channel("/r", kPoint);
  for (int i = 0; i < 3; ++i) a.add(pa, kSecond * i, point(i)).add(qa, 0, point(i));
  for (int i = 0; i < 4; ++i) b.add(pb, kSecond * i, point(i == 2 ? 2.5 : i));
  a.add(ta, 7, point(1));
  b.add(tb, 8, point(1)).add(rb, 1, point(0));
  EXPECT_THAT(
      compared(a.read(), b.read()),
      ElementsAre("! /p: 3 messages and 4 messages; message 2 (2.000000000 s) differs: x: 2 / 2.5",
                  "! /q: only in the first (3 messages)", "! /r: only in the second (1 messages)",
                  "! /t: 1 messages; message 0 (0.000000007 s and 0.000000008 s) differs: type: "
                  "p/M / p/M of another definition; log times differ in 1 messages, first in "
                  "message 0: 0.000000007 / "
                  "0.000000008 s"));
}

TEST_F(CaptureValues, times_are_told_but_count_only_where_wished) {
  auto a = capture("a.mcap");
  auto b = capture("b.mcap");
  a.add(a.channel("/p", kPoint), kSecond, point(1));
  b.add(b.channel("/p", kPoint), kSecond + 1, point(1));
  auto first = a.read();
  auto second = b.read();
  const auto topics = compare_captures(first, second, {"p"});
  ASSERT_EQ(topics.size(), 1U);
  EXPECT_TRUE(topics[0].is_same(false));
  EXPECT_FALSE(topics[0].is_same(true));
}

TEST_F(CaptureValues, what_cannot_be_decoded_is_compared_as_bytes) {
  auto a = capture("a.mcap");
  auto b = capture("b.mcap");
  a.add(a.channel("/p", "", "ros2idl"), 1, point(1));
  b.add(b.channel("/p", "", "ros2idl"), 1, point(1, "b"));
  EXPECT_THAT(compared(a.read(), b.read())[0],
              HasSubstr("differs: byte 16: 97 / 98 (compared as bytes: a schema encoded as"));
}

}  // namespace
}  // namespace coop::capture
