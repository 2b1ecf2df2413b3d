#include "capture/schema/message_definition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/schema/message_layout.hpp"

namespace coop::capture {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(MessageDefinition, every_kind_of_field_is_read) {
  const auto message = parse_message_definition("p/msg/M",
                                                "bool a\n"
                                                "string<=10 b \"x # y\"  # bounded, with default\n"
                                                "float64[9] c\n"
                                                "Point[] d\n"
                                                "q/msg/Thing[<=5] e\n"
                                                "string<=3[<=2] f\n"
                                                "int32[] g [1, 2]\n");
  ASSERT_EQ(message.fields.size(), 7U);
  EXPECT_EQ(message.name, "p/M");
  EXPECT_EQ(message.fields[0].full_type(), "bool");
  EXPECT_EQ(message.fields[1].full_type(), "string<=10");
  EXPECT_EQ(message.fields[1].default_value, "\"x # y\"");
  EXPECT_EQ(message.fields[1].comment, "bounded, with default");
  EXPECT_EQ(message.fields[2].full_type(), "float64[9]");
  EXPECT_EQ(message.fields[3].full_type(), "p/Point[]");
  EXPECT_EQ(message.fields[4].full_type(), "q/Thing[<=5]");
  EXPECT_EQ(message.fields[5].full_type(), "string<=3[<=2]");
  EXPECT_EQ(message.fields[6].default_value, "[1, 2]");
}

TEST(MessageDefinition, constants_keep_their_text) {
  const auto message = parse_message_definition(
      "p/M", "uint8 A=1\nint32 B = -5 # five\nstring C='it # is'\nstring D= don't\n");
  ASSERT_EQ(message.constants.size(), 4U);
  EXPECT_TRUE(message.fields.empty());
  EXPECT_EQ(message.constants[0].value, "1");
  EXPECT_EQ(message.constants[1].value, "-5");
  EXPECT_EQ(message.constants[1].comment, "five");
  EXPECT_EQ(message.constants[2].type, "string");
  EXPECT_EQ(message.constants[3].value, "don't");
}

TEST(MessageDefinition, dependencies_stand_behind_lines_of_equal_signs) {
  const auto messages = parse_ros2msg("a/msg/A",
                                      "# about A\r\nb/B one\r\n"
                                      "================================================\r\n"
                                      "MSG: b/msg/B\r\nC two\n"
                                      "===\nMSG: b/C\nuint8 three\n");
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].comments.at(0), "about A");
  EXPECT_EQ(messages[1].name, "b/B");
  EXPECT_EQ(messages[1].fields.at(0).type, "b/C");
  EXPECT_EQ(messages[2].fields.at(0).full_type(), "uint8");
}

TEST(MessageDefinition, text_written_from_a_definition_is_read_as_the_same) {
  const std::string text =
      "# what it is\nuint8 A=1  # one\nstring<=10[3] names\nfloat64 w 1.0  # m\n";
  EXPECT_EQ(to_text(parse_message_definition("p/M", text)), text);
}

struct Refused {
  const char* text;
  const char* why;
};
class RefusedDefinition : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedDefinition, is_named_with_its_line) {
  EXPECT_THAT([] { return MessageLayout("p/M", GetParam().text); },
              ThrowsMessage<DefinitionError>(HasSubstr(GetParam().why)));
}

INSTANTIATE_TEST_SUITE_P(
    Table, RefusedDefinition,
    ::testing::Values(Refused{"uint8 a\nuint8\n", "line 2: a type without a name"},
                      Refused{"uint8[0] a\n", "line 1: no size above zero"},
                      Refused{"uint8[99999999999] a\n", "no size above zero"},
                      Refused{"uint8[<=] a\n", "no size above zero"},
                      Refused{"uint8] a\n", "no type"}, Refused{"uint8<=4 a\n", "only strings"},
                      Refused{"wstring a\n", "wstring has no one encoding"},
                      Refused{"uint8 1a\n", "no name"}, Refused{"uint8 a b=3\nuint8 a\n", "twice"},
                      Refused{"uint8 A=\n", "a constant without a value"},
                      Refused{"x/Y A=3\n", "a constant of a type that has none"},
                      Refused{"x/Y a\n", "no definition of x/Y"},
                      Refused{"M a\n", "contains itself"},
                      Refused{"B a\n===\nMSG: p/B\nM b\n", "contains itself"},
                      Refused{"uint8 a\n===\n", "expected"},
                      Refused{"uint8 a\n===\nuint8 b\n", "expected `MSG: package/Type`"},
                      Refused{"a//b c\n", "no type"}));

TEST(MessageDefinition, nesting_has_an_end) {
  std::string text = "A0 a\n";
  for (int i = 0; i < 60; ++i) {
    text += "===\nMSG: p/A" + std::to_string(i) + "\nA" + std::to_string(i + 1) + " a\n";
  }
  EXPECT_THAT([&] { return MessageLayout("p/M", text); },
              ThrowsMessage<DefinitionError>(HasSubstr("nested too deeply")));
}

TEST(MessageDefinition, names_of_types_have_a_short_and_a_long_form) {
  EXPECT_EQ(short_type_name("p/msg/M"), "p/M");
  EXPECT_EQ(short_type_name("p/M"), "p/M");
  EXPECT_EQ(long_type_name("p/M"), "p/msg/M");
  EXPECT_EQ(long_type_name("p/msg/M"), "p/msg/M");
  for (const char* name : {"", "M", "p/", "/M", "p/srv/M", "p/msg/", "p M/x"}) {
    EXPECT_THROW((void)short_type_name(name), DefinitionError) << name;
  }
}

}  // namespace
}  // namespace coop::capture
