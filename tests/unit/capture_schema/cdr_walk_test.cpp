#include "capture/schema/cdr_walk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "unit/capture_schema/cdr_bytes.hpp"

namespace coop::capture {
namespace {

using test::CdrBytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Writes down what it is told.
struct Notes {
  std::vector<std::string> lines{};
  std::vector<std::string> unwanted{};

  void begin_message(const FieldLayout& field, std::size_t index) {
    lines.push_back(field.name + (index == kNoIndex ? "" : "#" + std::to_string(index)) + "{");
  }
  void end_message(const FieldLayout& /*field*/) { lines.emplace_back("}"); }
  void begin_array(const FieldLayout& field, std::size_t count) {
    lines.push_back(field.name + "[" + std::to_string(count));
  }
  void end_array(const FieldLayout& /*field*/) { lines.emplace_back("]"); }
  void text(const FieldLayout& field, std::size_t /*index*/, std::string_view value) {
    lines.push_back(field.name + "=" + std::string(value));
  }
  void number(const FieldLayout& field, const Number& value) {
    lines.push_back(field.name + "=" + std::to_string(value.as_double()));
  }
  void numbers(const FieldLayout& field, const NumberArray& values) {
    lines.push_back(field.name + ":" + std::to_string(values.size()));
  }
  bool wants(const FieldLayout& field) {
    return std::find(unwanted.begin(), unwanted.end(), field.name) == unwanted.end();
  }
};

constexpr const char* kMixed =
    "int8 a\nfloat64 b\nInner[] c\nstring[2] d\nuint16[3] e\nint64 f\n"
    "===\nMSG: p/Inner\nuint8 g\nuint32 h\n";

CdrBytes mixed(bool little_endian) {
  CdrBytes bytes(little_endian);
  bytes.put(std::int8_t{-1}).put(2.5).length(2);
  bytes.put(std::uint8_t{3}).put(std::uint32_t{4}).put(std::uint8_t{5}).put(std::uint32_t{6});
  bytes.text("one").text("").put(std::uint16_t{7}).put(std::uint16_t{8}).put(std::uint16_t{9});
  return bytes.put(std::int64_t{-10});
}

TEST(CdrWalk, both_byte_orders_give_the_same_values) {
  const MessageLayout layout("p/M", kMixed);
  for (const bool little : {true, false}) {
    Notes notes;
    auto bytes = mixed(little);
    const auto read = walk(layout, bytes, notes);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(*read, bytes.bytes().size());
    EXPECT_THAT(notes.lines, ElementsAre("a=-1.000000", "b=2.500000", "c[2", "c#0{", "g=3.000000",
                                         "h=4.000000", "}", "c#1{", "g=5.000000", "h=6.000000", "}",
                                         "]", "d[2", "d=one", "d=", "]", "e:3", "f=-10.000000"));
  }
}

TEST(CdrWalk, skipped_fields_leave_the_others_in_place) {
  const MessageLayout layout("p/M", kMixed);
  Notes notes{.unwanted = {"a", "b", "c", "d", "e"}};
  ASSERT_TRUE(walk(layout, mixed(true), notes));
  EXPECT_THAT(notes.lines, ElementsAre("f=-10.000000"));
}

TEST(CdrWalk, fixed_types_are_skipped_with_the_padding_between_them) {
  // Elements of 9 bytes: their size on the wire depends on where they begin.
  const MessageLayout layout(
      "p/M", "uint8 a\nInner[5] b\nInner[] c\nuint8 d\n===\nMSG: p/Inner\nfloat64 x\nuint8 y\n");
  CdrBytes bytes;
  bytes.put(std::uint8_t{1});
  for (int i = 0; i < 5; ++i) bytes.put(1.0 * i).put(std::uint8_t{2});
  bytes.length(3);
  for (int i = 0; i < 3; ++i) bytes.put(1.0 * i).put(std::uint8_t{2});
  bytes.put(std::uint8_t{77});
  Notes notes{.unwanted = {"a", "b", "c"}};
  const auto read = walk(layout, bytes, notes);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, bytes.bytes().size());
  EXPECT_THAT(notes.lines, ElementsAre("d=77.000000"));
}

TEST(CdrWalk, large_fixed_arrays_have_the_size_they_take_one_by_one) {
  // 12 bytes behind a double: the offset modulo 8 alternates.
  const MessageLayout layout("p/M",
                             "uint8 a\nInner[5000] b\n===\nMSG: p/Inner\nfloat64 x\nuint32 y\n");
  const TypeLayout& type = layout.types().front();
  ASSERT_TRUE(type.is_fixed());
  std::uint64_t at = 3 + 1;
  for (int i = 0; i < 5000; ++i) at = ((at + 7) & ~std::uint64_t{7}) + 12;
  EXPECT_EQ(type.advance[3], at - 3);
}

TEST(CdrWalk, a_message_without_fields_is_one_byte) {
  const MessageLayout layout("p/M", "E a\nE[2] b\nuint8 c\n===\nMSG: p/E\nuint8 NOTHING=0\n");
  CdrBytes bytes;
  for (int i = 0; i < 4; ++i) bytes.put(static_cast<std::uint8_t>(i));
  Notes notes;
  ASSERT_TRUE(walk(layout, bytes, notes));
  EXPECT_EQ(notes.lines.back(), "c=3.000000");
}

TEST(CdrWalk, a_payload_cut_short_anywhere_is_an_error_with_its_place) {
  const MessageLayout layout("p/M", kMixed);
  const auto whole = mixed(true).bytes();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    Notes notes;
    const auto read = walk(layout, std::span(whole).first(length), notes);
    ASSERT_FALSE(read) << length;
    EXPECT_LE(read.error().offset, length);
    EXPECT_FALSE(read.error().reason.empty());
  }
}

