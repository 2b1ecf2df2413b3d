// Compares the IDL of the standard types with the common interfaces of ROS 2: with the list of
// fields in tests/data/ros2_message_fields.txt (facts: type, name, order), and that list with the
// original .msg files where they are at hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "idl_lists.hpp"
#include "support/shared_data.hpp"
#include "unit/idl/schema.hpp"

namespace coop::test {
namespace {

const std::filesystem::path kSource(COOP_SOURCE_DIR);

#define COOP_TYPE_NAME(package, type) #package "/" #type,
const std::set<std::string> kBuiltTypes{COOP_IDL_TYPES(COOP_TYPE_NAME)};
#undef COOP_TYPE_NAME

Schema our_standard_types() {
  Schema schema = load_idl(kSource / "idl");
  std::erase_if(schema, [](const auto& entry) { return entry.first.starts_with("coop_msgs/"); });
  return schema;
}

/// Blocks of "package/Type" followed by indented .msg fields.
Schema recorded_fields() {
  Schema schema;
  std::istringstream lines(read_text(kSource / "tests/data/ros2_message_fields.txt"));
  std::string current;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    if (!line.starts_with(' ')) {
      current = line;
    } else {
      const auto field = parse_msg(current.substr(0, current.find('/')), line).fields;
      schema[current].fields.insert(schema[current].fields.end(), field.begin(), field.end());
    }
  }
  return schema;
}

std::vector<std::string> shapes(const Message& message) {
  std::vector<std::string> result;
  for (const Field& field : message.fields) result.push_back(field.shape());
  return result;
}

std::set<std::string> names(const Schema& schema) {
  std::set<std::string> result;
  for (const auto& [name, message] : schema) result.insert(name);
  return result;
}

TEST(Definitions, every_standard_type_has_the_fields_of_the_common_interfaces_in_their_order) {
  const Schema ours = our_standard_types();
  const Schema expected = recorded_fields();
  EXPECT_EQ(names(ours), names(expected));
  for (const auto& [name, message] : expected) {
    ASSERT_TRUE(ours.contains(name)) << name;
    EXPECT_EQ(shapes(ours.at(name)), shapes(message)) << name;
  }
}

TEST(Definitions, the_recorded_fields_are_those_of_the_original_definitions) {
  const auto folder = shared_data("ros2/msg");
  if (!folder) GTEST_SKIP() << "not run: the original .msg files are not at hand";
  for (const auto& [name, message] : recorded_fields()) {
    const auto slash = name.find('/');
    const std::string package = name.substr(0, slash);
    const auto file = *folder / package / "msg" / (name.substr(slash + 1) + ".msg");
    EXPECT_EQ(shapes(parse_msg(package, read_text(file))), shapes(message)) << name;
  }
}

TEST(Definitions, defaults_of_the_common_interfaces_are_ours_too) {
  const Schema ours = our_standard_types();
  int defaults = 0;
  for (const auto& [name, message] : recorded_fields()) {
    for (std::size_t i = 0; i < message.fields.size(); ++i) {
      const std::string& theirs = message.fields[i].default_value;
      if (theirs.empty()) continue;
      ++defaults;
      const std::string& here = ours.at(name).fields.at(i).default_value;
      EXPECT_EQ(std::stod(here.empty() ? "0" : here), std::stod(theirs))
          << name << "." << message.fields[i].name;
    }
  }
  EXPECT_EQ(defaults, 4) << "the quaternion's";
}

TEST(Definitions, every_struct_is_final) {
  for (const auto& [name, message] : load_idl(kSource / "idl")) {
    EXPECT_TRUE(message.final_struct) << name;
  }
}

TEST(Definitions, every_type_named_in_a_field_is_defined_and_built) {
  const Schema schema = load_idl(kSource / "idl");
  EXPECT_EQ(names(schema), kBuiltTypes);
  for (const auto& [name, message] : schema) {
    for (const Field& field : message.fields) {
      if (field.type.find('/') != std::string::npos) {
        EXPECT_TRUE(schema.contains(field.type)) << name << "." << field.name;
      }
    }
  }
}

TEST(Definitions, only_status_like_messages_of_our_own_are_keyed) {
  std::set<std::string> keys;
  for (const auto& [name, message] : load_idl(kSource / "idl")) {
    for (const Field& field : message.fields) {
      if (field.key) keys.insert(name + "." + field.name);
    }
  }
  EXPECT_THAT(keys, testing::ElementsAre(
                        "coop_msgs/ComponentStatus.name", "coop_msgs/EmergencyStop.source",
                        "coop_msgs/LockstepJoin.name", "coop_msgs/NavigationStatus.source"));
}

TEST(Definitions, a_difference_in_order_type_or_bound_is_seen) {
  const auto original = parse_msg("p", "float64 x\nPoint[] points # list\nuint8 A=1\nint8[3] z\n");
  EXPECT_THAT(shapes(original), testing::ElementsAre("float64 x", "p/Point[] points", "int8[3] z"));
  const auto same = parse_idl(
      "@final\nstruct M {\n  double x;\n  sequence<p::msg::Point> points;\n  int8 z[3];\n};\n");
  EXPECT_EQ(shapes(same), shapes(original));
  const auto other = parse_idl("struct M {\n  double x;\n  int8 z[4];\n};\n");
  EXPECT_FALSE(other.final_struct);
  EXPECT_THAT(shapes(other), testing::ElementsAre("float64 x", "int8[4] z"));
}

}  // namespace
}  // namespace coop::test
