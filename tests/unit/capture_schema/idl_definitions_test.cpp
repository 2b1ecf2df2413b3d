// Definitions made from the IDL folder: bounded types and constants of IDL, and the table that the
// build writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/schema/definitions.hpp"
#include "capture/schema/idl_parser.hpp"
#include "capture/schema/message_layout.hpp"
#include "core/atomic_file.hpp"
#include "support/shared_data.hpp"

namespace coop::capture {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> fields_of(const MessageDefinition& message) {
  std::vector<std::string> fields;
  for (const auto& field : message.fields) fields.push_back(field.full_type() + " " + field.name);
  return fields;
}

TEST(IdlDefinition, idl_is_written_in_the_message_language) {
  const auto message = parse_idl("p/M",
                                 "// What it is.\n#ifndef X\n#define X\n"
                                 "module p {\nmodule msg {\nmodule M_Constants {\n"
                                 "const uint8 IDLE = 0;  // nothing to do\n};\n@final\nstruct M {\n"
                                 "  @key string<32> name;\n  sequence<double, 4> x;  // m\n"
                                 "  sequence<string<8>, 2> words;\n  octet raw[3];\n"
                                 "  @default(value=1.0) float w;\n  q::msg::T t;\n};\n};\n};\n");
  EXPECT_EQ(to_text(message),
            "# What it is.\nuint8 IDLE=0  # nothing to do\nstring<=32 name\nfloat64[<=4] x  # m\n"
            "string<=8[<=2] words\nbyte[3] raw\nfloat32 w 1.0\nq/T t\n");
  EXPECT_TRUE(message.is_final);
  EXPECT_TRUE(message.fields[0].key);
}

TEST(IdlDefinition, idl_that_is_not_ours_is_refused) {
  for (const char* field : {"wstring a;", "sequence<double a;", "long double a;", "double a",
                            "sequence<double> a[2];", "double<3> a;", "map<string, double> a;"}) {
    const std::string text = "struct M {\n  " + std::string(field) + "\n};\n";
    EXPECT_THROW((void)parse_idl("p/M", text), DefinitionError) << field;
  }
}

TEST(Definitions, are_there_for_every_type_of_the_idl_folder) {
  const auto idl = load_idl(std::filesystem::path(COOP_SOURCE_DIR) / "idl");
  const auto names = ros2msg_names();
  ASSERT_EQ(names.size(), idl.size());
  for (const auto& [name, definition] : idl) {
    const auto text = ros2msg_definition(name);
    ASSERT_TRUE(text) << name;
    EXPECT_EQ(ros2msg_definition(long_type_name(name)), text);
    const auto parsed = parse_ros2msg(name, *text);
    EXPECT_EQ(fields_of(parsed.front()), fields_of(definition));
    EXPECT_EQ(parsed.front().constants.size(), definition.constants.size());
    EXPECT_EQ(MessageLayout(name, *text).name(), name);
  }
  EXPECT_FALSE(ros2msg_definition("sensor_msgs/msg/Nothing"));
  EXPECT_FALSE(ros2msg_definition("msg/LaserScan"));
  EXPECT_FALSE(ros2msg_definition(""));
}

TEST(Definitions, hold_each_dependency_once) {
  const std::string text(*ros2msg_definition("nav_msgs/Odometry"));
  EXPECT_THAT(text, HasSubstr("\nMSG: std_msgs/Header\n"));
  const auto parsed = parse_ros2msg("nav_msgs/Odometry", text);
  std::vector<std::string> names;
  for (const auto& message : parsed) names.push_back(message.name);
  EXPECT_THAT(names, ElementsAre("nav_msgs/Odometry", "std_msgs/Header", "builtin_interfaces/Time",
                                 "geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose",
                                 "geometry_msgs/Point", "geometry_msgs/Quaternion",
                                 "geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist",
                                 "geometry_msgs/Vector3"));
}

TEST(Definitions, of_standard_types_have_the_fields_of_the_original_ones) {
  const auto folder = test::shared_data("ros2/msg");
  if (!folder) GTEST_SKIP() << "not run: the original .msg files are not at hand";
  int compared = 0;
  for (const std::string_view name : ros2msg_names()) {
    if (name.starts_with("coop_msgs/")) continue;
    const auto original =
        parse_message_definition(name, read_file(*folder / (std::string(name) + ".msg")));
    const auto ours = parse_ros2msg(name, *ros2msg_definition(name)).front();
    EXPECT_EQ(fields_of(ours), fields_of(original)) << name;
    ++compared;
  }
  EXPECT_GE(compared, 30);
}

TEST(Definitions, every_original_definition_can_be_read) {
  const auto folder = test::shared_data("ros2/msg");
  if (!folder) GTEST_SKIP() << "not run: the original .msg files are not at hand";
  int read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
    if (entry.path().extension() != ".msg") continue;
    const std::string name = entry.path().parent_path().parent_path().filename().string() + "/" +
                             entry.path().stem().string();
    EXPECT_NO_THROW((void)parse_message_definition(name, read_file(entry.path()))) << name;
    ++read;
  }
  EXPECT_GT(read, 100);
}

TEST(Definitions, names_on_the_wire_are_turned_into_those_of_ros2) {
  EXPECT_EQ(ros2_type_of_dds("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  for (const char* name : {"", "LaserScan", "sensor_msgs::msg::LaserScan", "::msg::dds_::X_",
                           "a::msg::dds_::_", "a::msg::dds_::X"}) {
    EXPECT_FALSE(ros2_type_of_dds(name)) << name;
  }
}

}  // namespace
}  // namespace coop::capture