TEST(CdrWalk, the_path_of_a_fault_leads_to_the_field) {
  const MessageLayout layout("p/M",
                             "Inner[] list\n===\nMSG: p/Inner\nLeaf leaf\n===\nMSG: p/Leaf\n"
                             "string name\n");
  CdrBytes bytes;
  bytes.length(2).text("ok").put(std::uint32_t{1000});
  const auto read = walk(layout, bytes, Notes{});
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().text(),
            "list[1].leaf.name at byte 20: a string that is longer than the payload");
}

TEST(CdrWalk, absurd_lengths_are_refused_before_they_are_walked) {
  const std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  for (const char* text :
       {"uint8[] a\n", "float64[] a\n", "string[] a\n", "E[] a\n===\nMSG: p/E\n",
        "B[] a\n===\nMSG: p/B\nB1[4000000000] x\n===\nMSG: p/B1\nfloat64[4000000000] y\n"}) {
    CdrBytes bytes;
    bytes.length(most).put(std::uint64_t{0});
    Notes notes;
    EXPECT_FALSE(walk(MessageLayout("p/M", text), bytes, notes)) << text;
    EXPECT_TRUE(notes.lines.empty());
  }
  CdrBytes bytes;
  bytes.put(std::uint64_t{0});
  EXPECT_FALSE(walk(MessageLayout("p/M", "string[4000000000] a\n"), bytes, Notes{}));
}

TEST(CdrWalk, bounds_booleans_and_encapsulation_are_held) {
  const auto refused = [](const char* text, CdrBytes bytes) {
    const auto read = walk(MessageLayout("p/M", text), bytes, Notes{});
    return read ? std::string("read") : read.error().reason;
  };
  EXPECT_THAT(refused("string<=3 a\n", CdrBytes().text("four")), HasSubstr("than its bound"));
  EXPECT_EQ(refused("string<=4 a\n", CdrBytes().text("four")), "read");
  EXPECT_THAT(refused("uint8[<=1] a\n", CdrBytes().length(2).put(std::uint16_t{0})),
              HasSubstr("than its bound"));
  EXPECT_THAT(refused("bool a\n", CdrBytes().put(std::uint8_t{2})), HasSubstr("neither 0 nor 1"));
  CdrBytes xcdr2;
  xcdr2.put(std::uint8_t{1});
  xcdr2.bytes()[1] = std::byte{7};
  EXPECT_THAT(refused("uint8 a\n", xcdr2), HasSubstr("encapsulation"));
}

TEST(CdrWalk, text_without_terminating_zero_is_taken_whole) {
  CdrBytes bytes;
  bytes.length(2).put('o').put('k').length(0);
  Notes notes;
  ASSERT_TRUE(walk(MessageLayout("p/M", "string a\nstring b\n"), bytes, notes));
  EXPECT_THAT(notes.lines, ElementsAre("a=ok", "b="));
}

TEST(CdrWalk, an_empty_sequence_of_doubles_is_not_padded) {
  CdrBytes bytes;
  bytes.length(0).put(std::uint8_t{5});
  Notes notes;
  ASSERT_TRUE(walk(MessageLayout("p/M", "float64[] a\nuint8 b\n"), bytes, notes));
  EXPECT_THAT(notes.lines, ElementsAre("a:0", "b=5.000000"));
}

}  // namespace
}  // namespace coop::capture
